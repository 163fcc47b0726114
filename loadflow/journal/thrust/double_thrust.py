"""A thrust collar between two rows of pads: it carries the force along the shaft both ways."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Unpack, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.cell_error import drag_error
from loadflow.journal.film_model import Control, Film, Keywords
from loadflow.journal.grid_bounds import UNRESOLVED, PadError
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.thrust.bearings import ThrustBearing
from loadflow.journal.thrust.pad_bearing import AT_REST, asked, limits_of
from loadflow.journal.thrust.pad_results import (
    PADS,
    PadResult,
    Shows,
    Table,
    ThrustResult,
    drawn,
    of_both,
)
from loadflow.journal.thrust.pads import finite
from loadflow.journal.thrust.warm_pads import (
    TRIES,
    at_temperature,
    check_balance,
    is_settled,
    next_temperature,
    warmed,
)
from loadflow.numerics.fields import require

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from loadflow.journal.pad_heat import PadHeat

Array = NDArray[np.float64]

_ROUNDS = 60

_BOTH: Table = {
    "force": ((), "N", "force along the axis, > 0 on the front row"),
    "gap": ((), "m", "film of the front row"),
    "stiffness": ((), "N/m", "axial stiffness"),
    "damping": ((), "N s/m", "axial damping"),
} | {
    name: PADS[name]
    for name in (
        "minimum_film", "maximum_pressure", "friction_torque", "friction_power", "speed",
        "converged", "residual", "iterations", "resolved",
    )
}  # fmt: skip
"""What two rows of pads on both sides of a collar answer."""

_CLOSED = 1e-4  # of the play: the thinnest film that is tried


@dataclass(frozen=True, repr=False)
class DoubleThrustResult(Shows):
    """Films on both sides of a collar.

    Attributes
    ----------
    front, back : ThrustResult
        Films of both rows.
    force : float
        Along the axis, N; > 0 presses the collar on the front row.
    gap : float
        Film of the front row, m.
    minimum_film, maximum_pressure, friction_torque, friction_power : float
        Of both rows.
    stiffness, damping : float
        Axial, N/m and N s/m.
    speed, converged, residual, iterations
        As in `PadResult`; the residual is that of the force, over the larger of both films' forces.

    Examples
    --------
    >>> from loadflow.journal import DoubleThrustBearing, Film, Guembel, Lubricant, ThrustBearing
    >>> lands = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    >>> collar = DoubleThrustBearing(lands, lands, play=4e-4)
    >>> film = Film(Lubricant(0.05), Guembel(), grid=(20, 10))
    >>> found = collar.equilibrium(1e6, 10.0, film)
    >>> round(found.front.force - found.back.force), found.converged
    (1000000, True)
    """

    front: ThrustResult
    back: ThrustResult
    force: float
    gap: float
    minimum_film: float
    maximum_pressure: float
    friction_torque: float
    friction_power: float
    stiffness: float
    damping: float
    speed: float
    converged: bool
    residual: float
    iterations: int

    _table: ClassVar[Table] = _BOTH

    @property
    def moment(self) -> Array:
        """What the tilted collar applies to both rows about both axes, (2,), N m."""
        return np.asarray(self.front.moment - self.back.moment)

    @property
    def restoring_moment(self) -> float:
        """Its size, N m: the shaft gets it back, against its tilt where that is small."""
        return float(np.hypot(*self.moment))

    @property
    def side_flow(self) -> float:
        """Oil that leaves at the inner and the outer ends of both rows, m³/s."""
        return float(np.sum(self.front.side_flow) + np.sum(self.back.side_flow))

    @property
    def temperature(self) -> float:
        """Of the films of the warmer row, K; NaN without heat."""
        rows = self.front, self.back
        return max(getattr(row, "temperature", math.nan) for row in rows)

    @property
    def grid_error(self) -> PadError:
        """Bounds of what the cells do to the results: to the film as the collar would move."""
        error = of_both(self.front, self.back)
        moved = error.force / self.stiffness if self.stiffness > 0.0 else math.inf
        thinner = drag_error(0.0, moved / self.minimum_film) * self.friction_power
        return replace(error, minimum_film=moved, friction_power=error.friction_power + thinner)

    @property
    def resolved(self) -> bool:
        """Whether the cells resolve both films."""
        thin = self.grid_error.minimum_film < UNRESOLVED * self.minimum_film
        return thin and self.front.resolved and self.back.resolved

    def plot(self) -> Figure:
        """Draw the pressure over the pads of both rows, seen along the axis."""
        return drawn(front=self.front, back=self.back)

    to_dataset = PadResult.to_dataset
    __repr__ = PadResult.__repr__


@dataclass(frozen=True)
class DoubleThrustBearing:
    """Thrust collar between two rows of pads, `play` apart from both together.

    Attributes
    ----------
    front, back : ThrustBearing
        Pads that carry a force > 0 and < 0 along the axis; the pads of both are cut for the same
        sense of rotation of the shaft.
    play : float
        Films of both rows together, m: what the shaft moves from one row to the other.

    Examples
    --------
    >>> from loadflow.journal import DoubleThrustBearing, Film, Guembel, Lubricant, ThrustBearing
    >>> lands = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    >>> film = Film(Lubricant(0.05), Guembel(), grid=(20, 10))
    >>> found = DoubleThrustBearing(lands, lands, play=4e-4).equilibrium(-1e6, 10.0, film)
    >>> found.back.gap < found.front.gap
    True
    """

    front: ThrustBearing
    back: ThrustBearing
    play: float

    def __post_init__(self) -> None:
        require(0 < self.play < math.inf, "play", self.play, "must be > 0 m and finite")

    def pressure(
        self,
        gap: float,
        speed: float,
        film: Film | Lubricant | None = None,
        *more: Any,
        tilt: ArrayLike = (0.0, 0.0),
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> DoubleThrustResult:
        """Films with the front one as thick as `gap`, m.

        Parameters
        ----------
        gap : float
            Film of the front row on the axis, m, between 0 and the play. A row of pads on elastic
            supports, which give way, has no such bound on its side.
        tilt : array_like (2,)
            Rotation of the collar about the first and the second axis, rad: the gap of the front
            row grows by tilt[0] y − tilt[1] x, that of the other one falls by it.
        speed, film, control, **keywords
            As of `ThrustBearing.pressure`.

        Raises
        ------
        loadflow.errors.InputError
            A gap that the play does not leave; values that are not finite.
        loadflow.errors.SolverError
            Pads that find no tilt without moment.
        """
        film, control = asked(film, more, control, keywords, knows_heat=True)
        least = -math.inf if self.front._softness else 0.0
        most = math.inf if self.back._softness else self.play
        require(least < gap < most, "gap", gap, f"m, between {least:g} and {most:g}")
        return self._held(gap, speed, (film, film), finite("tilt", tilt, 2), control)

    def _held(
        self, gap: float, speed: float, films: tuple[Film, Film], tilt: Array, control: Control
    ) -> DoubleThrustResult:
        """Both rows, each with its own film, at a gap of the front one."""
        front = self.front.pressure(gap, speed, films[0], tilt=tilt, control=control)
        back = self.back.pressure(self.play - gap, speed, films[1], tilt=-tilt, control=control)
        return DoubleThrustResult(
            front=front,
            back=back,
            force=front.force - back.force,
            gap=gap,
            minimum_film=min(front.minimum_film, back.minimum_film),
            maximum_pressure=max(front.maximum_pressure, back.maximum_pressure),
            friction_torque=front.friction_torque + back.friction_torque,
            friction_power=front.friction_power + back.friction_power,
            stiffness=front.stiffness + back.stiffness,
            damping=front.damping + back.damping,
            speed=float(speed),
            converged=front.converged and back.converged,
            residual=max(front.residual, back.residual),
            iterations=front.iterations + back.iterations,
        )

    def equilibrium(
        self,
        force: float,
        speed: float,
        film: Film | Lubricant | None = None,
        *more: Any,
        tilt: ArrayLike = (0.0, 0.0),
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> DoubleThrustResult:
        """Place of the collar at which both films carry `force`.

        Newton in 1/h² of the film that the force presses on, on which its force depends nearly
        linearly, kept between bounds.

        Parameters
        ----------
        force : float
            Along the axis, N; > 0 presses the collar on the front row.
        tilt : array_like (2,)
            As in `pressure`, held.
        speed, film, control, **keywords
            As of `ThrustBearing.equilibrium`.

        Returns
        -------
        DoubleThrustResult

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite or out of range.
        loadflow.errors.SolverError
            No film carries the force, with the reason; no room for the tilted collar.
        """
        film, control = asked(film, more, control, keywords, knows_heat=True)
        force, speed = finite("force", force), finite("speed", speed)
        turned, head = finite("tilt", tilt, 2), f"F = {force:.6g} N at ω = {speed:.6g} rad/s"
        if speed == 0.0:
            raise SolverError(f"{head}: {AT_REST}")
        if film.heat is None:
            return self._carrying(head, force, speed, (film, film), turned, control)
        heat, warm = cast("PadHeat", film.heat), [film.heat.inlet_temperature] * 2
        near, steps, tries = None, 0, 0
        for _ in range(TRIES):
            own = at_temperature(film, warm[0]), at_temperature(film, warm[1])
            near = found = self._carrying(head, force, speed, own, turned, control, near)
            steps, tries = steps + found.iterations, tries + 1
            rows = [warmed(row, heat, at) for row, at in zip((found.front, found.back), warm)]
            if all(map(is_settled, rows)):
                break
            warm = [next_temperature(row, heat) for row in rows]
        for row in rows if control.strict else ():
            check_balance(row)
        front, back = (replace(row, heat_iterations=tries) for row in rows)
        known = found.converged and front.converged and back.converged
        return replace(found, front=front, back=back, converged=known, iterations=steps)

    def _carrying(
        self,
        head: str,
        force: float,
        speed: float,
        films: tuple[Film, Film],
        turned: Array,
        control: Control,
        near: DoubleThrustResult | None = None,
    ) -> DoubleThrustResult:
        """Place at which isothermal films, one of each row, carry a force; from one that is near.

        Raises
        ------
        loadflow.errors.SolverError
            There is none.
        """
        limits = limits_of(control)
        pressed = 1.0 if force >= 0 else -1.0
        rows = (self.front, self.back) if pressed > 0 else (self.back, self.front)
        film = films[0] if pressed > 0 else films[1]
        given_way = rows[0]._given_way(film, speed)

        def at(inverse: float) -> DoubleThrustResult:
            own = 1.0 / math.sqrt(inverse) - given_way * inverse
            gap = own if pressed > 0 else self.play - own
            return self._held(gap, speed, films, turned, control)

        def inverse_at(gap: float) -> float:
            return 1.0 / rows[0]._thick_at("gap", gap, film, speed) ** 2

        def answer(found: DoubleThrustResult, error: float, converged: bool) -> DoubleThrustResult:
            residual = max(error, found.residual)
            return replace(found, residual=residual, iterations=spent, converged=converged)

        ends = [max(_CLOSED * self.play, self._reach(row, turned)) for row in rows]
        if sum(ends) >= self.play:
            raise SolverError(f"{head}: the play of {self.play:g} m has no room for the tilt")
        low, high = inverse_at(self.play - ends[1]), (1.0 / ends[0]) ** 2
        x, spent = (2.0 / self.play) ** 2, 0
        if near is not None:
            x = inverse_at(near.gap if pressed > 0 else self.play - near.gap)
        if not low < x < high:
            x = math.sqrt(low * high)
        for _ in range(_ROUNDS):
            found = at(x)
            spent += found.iterations
            missing = pressed * (force - found.force)
            scale = max(abs(force), found.front.force, found.back.force)
            error = abs(missing) / scale if scale > 0 else math.inf
            if found.converged and error < max(limits.tolerance, 1e-9):
                return answer(found, error, True)
            low, high = (x, high) if missing > 0 else (low, x)
            slope = found.stiffness * (0.5 * x**-1.5 + given_way)
            trial = x + missing / slope if slope > 0 else math.nan
            x = trial if low < trial < high else math.sqrt(low * high)
            if high / low - 1.0 < 1e-12:
                break
        if limits.strict:
            most = f"{pressed * found.force:.4g} N at a film of {1e6 / math.sqrt(x):.3g} µm"
            raise SolverError(f"{head}: no film carries it; {most}")
        return answer(found, error, False)

    def _reach(self, row: ThrustBearing, tilt: Array) -> float:
        """Film on the axis at which a tilted collar nearly touches the outer end of a row, m."""
        slope = float(np.hypot(*tilt))
        return (1.0 + _CLOSED) * slope * row.outer_radius
