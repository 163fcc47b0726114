"""Pads around a shaft: where they sit, how they give way, and the films between."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.feed import Feed
from loadflow.journal.film.groove_pressure import Pockets
from loadflow.journal.film.surface.film import SurfaceFilm
from loadflow.journal.film.surface.gap import SurfaceGap, surface_mesh
from loadflow.journal.film_model import Control, Film
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState, Member
from loadflow.journal.solvers.assembly.orbit import march
from loadflow.journal.solvers.assembly.solve import Assembly, raise_not_converged
from loadflow.journal.supply import Supply
from loadflow.journal.surfaces import FLAT, Profile, Surface
from loadflow.journal.thrust.pad_results import orbit_dataset
from loadflow.numerics.fields import require

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

LIFTS = (0.5, 1.0, 2.0, 0.25)  # tilts of pads from which Newton starts


@dataclass(frozen=True)
class Pivot:
    """Point on which a pad rests, and how the support gives way.

    Attributes
    ----------
    share : float
        Place along the motion, as share of the pad's length from the inlet.
    across : float
        Place across, as share of the width from the inner end.
    stiffness : float
        Of the support along the normal of the surface, N/m; rigid by default.
    tilt_stiffness : float
        Against tilting about both axes through the point, N m/rad; 0: the pad tilts freely,
        infinite: it does not.

    Examples
    --------
    >>> from loadflow.journal import Pivot
    >>> Pivot(share=0.58).share  # a little behind the middle of the pad
    0.58
    """

    share: float = 0.6
    across: float = 0.5
    stiffness: float = math.inf
    tilt_stiffness: float = 0.0

    def __post_init__(self) -> None:
        require(0 < self.share < 1, "share", self.share, "share of the pad's length, 0 … 1")
        require(0 < self.across < 1, "across", self.across, "share of the width, 0 … 1")
        require(self.stiffness > 0, "stiffness", self.stiffness, "must be > 0 N/m")
        require(
            self.tilt_stiffness >= 0, "tilt_stiffness", self.tilt_stiffness, "must be ≥ 0 N m/rad"
        )


@dataclass(frozen=True)
class Pads:
    """Equal pads, or one whole ring, on one surface.

    Attributes
    ----------
    surface : Surface
        Where they lie.
    angle : float
        Of one pad, rad; 2π for a whole ring.
    centres : tuple of float
        Angles of their middles from the first axis, rad.
    closed : bool
        Whether the one film runs round.
    profile : Profile
        What is cut into them.
    pivot : Pivot, optional
        What they rest on; rigid by default.
    """

    surface: Surface
    angle: float
    centres: tuple[float, ...]
    closed: bool = False
    profile: Profile = FLAT
    pivot: Pivot | None = None

    def members(
        self, film: Film, clearance: float, base: float, speed: float, rate: float, alike: bool
    ) -> list[Member]:
        """Films of the pads: one for all where they are `alike`, or one for each.

        Parameters
        ----------
        film : Film
            Liquid, law, pressure at the edges, grid.
        clearance, base : float
            Unit of the gap, m; gap of the shaft at position 0 where nothing is cut, m.
        speed, rate : float
            Of the shaft, rad/s; largest speed and squeeze, 1/s, which scale the pressure.
        """
        grid = film.grid or ((80, 20) if self.closed else (40, 20))
        mesh = surface_mesh(self.surface, self.angle, self.closed, self.profile.kinks, grid)
        radius = self.surface.radius
        unit = np.array([clearance] * 3 + [clearance / radius] * 2)[self.surface.rigid]
        rigid = np.eye(BODY)[self.surface.rigid]
        by_pad, support, normal = self._support()
        turns = [_turn(0.0 if self.closed else centre) for centre in self.centres]
        members = []
        for group in [turns] if alike else [[turn] for turn in turns]:
            gap = SurfaceGap(mesh, self.profile, clearance, base / clearance)
            own = SurfaceFilm(
                gap,
                film.law,
                film.liquid.viscosity,
                clearance / radius,
                radius,
                film.edge_pressure,
                Pockets(
                    np.full(mesh.shape, -1),
                    Feed(Supply(), film.liquid),
                    clearance**3 / (12.0 * film.liquid.viscosity),
                ),
            )
            own.set_speed(speed)
            own.set_scale(rate)
            members.append(
                Member(
                    own,
                    attached=rigid / unit[:, None],
                    by_pad=rigid @ by_pad / unit[:, None],
                    support=support,
                    normal=rigid @ normal / unit,
                    turns=tuple(group),
                )
            )
        return members

    def _support(self) -> tuple[Array, Array, Array]:
        """Motions of a pad as the shaft's (5, k), stiffness of its support (k, k), normal (5,)."""
        pivot = self.pivot
        if pivot is None:
            return np.zeros((BODY, 0)), np.zeros((0, 0)), np.zeros(BODY)
        nodes = self.surface.place(self.surface.nodes(4))
        place = float(nodes[0] + pivot.across * (nodes[-1] - nodes[0]))
        frame = self.surface.frame((pivot.share - 0.5) * self.angle, place)
        motions, stiffness = [], []
        if math.isfinite(pivot.stiffness):
            motions.append(frame.along(frame.normal))
            stiffness.append(pivot.stiffness)
        if math.isfinite(pivot.tilt_stiffness):
            motions += [frame.turning(frame.generator), frame.turning(frame.tangent)]
            stiffness += [pivot.tilt_stiffness] * 2
        columns = np.array(motions).reshape(-1, BODY).T
        return columns, np.diag(np.array(stiffness)), frame.along(frame.normal)

    @property
    def tilting(self) -> bool:
        """Whether the pads tilt."""
        return self.pivot is not None and math.isfinite(self.pivot.tilt_stiffness)

    def lifted(self, gap: float, speed: float, lift: float = LIFTS[0]) -> Array:
        """Motion of a pad (k,) with which its film of height `gap`, m, converges.

        Over the length of the pad it falls by the share `lift` of that height.
        """
        motions = self._support()[1].shape[0]
        start = np.zeros(motions)
        if self.tilting:
            length = self.angle * self.surface.radius
            start[-2] = math.copysign(lift * gap / length, speed)
        return start

    def lifted_at(self, members: Sequence[Member], position: Array, speed: float) -> list[Array]:
        """Motions of the pads of `members` with which their films converge at a shaft's position.

        Over its length each falls by half the narrowest gap that the pad would have unmoved.
        """
        found = []
        for member in members:
            gap = member.unit * member.film.gap.narrowest(member.sees @ position)
            found.append(self.lifted(max(gap, 0.0), speed))
        return found

    def orbit(
        self,
        assembly: Assembly,
        start: AssemblyState,
        times: Array,
        loads: Array,
        speeds: Array,
        free: NDArray[np.int64],
        control: Control,
    ) -> xr.Dataset:
        """Path from the position of `start` under `loads` (n, 5); see the verbs of the bearings."""
        largest = float(np.linalg.norm(loads[:, :3], axis=1).max())
        for member in assembly.members:
            film = member.film
            film.set_speed(member.sense * float(speeds[0]))
            film.raise_scale(largest / (film.radius**2 * self.angle * len(self.centres)))
        first = assembly.solve(start, np.zeros(BODY), np.array([], int), control.limits(1e-10, 60))
        if not first.converged:
            raise_not_converged("orbit cannot start", first, assembly.narrowest(first))
        first = assembly.wetted(first)
        limits = control.limits(1e-8, 30)
        states = march(assembly, first, times, loads, speeds, free, limits)
        rows = []
        for state, speed in zip(states, speeds.tolist()):
            for member in assembly.members:
                member.film.set_speed(member.sense * speed)
            row = self.describe(assembly, slice(None), state)
            rows.append(row | {"residual": state.residual, "iterations": state.iterations})
        return orbit_dataset(times, np.array([s.position for s in states]), rows)

    def describe(self, assembly: Assembly, members: slice, state: AssemblyState) -> dict[str, Any]:
        """Results of these pads, which are `members` of the assembly, in the order of `centres`."""
        rows, tilts, ways, loads = [], [], [], []
        every = assembly.loads(state)[members]
        for member, own, found in zip(
            assembly.members[members], state.members[members], every, strict=True
        ):
            place = member.place(own, state.position)
            row = member.film.summary(own.u, place)
            tilting = 2 if self.tilting else 0
            for load in found:
                rows.append(row)
                loads.append(load)
                tilts.append(own.pad[-2:] if tilting else np.zeros(2))
                ways.append(own.pad[0] if own.pad.size > tilting else 0.0)
        middle = np.zeros(1) if self.closed else np.array(self.centres)
        mesh = assembly.members[members][0].film.gap.mesh
        around = mesh.angle if self.closed else mesh.nodes_around
        across = mesh.nodes_across if self.surface.open_ends else mesh.z
        centre = np.array([row["centre"] for row in rows])
        centre[:, 1] += middle
        force = np.array([row["normal_force"] for row in rows])
        total = force.sum()
        return {
            "loads": np.array(loads),
            "normal_force": force,
            "load_share": force / total if total else np.full(force.shape, math.nan),
            "centre": centre,
            "pad_tilt": np.array(tilts),
            "pad_displacement": np.array(ways),
            "minimum_film": min(row["minimum_film"] for row in rows),
            "maximum_pressure": max(row["maximum_pressure"] for row in rows),
            "friction_power": sum(row["friction_power"] for row in rows),
            "friction_torque": sum(row["friction_torque"] for row in rows),
            "flow": sum(row["flow"] for row in rows),
            "side_flow": np.sum([row["side_flow"] for row in rows], axis=0),
            "mass_balance": max((row["mass_balance"] for row in rows), key=abs),
            "pressure": np.array([row["pressure"] for row in rows]),
            "angle": middle[:, None] + around,
            "place": self.surface.place(across),
        }


def _turn(angle: float) -> Array:
    """Axes of the shaft as seen by a pad at `angle`, (5, 5)."""
    cos, sin = math.cos(angle), math.sin(angle)
    turn = np.eye(BODY)
    for first in (0, 3):
        turn[first : first + 2, first : first + 2] = [[cos, sin], [-sin, cos]]
    return turn


def even_pads(pads: int, pad_angle: float, first_pad: float) -> tuple[float, ...]:
    """Middles of evenly spaced pads of which the first begins at `first_pad`, rad.

    Raises
    ------
    loadflow.errors.InputError
        No pad, an angle that is not > 0, or more than fit on the circle.
    """
    require(pads == int(pads) and pads >= 1, "pads", pads, "a whole number ≥ 1")
    pitch = 2.0 * math.pi / pads
    allowed = f"rad, 0 < … ≤ 2π/pads = {pitch:.6g}"
    require(0 < pad_angle <= pitch * (1 + 1e-9), "pad_angle", pad_angle, allowed)
    require(math.isfinite(first_pad), "first_pad", first_pad, "rad, finite")
    return tuple(first_pad + 0.5 * pad_angle + pitch * number for number in range(int(pads)))


def check_film(film: Film, knows_heat: bool = False) -> Film:
    """The film, if it asks for nothing that films of pads and cones do not know.

    Those that know heat know that of pads.

    Raises
    ------
    loadflow.errors.InputError
        Names what they do not know; pressures at which no oil enters.
    """
    kinds = (
        "a PadHeat or None for thrust bearings" if knows_heat else "None for pads and cones here"
    )
    warm = film.heat is None or (knows_heat and film.heat.of_pads)
    require(warm, "heat", film.heat, kinds)
    for name in ("supply", "shell", "contact", "turbulence"):
        value = getattr(film, name)
        require(value is None, name, value, "None for pads and cones")
    rising = film.liquid.pressure_coefficient
    require(rising == 0.0, "pressure_coefficient", rising, "0 for pads and cones")
    require(film.rung == "grid", "rung", film.rung, '"grid" for pads and cones')
    require(film.inlet != "widest gap", "inlet", film.inlet, "None for pads and cones")
    require(film.grading != "graded", "grading", film.grading, "uniform for pads and cones")
    film.check_oil()
    return film


def finite(name: str, value: Any, size: int | None = None) -> Any:
    """A finite number, or an array of `size` of them.

    Raises
    ------
    loadflow.errors.InputError
        Names what is not.
    """
    array = np.asarray(value, dtype=float)
    shape = () if size is None else (size,)
    words = "one number" if size is None else f"{size} numbers"
    require(array.shape == shape, name, value, words)
    require(bool(np.all(np.isfinite(array))), name, value, "finite")
    return float(array) if size is None else array
