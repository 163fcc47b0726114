"""Commands that answer for one load on a thrust bearing or a pair of cones."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from loadflow.cli.base import AsJson, app, print_quantities
from loadflow.cli.stated import every_but, refuse
from loadflow.errors import InputError

if TYPE_CHECKING:
    from loadflow.scene.thrust import AnyAxial

FromScene = Annotated[
    Path | None, typer.Option(help="Take bearing and film from this scene instead.")
]
Which = Annotated[str | None, typer.Option(help="Place of it in the scene; default its first.")]
Pads = Annotated[int | None, typer.Option(help="Number of pads or segments in a row.")]
PadAngle = Annotated[float | None, typer.Option(help="Of one pad, °.")]
TaperDepth = Annotated[float, typer.Option(help="Depth of the wedge at a pad's inlet, m.")]
Wedge = Annotated[float, typer.Option(help="Share of a pad's length over which it falls.")]
Viscosity = Annotated[float | None, typer.Option(help="Dynamic, Pa s.")]
EdgePressure = Annotated[float, typer.Option(help="At the edges of the pads, absolute, Pa.")]
Speed = Annotated[float, typer.Option(help="Speed of the shaft, 1/min.")]
Grid = Annotated[tuple[int, int], typer.Option(help="Cells of a pad along the motion and across.")]


@app.command()
def thrust(
    force: Annotated[
        float, typer.Option(help="Along the shaft, N; > 0 on the front row, < 0 on the back row.")
    ],
    speed_rpm: Speed,
    pads: Pads = None,
    inner_radius: Annotated[float | None, typer.Option(help="m.")] = None,
    outer_radius: Annotated[float | None, typer.Option(help="m.")] = None,
    pad_angle_deg: PadAngle = None,
    taper: TaperDepth = 0.0,
    wedge: Wedge = 0.75,
    step: Annotated[
        float | None, typer.Option(help="Depth of a Rayleigh step in place of the wedge, m.")
    ] = None,
    pivot: Annotated[
        float | None,
        typer.Option(help="Tilting pads: place of the pivot as share of the length."),
    ] = None,
    play: Annotated[float, typer.Option(help="Films of both rows together, m.")] = 4e-4,
    viscosity: Viscosity = None,
    edge_pressure: EdgePressure = 0.1e6,
    grid: Grid = (40, 20),
    scene: FromScene = None,
    bearing: Which = None,
    as_json: AsJson = False,
) -> None:
    """Solve the films of a thrust collar between two rows of pads for one force."""
    from loadflow.studies.one_bearing.thrust import thrust_point

    geometry = {
        "pads": pads,
        "inner_radius": inner_radius,
        "outer_radius": outer_radius,
        "pad_angle": None if pad_angle_deg is None else math.radians(pad_angle_deg),
    }
    more: dict[str, Any] = {"taper": taper, "wedge": wedge}
    if step is not None:
        refuse("--step takes the place of the wedge", "taper", "wedge")
        more = {"profile": {"kind": "step", "height": step}}
    elif not taper:
        refuse("the wedge has no depth; give --taper", "wedge")
    if pivot is not None:
        more |= {"pivot": {"share": pivot}}
    told = {"play": play, "edge_pressure": edge_pressure, "grid": grid}
    found = _bearing("thrust", scene, bearing, geometry, more, viscosity, told)
    speed = speed_rpm * math.pi / 30
    print_quantities(thrust_point(found, (0.0, 0.0, force), (0.0, 0.0), speed), as_json)


@app.command()
def cone(
    speed_rpm: Speed,
    force_x: Annotated[float, typer.Option(help="Across the shaft, first axis, N.")] = 0.0,
    force_y: Annotated[float, typer.Option(help="Second axis, to which the first turns, N.")] = 0.0,
    force_z: Annotated[float, typer.Option(help="Along the shaft, toward the right cone, N.")] = (
        0.0
    ),
    moment_x: Annotated[float, typer.Option(help="About the first axis, N m.")] = 0.0,
    moment_y: Annotated[float, typer.Option(help="About the second axis, N m.")] = 0.0,
    half_angle_deg: Annotated[
        float | None, typer.Option(help="Between axis and generator, °.")
    ] = None,
    slant: Annotated[
        tuple[float, float] | None,
        typer.Option(help="Distances of both ends from the apex along the cone, m."),
    ] = None,
    clearance: Annotated[
        float | None, typer.Option(help="Gap normal to the surface, centred, m.")
    ] = None,
    distance: Annotated[
        float | None, typer.Option(help="Between the middles of both cones, m.")
    ] = None,
    arrangement: Annotated[str, typer.Option(help="Narrow (O) or wide (X) ends inside.")] = "O",
    pads: Pads = None,
    pad_angle_deg: PadAngle = None,
    taper: TaperDepth = 0.0,
    wedge: Wedge = 0.75,
    viscosity: Viscosity = None,
    edge_pressure: EdgePressure = 0.1e6,
    grid: Grid = (40, 20),
    scene: FromScene = None,
    bearing: Which = None,
    as_json: AsJson = False,
) -> None:
    """Solve the films of two cones against each other for one force and moment."""
    from loadflow.studies.one_bearing.thrust import thrust_point

    one: dict[str, Any] = {
        "half_angle": None if half_angle_deg is None else math.radians(half_angle_deg),
        "slant": slant,
        "clearance": clearance,
    }
    if pads is not None:
        one |= {"pads": pads, "pad_angle": math.radians(pad_angle_deg or 330.0 / pads)}
        if taper:
            one["profile"] = {"kind": "taper", "taper": taper, "wedge": wedge}
    elif taper or pad_angle_deg is not None:
        raise InputError("--taper and --pad-angle-deg are of segments: give --pads")
    if not taper:
        refuse("the wedge has no depth; give --taper", "wedge")
    told = {"edge_pressure": edge_pressure, "grid": grid}
    geometry: dict[str, Any] = {"distance": distance, "left": None}
    if any(value is not None for value in one.values()):
        geometry["left"] = {name: value for name, value in one.items() if value is not None}
    more = {"arrangement": arrangement}
    found = _bearing("conical-pair", scene, bearing, geometry, more, viscosity, told)
    force, moment = (force_x, force_y, force_z), (moment_x, moment_y)
    print_quantities(thrust_point(found, force, moment, speed_rpm * math.pi / 30), as_json)


_LOADS = (
    *("scene", "bearing", "as_json", "speed_rpm", "force", "force_x", "force_y", "force_z"),
    *("moment_x", "moment_y"),
)
"""Parameters that go with a bearing of a scene."""


def _bearing(
    kind: str,
    scene: Path | None,
    place: str | None,
    geometry: Mapping[str, Any],
    more: Mapping[str, Any],
    viscosity: float | None,
    told: Mapping[str, Any],
) -> AnyAxial:
    """The bearing of a scene, or of the measures that a command states; None is not stated."""
    from loadflow.studies.one_bearing.thrust import bearing_of_keys, bearing_of_scene

    given = {name: value for name, value in geometry.items() if value is not None}
    if scene is not None:
        refuse("--scene brings bearing and film", *every_but(*_LOADS))
        return bearing_of_scene(scene, place, kind)
    if place is not None:
        raise InputError("--bearing names a bearing of a scene: give --scene")
    if viscosity is None:
        raise InputError("give --viscosity, or a scene with --scene")
    lubricant = {"viscosity": viscosity}
    return bearing_of_keys(
        {"kind": kind, "lubricant": lubricant, "geometry": given | dict(more)} | dict(told)
    )
