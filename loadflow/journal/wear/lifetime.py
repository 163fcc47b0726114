"""Wear of a bore over a lifetime of starts and stops: the contour carried from cycle to cycle.

The asperities that a film leaves in touch wear the bore by Archard's or Fleischer's law. Over each
cycle the shaft is followed through the film of the bore as it is worn then, so that depth, contact
and film stay consistent:

1. the film of every cycle is solved in the worn bore; it says what load asperities carry, and when;
2. under that load the worn contour grows. The shaft sinks after it, so that the asperities keep
   carrying the same load on a surface that conforms more and more;
3. when the contour has grown by about a roughness, the film is solved anew.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.contact import Contact
from loadflow.journal.film_model import Film
from loadflow.journal.shapes import CYLINDER
from loadflow.journal.wear.cycle import Cycle, followed, offset_of
from loadflow.journal.wear.worn_bearing import WornBearing
from loadflow.journal.wear.worn_surface import Group, Surface
from loadflow.numerics.convergence import Control
from loadflow.numerics.fields import check_fields, require
from loadflow.tribology.wear import Archard, Fleischer, RunningIn

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

TOUCHING = 1e-3  # share of the load on asperities from which a shaft is said to touch
_GROUPS = 96  # of neighbouring samples, in which what touches of a cycle is summed up
_LIGHT = 1e-9  # of the largest load on asperities of a cycle: what is less wears nothing


@dataclass(frozen=True)
class Wear:
    """How a bore wears: its law, running-in, and how finely the contour is followed.

    Attributes
    ----------
    law : Archard or Fleischer
        Depth over sliding distance; Fleischer's takes the boundary friction of `Film.contact`.
    running_in : RunningIn, optional
        Roughness and wear that fall with the worn depth; its `initial_roughness` is that of the
        asperities. Tips keep their radius: K of [Greenwood and Tripp 1970] falls as √σ.
    around, across : int
        Points of the contour.
    step : float
        Largest growth of the contour between two places of the shaft, over the roughness.
    renewal : float
        Growth after which the film is solved anew, over the roughness.
    max_renewals : int
        Films of all cycles at most.

    Raises
    ------
    loadflow.errors.InputError
        A value out of its range.

    Examples
    --------
    >>> from loadflow.journal import Wear
    >>> from loadflow.tribology import Archard
    >>> Wear(Archard(1e-17)).renewal
    1.0
    """

    law: Archard | Fleischer
    running_in: RunningIn | None = None
    around: Annotated[int, Ge(36), Le(7200)] = 720
    across: Annotated[int, Ge(1), Le(200)] = 1
    step: Annotated[float, Gt(0), Le(1)] = 0.1
    renewal: Annotated[float, Gt(0), Le(10)] = 1.0
    max_renewals: Annotated[int, Ge(1), Le(10_000)] = 100

    def __post_init__(self) -> None:
        check_fields(self)

    def surfaces(self, contact: Contact, depth: float) -> Contact:
        """The surfaces where a `depth`, m, is worn off."""
        if self.running_in is None:
            return contact
        rough = contact.asperities.roughness
        return contact.as_rough(float(self.running_in.roughness(depth)) / rough)

    def grown(self, depth: Array, work: Array, friction: float) -> Array:
        """Depth, m, after a further ∫ p ds = `work`, N/m, at each place."""
        if self.running_in is None:
            return depth + self.law.depth(work, 1.0, friction)
        return self.running_in.worn(self.law, work, 1.0, depth, friction)


def wear_bearing(
    bearing: JournalBearing,
    cycles: Sequence[Cycle],
    film: Film,
    wear: Wear,
    control: Control | None = None,
    worn: ArrayLike | None = None,
) -> WornBearing:
    """Wear a bore by cycles that come back, all of them together, over their whole number.

    Parameters
    ----------
    bearing : JournalBearing
        Cylindrical; its relief stays.
    cycles : sequence of Cycle
        What wears it, in one mixture.
    film : Film
        With `contact`; isothermal, in a rigid shell. Of the rung "reduced" it stays there; other
        rungs give way to "grid".
    wear : Wear
        Law and running-in.
    control : Control, optional
        How hard to solve the films.
    worn : array_like (around, across), optional
        Depth to begin with, m, as the `depth` of an earlier result.

    Returns
    -------
    WornBearing

    Raises
    ------
    loadflow.errors.InputError
        A film without contact, with heat or a shell, a bore of another shape, no cycles.
    loadflow.errors.SolverError
        A film without an answer, or a life that is not over after `max_renewals` films.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import Contact, Cycle, Film, JournalBearing, Lubricant, Reynolds
    >>> from loadflow.journal import Wear, wear_bearing
    >>> from loadflow.tribology import Archard, AsperityContact
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> rough = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
    >>> film = Film(Lubricant(0.03), Reynolds(), grid=(60, 8), contact=Contact(rough))
    >>> time = np.linspace(0.0, 1.0, 6)
    >>> start = Cycle(time, np.tile((4e4, 0.0), (6, 1)), 2.0 * time, 1e3, in_motion=False)
    >>> found = wear_bearing(bearing, [start], film, Wear(Archard(1e-17), renewal=2.0))
    >>> bool(found.depth.max() > 0), bool(abs(found.volume / (1e-17 * found.work) - 1) < 1e-10)
    (True, True)
    """
    contact = _checked(bearing, cycles, film, wear)
    film = film if film.rung == "reduced" else replace(film, rung="grid")
    surface = Surface(bearing, wear.around, wear.across)
    depth = np.zeros(surface.shape) if worn is None else np.array(worn, dtype=float)
    allowed = f"≥ 0 m, finite, {surface.shape}"
    fits = depth.shape == surface.shape and bool(np.isfinite(depth).all() and (depth >= 0).all())
    require(fits, "worn", depth.shape, allowed)
    life, work, left, rows = 0.0, 0.0, 0.0, list[dict[str, Any]]()
    rough, weight = contact, np.zeros(surface.shape)
    offsets = [offset_of(bearing, cycle, film, control) for cycle in cycles]
    for _ in range(wear.max_renewals):
        now = surface.worn(depth)
        runs = [
            _Run(*followed(now, cycle, replace(film, contact=rough), control, offset))
            for cycle, offset in zip(cycles, offsets)
        ]
        rows.append(_told(life, depth, surface, rough, runs))
        if life >= 1.0:
            break
        grown = 0.0
        groups = [group for run in runs for group in run.groups(bearing.radius)]
        while life < 1.0 and grown < wear.renewal * rough.asperities.roughness:
            # N/m over the whole life
            pressed, missed, groups = surface.pressed(groups, rough, depth)
            left = max(left, missed)
            rate = float((wear.grown(depth, pressed, rough.coefficient) - depth).max())
            if rate == 0.0:
                life = 1.0
                break
            # a rate of wear that falls as the surface runs in is at its largest now
            share = min(1.0 - life, wear.step * rough.asperities.roughness / rate)
            after = wear.grown(depth, share * pressed, rough.coefficient)
            grown += float((after - depth).max())
            depth, life, weight = after, life + share, weight + share * pressed
            work += share * float(pressed.sum()) * surface.area
            life = 1.0 if life > 1.0 - 1e-12 else life
            typical = float((weight * depth).sum() / max(weight.sum(), 1e-300))
            rough = wear.surfaces(contact, typical)
    else:
        raise SolverError(
            f"wear: {life:.3g} of all cycles are over after {wear.max_renewals} films, depth "
            f"{depth.max():.3g} m; take a larger renewal or more max_renewals"
        )
    return WornBearing(
        bearing=surface.worn(depth),
        film=replace(film, contact=rough),
        angle=surface.angle,
        z=surface.z,
        depth=depth,
        volume=float(depth.sum()) * surface.area,
        work=work,
        history=_history(rows, cycles),
        converged=True,
        residual=left,
        iterations=len(rows),
    )


def _checked(bearing: JournalBearing, cycles: Sequence[Cycle], film: Film, wear: Wear) -> Contact:
    """The surfaces of a film that can wear.

    Raises
    ------
    loadflow.errors.InputError
        What cannot.
    """
    contact = film.contact
    if contact is None:
        raise InputError("contact: not given; only asperities that touch wear")
    require(bearing.shape == CYLINDER, "shape", bearing.shape.kind, "cylindrical, for wear")
    require(film.heat is None, "heat", film.heat, "None, for wear: the film as warm as it is")
    require(film.shell is None, "shell", film.shell, "None, for wear: a rigid shell")
    require(len(cycles) > 0, "cycles", "none", "one or more")
    if wear.running_in is not None:
        new, rough = wear.running_in.initial_roughness, contact.asperities.roughness
        same = abs(new - rough) <= 1e-6 * rough
        require(same, "initial_roughness", new, f"that of the asperities, {rough:g} m")
    if any(cycle.tilt is not None for cycle in cycles):
        require(wear.across > 1, "across", wear.across, "> 1 for a shaft that tilts")
    return contact


@dataclass(frozen=True)
class _Run:
    """A cycle in the bore as it is worn, at the times at which it was `followed`."""

    cycle: Cycle
    found: dict[str, Array]

    def groups(self, radius: float) -> Iterator[Group]:
        """What touches and slides, in at most `_GROUPS` groups."""
        cycle, found = self.cycle, self.found
        force, slid = found["contact_force"], cycle.distance(radius)
        size = np.hypot(*force.T)
        some = np.flatnonzero((slid > 0) & (size > _LIGHT * max(size.max(), 1e-300)))
        if not some.size or cycle.count == 0:
            return
        lines = np.zeros((slid.size, 4))
        for columns, values in ((slice(0, 2), cycle.tilt), (slice(2, 4), cycle.bend)):
            if values is not None:
                lines[:, columns] = values
        for part in np.array_split(some, min(_GROUPS, some.size)):
            share = slid[part] / slid[part].sum()
            yield Group(
                share @ force[part],
                share @ found["eccentricity"][part],
                cycle.count * float(slid[part].sum()),
                share @ lines[part],
            )


def _told(
    life: float, depth: Array, surface: Surface, rough: Contact, runs: list[_Run]
) -> dict[str, Any]:
    """A row of the history."""
    row: dict[str, Any] = {
        "life": life,
        "depth": float(depth.max()),
        "volume": float(depth.sum()) * surface.area,
        "roughness": rough.roughness,
    }
    for run in runs:
        found, cycle = run.found, run.cycle
        turning = np.abs(cycle.speed) > 0
        touching = turning & (found["contact_share"] > TOUCHING)
        values = {
            "minimum_film": found["minimum_film"][turning].min(initial=np.inf),
            "contact_time": cycle.seconds[touching].sum(),
            "contact_speed": np.abs(cycle.speed)[touching].max(initial=0.0),
            "contact_energy": cycle.seconds @ found["contact_power"],
            "friction_energy": cycle.seconds @ found["friction_power"],
            "contact_pressure": found["contact_pressure"].max(),
        }
        for name, value in values.items():
            row.setdefault(name, []).append(float(value))
    return row


_OF_ALL = {
    "life": ("1", "share of all cycles that is over"),
    "depth": ("m", "largest worn depth"),
    "volume": ("m^3", "worn volume"),
    "roughness": ("m", "combined roughness"),
}
_OF_EACH = {
    "minimum_film": ("m", "smallest film while turning"),
    "contact_time": ("s", "time in contact while turning"),
    "contact_speed": ("rad/s", "largest speed in contact"),
    "contact_energy": ("J", "friction of touching asperities, one cycle"),
    "friction_energy": ("J", "friction, one cycle"),
    "contact_pressure": ("Pa", "largest pressure of touching asperities"),
}


def _history(rows: list[dict[str, Any]], cycles: Sequence[Cycle]) -> xr.Dataset:
    import xarray as xr

    found = {
        name: (dims, np.array([row[name] for row in rows]), {"units": units, "long_name": words})
        for table, dims in ((_OF_ALL, ("renewal",)), (_OF_EACH, ("renewal", "cycle")))
        for name, (units, words) in table.items()
    }
    return xr.Dataset(found, {"cycle": [cycle.name for cycle in cycles]})
