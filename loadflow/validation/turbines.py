"""Steady states of the four IEA turbines beside those that their repositories publish.

Of the IEA 15 MW, which comes with the package, always; of the others when a folder of clones of
their repositories is given, as their files are not part of this package. What these files lack
stands here, from the ElastoDyn and ServoDyn files beside them. Published are the states of HAWC2
with blades that bend and twist (15 and 22 MW), and of CCBlade with rigid ones (3.4 and 10 MW): the
latter are also held against the rigid rotor at the speed and the pitch that are printed, without
the control of either side, with what CCBlade has: a tilted shaft, no skewed wake, drag in the
momentum balance. ``data/reference/steady_states.csv`` has the printed numbers.
"""

from __future__ import annotations

import csv
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from loadflow.errors import InputError
from loadflow.rotor import RotorOptions, steady_state
from loadflow.turbines import Turbine, load_turbine

from .check import Check, evidence

_GRAVITY = 9.80665
_HELD = {"speed": 2e-4, "power": 5e-4}
"""Shares of what the control holds above rated, of the turbine that comes with the package."""

_FLAT = 1.0
"""Pitch, °, up to which a rigid rotor has its prebend where CCBlade has it."""

_RIGID = {"power": (0.005, 0.02), "thrust": (0.004, 0.021)}
"""Shares of the rigid rotor, up to this pitch and beyond it, where prebends differ by 1 to 2 %."""

Missed = tuple[tuple[int, ...], tuple[str, ...], str]
"""Winds in whole m/s, quantities, and the reason."""

_QUANTITIES = ("speed", "pitch", "power", "thrust")
_UNITS = {"speed": "1/min", "pitch": "°", "power": "MW", "thrust": "kN"}
_TOLERANCES = {"speed": 0.02, "pitch": 0.4, "power": 0.02, "thrust": 0.03}
"""Shares, and degrees of the pitch: the aims of `loads`, with twice its share of the speed."""


@dataclass(frozen=True)
class PublicTurbine:
    """A turbine of IEA Wind: where its file and its steady states are, and what the file lacks.

    Attributes
    ----------
    name : str
        As its rows have it.
    repository, commit : str
        On GitHub.
    file : str
        The windIO file in the repository.
    published : str
        The file of its steady states there.
    code : str
        The program that computed them.
    beside : dict
        Tables of a turbine file that its own lacks.
    blade : str
        ElastoDyn file with mass and stiffness of the blade, where the windIO file has none.
    length : float
        Of this blade along the reference axis, m.
    shipped : str
        Name of the turbine in this package, if it is there.
    rigid : bool
        Whether the published states are of rigid blades.
    above : dict
        Tolerances of the turbine of its own file above rated, where they are closer than those of
        `loads`: its file states the largest tip speed (80, 90, 95 m/s of the first three, from
        which the printed speeds are 1.7, 0.1 and 0.8 % off) and the power with its efficiency (22
        MW: the printed power grows with the wind). What is left of pitch and thrust is of blades
        that bend in one of both codes.
    missed_shipped, missed, missed_rigid : tuple
        Which rows of the turbine of the package, of its own file and of the rigid rotor are out of
        their tolerance, and why.
    """

    name: str
    repository: str
    commit: str
    file: str
    published: str
    code: str
    beside: dict[str, Any] = field(default_factory=dict)
    blade: str = ""
    length: float = 0.0
    shipped: str = ""
    rigid: bool = False
    above: dict[str, float] = field(default_factory=dict)
    missed_shipped: tuple[Missed, ...] = ()
    missed: tuple[Missed, ...] = ()
    missed_rigid: tuple[Missed, ...] = ()


_LOWEST_PITCH = "the print pitches by {} there, the windIO file by {}"
_SHAVED = "the windIO file asks for peak shaving, the print is without"
_BETWEEN = "between its regions our control does not hold the lowest speed"
_BENT = "our blades bend, those of the print do not; of rigid ones see below"
_SKEWED = (
    "speed 1.7 % above the print's by the windIO file, and a skewed wake, which CCBlade has not: "
    "without it 0.3° off"
)
_TURNED = (
    "our prebend turns with the pitch, that of CCBlade stays: held, ours gives 1 to 2 % more, "
    "within 1 % of CCBlade on the same polars; those of the print have a delay of stall, too"
)
_HEAVY = (
    "at its pitch 13 % off: HAWC2's induction of a rotor loaded so heavily gives 13 % more power "
    "than Buhl's, which we take"
)
_HAWC2 = "HAWC2's induction at such a load gives 2 to 4 % more power than Buhl's, which we take"
_AROUND = "around rated the print follows an optimum of each wind, ours the laws of its control"

TURBINES = (
    PublicTurbine(
        "IEA 3.4 MW",
        "IEAWindTask37/IEA-3.4-130-RWT",
        "c036f783b160604b133a2e4b7317320fde055743",
        "yaml/IEA-3.4-130-RWT.yaml",
        "performance/performance_ccblade.dat",
        "CCBlade",
        {
            "rotor": {"hub_mass": 8239.2, "hub_inertia": 31094.4},
            "drivetrain": {"generator_inertia": 1055.625},
        },
        blade="openfast/IEA-3.4-130-RWT_ElastoDyn_blade.dat",
        length=63.0,
        rigid=True,
        above={"speed": 0.017, "pitch": 0.3, "power": 1e-4, "thrust": 0.006},
        missed=(
            ((5,), _QUANTITIES, _LOWEST_PITCH.format("2.3°", "0°")),
            ((7,), ("pitch", "thrust"), _LOWEST_PITCH.format("1°", "0°")),
            ((9,), ("pitch", "thrust"), _SHAVED),
            ((10,), _QUANTITIES, _SHAVED),
            ((21, 25), ("pitch",), _SKEWED),
        ),
        missed_rigid=(((21,), ("power",), _TURNED),),
    ),
    PublicTurbine(
        "IEA 10 MW",
        "IEAWindTask37/IEA-10.0-198-RWT",
        "f4c09ba7b1d4481156eb35394bf1276b5d250ba6",
        "yaml/IEA-10-198-RWT.yaml",
        "performance/performance_ccblade.dat",
        "CCBlade",
        {
            "rotor": {"hub_mass": 81707.0, "hub_inertia": 476512.0},
            "drivetrain": {"generator_inertia": 3801700.0},
        },
        rigid=True,
        above={"speed": 0.0011, "power": 1e-4, "thrust": 0.017},
        missed=(
            ((5,), _QUANTITIES, _LOWEST_PITCH.format("3.1°", "0°")),
            ((7,), ("speed", "thrust"), _BETWEEN),
            ((9,), ("thrust",), _BENT),
            ((10,), ("pitch", "thrust"), _SHAVED),
            ((11,), ("pitch", "power", "thrust"), _SHAVED),
            ((13,), ("pitch",), _BENT),
            ((21,), ("pitch",), _BENT),
            ((25,), ("pitch", "thrust"), _BENT),
        ),
        missed_rigid=(((17, 21, 25), ("power",), _TURNED),),
    ),
    PublicTurbine(
        "IEA 15 MW",
        "IEAWindTask37/IEA-15-240-RWT",
        "6b3fd8ac92935f7f6fe1810a909afc2430f6896f",
        "WT_Ontology/IEA-15-240-RWT.yaml",
        "HAWC2/IEA-15-240-RWT-Onshore/data/IEA_15MW_RWT_Onshore.opt",
        "HAWC2",
        {
            "rotor": {"hub_mass": 69131.0, "hub_inertia": 969952.0},
            "drivetrain": {"generator_inertia": 1836784.0, "efficiency": 0.95756},
        },
        shipped="iea-15mw",
        above={"speed": 0.0082, "pitch": 0.21, "power": 2e-4, "thrust": 0.014},
        missed_shipped=(
            ((5,), ("pitch",), _LOWEST_PITCH.format("0.4°", "2.9°")),
            ((5,), ("thrust",), _LOWEST_PITCH.format("0.4°", "2.9°") + "; 3 % off at its pitch"),
            ((5,), ("power",), _HEAVY),
        ),
        missed=(
            ((5,), ("speed", "power"), "loaded heavily, at 1.4 of the optimal tip speed ratio"),
            ((7,), ("speed", "thrust"), _BETWEEN),
        ),
    ),
    PublicTurbine(
        "IEA 22 MW",
        "IEAWindSystems/IEA-22-280-RWT",
        "57979ece000ec5cc394962b964805ddf20e387be",
        "windIO/IEA-22-280-RWT.yaml",
        "outputs/01_steady_states/HAWC2/iea-22-280-rwt-steady-states-hawc2.yaml",
        "HAWC2",
        {
            "drivetrain": {"generator_inertia": 1439492.8, "efficiency": 0.954},
            # 0.7 rad/s of the file is no steady control of blades that bend
            "control": {"pitch_frequency": 0.2},
        },
        above={"speed": 1e-4, "pitch": 0.3, "power": 0.004, "thrust": 0.006},
        missed=(
            ((5,), ("pitch",), _LOWEST_PITCH.format("0.0°", "−1.0°")),
            ((5, 7), ("power",), _HAWC2),
            ((9,), ("power", "thrust"), _LOWEST_PITCH.format("−1.3°", "−1.0°")),
            ((10,), ("pitch", "thrust"), _AROUND),
            ((11,), ("speed", "pitch"), _AROUND),
        ),
    ),
)


@evidence("another code")
def checks() -> Iterator[Check]:
    """Yield speed, pitch, power and thrust in steady wind of the turbine of the package."""
    for public in TURBINES:
        if public.shipped:
            yield from _controlled(public, load_turbine(public.shipped), public.missed_shipped, "")


@evidence("another code")
def checks_of_files(folder: Path) -> Iterator[Check]:
    """Yield the same of the turbines' own files.

    Parameters
    ----------
    folder : Path
        Of clones, OWNER/NAME.

    Raises
    ------
    InputError
        A repository is not in the folder, or has not the commit.
    """
    for public in TURBINES:
        turbine = completed(public, folder)
        yield from _controlled(public, turbine, public.missed, ", its own file")
        if public.rigid:
            yield from _rigid(public, turbine)


@cache
def published_states(name: str) -> np.ndarray:
    """Return wind (m/s), speed (1/min), pitch (°), power (W) and thrust (N) as they are printed.

    Parameters
    ----------
    name : str
        Of one of `TURBINES`.
    """
    text = (
        resources.files("loadflow.data")
        .joinpath("reference", "steady_states.csv")
        .read_text("utf-8")
    )
    columns = ("wind", "speed", "pitch", "power", "thrust")
    rows = [row for row in csv.DictReader(text.splitlines()) if row["turbine"] == name]
    return np.array([[float(row[column]) for column in columns] for row in rows])


def content(public: PublicTurbine, path: str, folder: Path) -> str:
    """Return the text of a file of a repository at its commit.

    Raises
    ------
    InputError
        The clone, the commit or the file is not there.
    """
    clone = folder / public.repository
    command = ["git", "-C", str(clone), "show", f"{public.commit}:{path}"]
    try:
        return subprocess.run(command, check=True, capture_output=True).stdout.decode()
    except (OSError, subprocess.CalledProcessError, UnicodeDecodeError) as error:
        raise InputError(
            f"{clone}: no clone of github.com/{public.repository} with {path} of commit "
            f"{public.commit[:12]}"
        ) from error


def completed(public: PublicTurbine, folder: Path) -> Turbine:
    """Return the turbine of a clone, with what its file lacks."""
    with tempfile.TemporaryDirectory() as place:
        here = Path(place)
        (here / "turbine.yaml").write_text(content(public, public.file, folder), encoding="utf-8")
        beside = {"windio": "turbine.yaml"} | public.beside
        if public.blade:
            rows = _elastodyn_blade(content(public, public.blade, folder))
            structure = [[public.length * share, *others] for share, *others in rows]
            mass = float(np.trapezoid([r[2] for r in structure], [r[0] for r in structure]))
            beside["blade"] = {"mass": mass, "structure": structure}
        (here / "turbine.toml").write_text(tomli_w.dumps(beside), encoding="utf-8")
        return load_turbine(here / "turbine.toml")


def controlled_states(public: PublicTurbine, turbine: Turbine) -> np.ndarray:
    """Return ours in the winds of the print, as the rows of `published_states` without the wind."""
    winds = published_states(public.name)[:, 0].tolist()
    options = RotorOptions(tower_dam=False)
    found = steady_state(turbine, winds, shear=0.0, rung="flap", options=options)
    weight = turbine.rotor_mass * _GRAVITY * np.sin(turbine.rotor.tilt)
    speed, pitch = found["speed"].values * 30 / np.pi, np.degrees(found["pitch"].values)
    return np.array([speed, pitch, found["power"].values, found["thrust"].values - weight]).T


def _controlled(
    public: PublicTurbine, turbine: Turbine, missed: tuple[Missed, ...], of: str
) -> Iterator[Check]:
    """Yield the states to which our control brings the turbine."""
    known, closer = published_states(public.name), public.above if of else _HELD
    shaved = {wind for winds, _, why in missed if why == _SHAVED for wind in winds}
    for (wind, *expected), got in zip(known, controlled_states(public, turbine), strict=True):
        for quantity, theirs, ours in zip(_QUANTITIES, expected, got, strict=True):
            label = f"{quantity}, V = {wind:.4g} m/s{of}"
            row = _row(public, label, quantity, theirs, ours, _reason(missed, wind, quantity))
            held = closer if wind > turbine.rated_wind_speed and round(wind) not in shaved else {}
            yield replace(row, tolerance=held.get(quantity, row.tolerance))


def _rigid(public: PublicTurbine, turbine: Turbine) -> Iterator[Check]:
    """Yield power and thrust of the rigid rotor at the printed speed and pitch, along its axis."""
    for (wind, _, pitch, power, thrust), ours in zip(
        published_states(public.name), rigid_states(public.name, turbine), strict=True
    ):
        for quantity, theirs, got in zip(("power", "thrust"), (power, thrust), ours, strict=True):
            label = f"{quantity} of rigid blades at its speed and pitch, V = {wind:.4g} m/s"
            reason = _reason(public.missed_rigid, wind, quantity)
            row = _row(public, label, quantity, theirs, float(got), reason)
            flat, turned = _RIGID[quantity]
            yield replace(row, tolerance=flat if abs(pitch) <= _FLAT else turned)


def rigid_states(name: str, turbine: Turbine, prebend_turns: bool = True) -> np.ndarray:
    """Return power (W) and thrust (N) of rigid blades at the states of `published_states`.

    As CCBlade has them: in even wind on a shaft that is tilted, without a skewed wake, with drag in
    the momentum balance; the mean over a turn.

    Parameters
    ----------
    name : str
        Of one of `TURBINES`.
    turbine : Turbine
    prebend_turns : bool
        With the pitch of the blade; that of CCBlade stays where it is.
    """
    from loadflow.rotor import slots as k
    from loadflow.rotor.inflow import steady_inflow
    from loadflow.rotor.loop import run, turning_state
    from loadflow.rotor.rungs import prepare

    options = RotorOptions(
        tower_dam=False, shed_wake=False, skew_factor=0.0, drag_in_induction=True
    )
    m, c = prepare(turbine, "bem", options)
    weight = turbine.rotor_mass * _GRAVITY * np.sin(turbine.rotor.tilt)
    azimuths = 2 * np.pi / m.blades * np.arange(8) / 8
    found = []
    for wind, speed, degrees, *_ in published_states(name):
        turning, pitch, of = speed * np.pi / 30, np.radians(degrees), m
        if not prebend_turns:
            of, pitch = m._replace(twist=m.twist + pitch), 0.0
        inflow, means = steady_inflow(wind, 2, 0.0), []
        for azimuth in azimuths:
            state = turning_state(of, c, wind, turning, pitch)
            state.scalars[k.S_AZIMUTH] = azimuth
            out = run(of, c, inflow, state, 1e-4, steps=2, controlled=False)
            means.append((out[-1, k.MX] * turning, out[-1, k.FX] - weight))
        found.append(np.mean(means, axis=0))
    return np.array(found)


def _reason(missed: tuple[Missed, ...], wind: float, quantity: str) -> str:
    """Why a number is missed, by the wind in whole m/s; nothing where it is not."""
    return next(
        (
            why
            for winds, quantities, why in missed
            if round(wind) in winds and quantity in quantities
        ),
        "",
    )


def _row(
    public: PublicTurbine, label: str, quantity: str, theirs: float, ours: float, reason: str
) -> Check:
    scale = {"power": 1e-6, "thrust": 1e-3}.get(quantity, 1.0)
    return Check(
        name=f"{public.name}: {label}",
        source=f"{public.code}, {public.repository.split('/')[1]}",
        expected=float(theirs) * scale,
        got=float(ours) * scale,
        tolerance=_TOLERANCES[quantity],
        kind="absolute" if quantity == "pitch" else "relative",
        unit=_UNITS[quantity],
        missed=reason,
    )


def _elastodyn_blade(text: str) -> list[list[float]]:
    """Rows of share of the span, twist, mass and stiffness of a blade file of ElastoDyn."""
    lines = text.splitlines()
    first = next(k for k, line in enumerate(lines) if "BMassDen" in line) + 2
    rows = []
    for line in lines[first:]:
        try:
            share, _, *others = map(float, line.split())
        except ValueError:
            break
        rows.append([share, *others])
    return rows
