"""The journal bearing as its user sees it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, Literal, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.film.discretise import operating_points
from loadflow.journal.film_model import Film, Keywords, film_and_control
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.grid_bounds import warn_if_path_unresolved, warn_if_unresolved
from loadflow.journal.heat import Entering
from loadflow.journal.heat_results import FilmHeatEquilibrium, FilmHeatField
from loadflow.journal.line import Line
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.models.model import model_of
from loadflow.journal.questions import AtPosition, AtRest, InMotion, Steps
from loadflow.journal.results import Equilibrium, FilmField, WarmEquilibrium
from loadflow.journal.rows import shaped, start_rows, starts_of
from loadflow.journal.solvers.search import searches
from loadflow.journal.thermal import TOLERANCE, at_temperatures, shares, warm_film
from loadflow.journal.validity import warn_if_beyond_pressure, warn_if_turbulent
from loadflow.journal.warm_orbit import warm_orbit
from loadflow.numerics.convergence import Control, Limits
from loadflow.numerics.fields import require

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]


@dataclass(frozen=True)
class JournalBearing(JournalGeometry):
    """Journal bearing: a shaft that turns in a bore, carried by a film of oil.

    It is a `JournalGeometry` and what happens in it. Its verbs take a `Film`, or a `Lubricant` and
    the fields of `Film` and `Control` as keywords.

    Attributes
    ----------
    diameter, width : float
        Bore D and width B, m.
    relative_clearance : float
        ψ = clearance/diameter; the radial clearance is c = ψ D/2.
    shape : Cylindrical, Arc, Lobes or TiltingPads
        How the bore runs around.
    relief : tuple of Crown, Recess or Contour
        What widens the gap of that shape.

    Examples
    --------
    >>> from loadflow.journal import Film, GasMixture, JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    >>> film = Film(Lubricant(0.05), GasMixture(0.05e6), edge_pressure=0.5e6, grid=(60, 20))
    >>> state = bearing.equilibrium((2.0586e6, 0.4428e6), 1.2451, film)
    >>> round(float(state.eccentricity_ratio), 2)
    0.61
    """

    def equilibrium(
        self,
        force: ArrayLike,
        speed: ArrayLike,
        film: Film | Lubricant | None = None,
        *more: Any,
        control: Control | None = None,
        moment: ArrayLike | None = None,
        tilt: ArrayLike | None = None,
        bend: ArrayLike | None = None,
        whirl: float = 0.0,
        weights: ArrayLike | None = None,
        near: Equilibrium | None = None,
        heat_tolerance: float = TOLERANCE,
        **keywords: Unpack[Keywords],
    ) -> Equilibrium:
        """Position of the shaft in which the film carries `force` at rest.

        Parameters
        ----------
        force : array_like (…, 2)
            What the shaft applies to the bearing, N; broadcasts with `speed`.
        speed : array_like (…)
            Speed of the shaft, rad/s, > 0 from the first axis toward the second.
        film : Film or Lubricant
            The film, or its liquid and its other fields as keywords (or in their order).
        control : Control, optional
            How hard to solve; by default to 1e-10 in 60 Newton steps per load. The rupture of the
            law of Reynolds moves by a cell in a step, so that it has at least one for each cell
            around.
        moment : array_like (…, 2), optional
            What the shaft applies to the bearing about its middle, N m, about the first and the
            second axis; the shaft then tilts freely. Needs the full width.
        tilt : array_like (…, 2), optional
            Rotation of the shaft about the first and the second axis, rad, held. The third axis,
            along the shaft, makes the three right-handed: at z the shaft is displaced by
            (tilt[1] z, −tilt[0] z).
        bend : array_like (…, 2), optional
            Curvature of the shaft, 1/m: at z it is displaced by bend z²/2.
        whirl : float
            Frequency, rad/s, at which tilting pads are condensed out of stiffness and damping: the
            speed for synchronous coefficients, 0 for slow changes.
        weights : array_like (…), optional
            With heat, shares of time of the loads: all then have one temperature, that of their
            mean friction and flow, as in a bearing too slow to follow the load. Without, each load
            has its own.
        near : Equilibrium, optional
            Answer under these loads of a bearing that differs little, such as by its oil: shafts on
            tilting pads, and with heat temperatures, are looked for from there on.
        heat_tolerance : float
            What may be left of a balance of one temperature, K.
        **keywords
            Fields of `Film` and of `Control`.

        Returns
        -------
        Equilibrium
            A `WarmEquilibrium`, with its temperatures, where the film has heat; with an energy
            equation over its area a `FilmHeatEquilibrium`, whose stiffness and damping are those of
            the film at the temperature that it has (which does not follow fast motion).

        Raises
        ------
        InputError
            Not finite or misshapen input; a law without oil (a mixture at edge pressure 0); a
            `Film` together with one of its own keywords.
        SolverError
            A load at ω = 0 (no film without squeeze), no convergence, a film that gets too hot, or
            a shaft that touches the bore wherever it is; names the first such load.

        Warns
        -----
        ValidityWarning
            Turbulent flow without `turbulence`, cells that do not resolve the film, a pressure that
            oil and shell do not bear.
        """
        film, control = film_and_control(film, more, control, keywords)
        limits = control.limits(tolerance=1e-10, max_iterations=60)
        loads, speeds, shape = operating_points(force, speed, "force")
        line = Line.of(shape, whirl, moment=moment, tilt=tilt, bend=bend)
        model, starts = model_of("at_rest", film, self, line), starts_of(self, speeds.size, near)
        known = None
        if film.heat is not None and not film.heat.over_area:
            known = searches(speeds.size, together=weights is not None)
        line = replace(line, near=starts, searches=known)
        require(heat_tolerance > 0, "heat_tolerance", heat_tolerance, "> 0")
        if film.heat is None:
            require(weights is None, "weights", weights, "None without heat")
            warn_if_turbulent(self, speeds, film.liquid, film.turbulence)
            answer = model.equilibrium(AtRest(self, film, loads, speeds, line, limits))
            warn_if_unresolved(answer)
            warn_if_beyond_pressure(answer["maximum_pressure"])
            return Equilibrium(**shaped(answer, shape))
        if film.heat.over_area:
            require(weights is None, "weights", weights, "None with heat over the area")
            answer = model.equilibrium(AtRest(self, film, loads, speeds, line, limits))
            thinnest = _hottest(film.heat, answer["maximum_temperature"])
            warn_if_turbulent(self, speeds, thinnest, film.turbulence)
            warn_if_unresolved(answer)
            warn_if_beyond_pressure(answer["maximum_pressure"])
            return FilmHeatEquilibrium(**shaped(answer, shape))

        each = replace(limits, strict=False)

        def solve(
            grown: JournalGeometry,
            cold: Film,
            force: Array,
            speed: Array,
            places: NDArray[np.int64],
            how: Limits = each,
        ) -> dict[str, Any]:
            found = model.equilibrium(AtRest(grown, cold, force, speed, line.at(places), how))
            if starts is not None:  # a film that is a little warmer is near
                starts[places] = start_rows(grown, found)
            return found

        share, at_rest = shares(weights, shape), at_temperatures(solve, self, film)
        why = at_temperatures(partial(solve, how=limits), self, film)
        known = getattr(near, "temperature", None) if share is None else None
        start = None if known is None else np.broadcast_to(known, shape).ravel()
        answer = warm_film(
            at_rest, loads, speeds, film, share, heat_tolerance,
            strict=limits.strict, start=start, why=why,
        )  # fmt: skip
        thinnest = _hottest(film.heat, answer["temperature"])
        warn_if_turbulent(self, speeds, thinnest, film.turbulence)
        warn_if_unresolved(answer)
        warn_if_beyond_pressure(answer["maximum_pressure"])
        return WarmEquilibrium(**shaped(answer, shape))

    def pressure(
        self,
        eccentricity: ArrayLike,
        speed: ArrayLike,
        film: Film | Lubricant | None = None,
        velocity: ArrayLike = (0.0, 0.0),
        *more: Any,
        control: Control | None = None,
        tilt: ArrayLike | None = None,
        bend: ArrayLike | None = None,
        **keywords: Unpack[Keywords],
    ) -> FilmField:
        """Film at a given position and velocity of the shaft.

        Parameters
        ----------
        eccentricity : array_like (…, 2)
            Shaft centre relative to the shell, m.
        speed : array_like (…)
            rad/s.
        film : Film or Lubricant
            As in `equilibrium`; without heat, or with heat over the area and at rest.
        velocity : array_like (…, 2)
            Velocity of the shaft centre, m/s. The squeeze is F ∂h/∂t, the fill is quasi-steady.
        control : Control, optional
            How hard to solve; by default to 1e-10 in 100 Newton steps per position.
        tilt, bend, **keywords
            As in `equilibrium`. Pads that tilt are where their film has no moment about the pivot.

        Returns
        -------
        FilmField
            With heat a `FilmHeatField`. The cells are those of an equilibrium there: `force` is the
            load that `equilibrium` carries at this position. Where they are graded for some of many
            positions, pressure, fill and gap of all are shown on as many.

        Warns
        -----
        ValidityWarning
            The cells do not resolve the film, or its pressure is beyond 0.5 GPa.

        Raises
        ------
        InputError
            Not finite or misshapen input, a shaft that touches the bore.
        SolverError
            No convergence.
        """
        film, control = film_and_control(film, more, control, keywords)
        limits = control.limits(tolerance=1e-10, max_iterations=100)
        both = np.broadcast_arrays(
            np.asarray(eccentricity, dtype=float), np.asarray(velocity, dtype=float)
        )
        places, speeds, shape = operating_points(both[0], speed, "eccentricity")
        velocities, _, _ = operating_points(both[1], speed, "velocity")
        places, velocities = places / self.clearance, velocities / self.clearance
        line = Line.of(shape, tilt=tilt, bend=bend)
        model = model_of("at_position", film, self, line)
        asked = AtPosition(self, film, places, velocities, speeds, line, limits)
        found, z = model.pressure(asked)
        warn_if_unresolved(found)
        warn_if_beyond_pressure(found["maximum_pressure"])
        kind = FilmField if film.heat is None else FilmHeatField
        return kind(z=z, **shaped(found, shape))

    def orbit(
        self,
        time: ArrayLike,
        force: ArrayLike,
        speed: ArrayLike,
        film: Film | Lubricant | None = None,
        *more: Any,
        control: Control | None = None,
        start: ArrayLike | None = None,
        step: Literal["given", "adaptive"] = "given",
        step_tolerance: float = 1e-3,
        periodic: bool | Literal["direct", "marching"] = False,
        closure: float = 1e-6,
        max_periods: int = 100,
        moment: ArrayLike | None = None,
        tilt: ArrayLike | None = None,
        bend: ArrayLike | None = None,
        **keywords: Unpack[Keywords],
    ) -> xr.Dataset:
        """Path of the shaft under a load that changes with time, or repeats.

        Implicit steps of second order from one time to the next, squeeze and fill in the same
        operator as the static film; a step at which Newton fails is cut, the load interpolated.

        Parameters
        ----------
        time : array_like (n,)
            s, increasing.
        force : array_like (n, 2)
            What the shaft applies to the bearing, N.
        speed : array_like (n,) or float
            rad/s.
        film : Film or Lubricant
            As in `equilibrium`; laws with fill keep it in cells fixed to the shell, so that their
            mesh is uniform and without an inlet line. With `Heat` the result has the `temperature`
            of the film: one that follows its heat balance where heat is stored, else that of the
            mean friction and flow of the series; with `FilmHeat` the temperatures over its area are
            those of the mean heat of films at rest under loads of the series. "map" and the
            historical methods add ``in_range``, whether they cover the path; "butenschoen" and
            "holland" know no pressure, flow or fill. An elastic shell has no inertia; the result
            then has its `shell_deformation`.
        control : Control, optional
            How hard to solve; by default to 1e-8 in 30 Newton steps per time step.
        start : array_like (2,), optional
            First eccentricity, m; default the static equilibrium of the first load.
        step : {"given", "adaptive"}
            One step from each time to the next, or as many as the accuracy asks for; load and
            speed are straight lines between the times. "grid" and "reduced" adapt, this one not on
            a closed path.
        step_tolerance : float
            Error of an adaptive step, share of the narrowest gap.
        periodic : bool or {"direct", "marching"}
            Find the closed orbit; `time` is one period, whose last sample closes it. True is
            "direct": the state that comes back after a period, solved for, or where that takes
            long around an aligned cylinder and the law keeps no fill, all times at once;
            "marching" goes on from period to period. Only "grid" and "reduced" close orbits, this
            one from the state that comes back alone.
        closure : float
            Largest change of position (clearances) and film (over the scale of pressure) from one
            period to the next.
        max_periods : int
            Periods to go through at most.
        moment : array_like (n, 2), optional
            What the shaft applies to the bearing about its middle, N m; the shaft then tilts
            freely. Without it and `tilt` the shaft stays aligned.
        tilt, bend : array_like (n, 2), optional
            How the shaft lies at each time, as in `equilibrium`, straight lines between; those of a
            period end as they begin. With any of the three the result has the `tilt` and `moment`
            of the film and its asperities.
        **keywords
            Fields of `Film` and of `Control`.

        Returns
        -------
        xarray.Dataset
            Over ``time`` (and ``axis``, ``groove``, ``pad``): eccentricity_ratio, eccentricity,
            attitude_angle, minimum_film, maximum_pressure, friction_power, side_flow, supply_flow,
            supply_power, total_fill, groove_flow, groove_pressure, residual, iterations; steps
            where they adapt; pad_tilt where pads tilt, 0 of those that no film holds; with `Heat`
            ``temperature``, K, and ``clearance``, m, where the bearing grows as it warms.
            Attributes: ``mass_balance``, what entered the film less what left and what stayed, over
            what left; of a closed orbit ``closure`` and ``periods``; on "grid" bounds of what the
            cells do to the narrowest film, m, and the largest pressure, Pa,
            ``minimum_film_grid_error`` and ``maximum_pressure_grid_error``, and ``resolved``, 0
            where they do not resolve the film; where the cells are fixed to the shell
            ``cells_around``, more than asked for if the path stops between these.

        Warns
        -----
        ValidityWarning
            The cells do not resolve the narrowest film of the path, or its pressure is beyond
            0.5 GPa.

        Raises
        ------
        InputError
            Misshapen, not finite or not increasing input.
        SolverError
            No equilibrium to start from, a step that fails even when cut, an orbit that does not
            close, or a load that turns at half the speed of the shaft.
        """
        film, control = film_and_control(film, more, control, keywords)
        limits = control.limits(tolerance=1e-8, max_iterations=30)
        loads, speeds, shape = operating_points(force, speed, "force")
        warn_if_turbulent(self, speeds, film.liquid, film.turbulence)
        times = np.asarray(time, dtype=float)
        if times.shape != shape:
            raise InputError(f"time {times.shape} and force, speed {shape} differ in shape")
        bad = np.flatnonzero(~(np.diff(times) > 0))
        if bad.size:
            raise InputError(f"time[{bad[0] + 1}] = {times[bad[0] + 1]} does not increase")
        place = None if start is None else np.asarray(start, dtype=float) / self.clearance
        steps = Steps(place, step, step_tolerance, periodic, closure, max_periods)
        line = Line.of(shape, moment=moment, tilt=tilt, bend=bend)
        model = model_of("in_motion", film, self, line, steps)
        follow = model.orbit
        if film.heat is not None and not film.heat.over_area:
            follow = partial(warm_orbit, model)
        path = follow(InMotion(self, film, times, loads, speeds, line, limits, steps))
        warn_if_path_unresolved(path)
        if "maximum_pressure" in path:
            warn_if_beyond_pressure(path["maximum_pressure"])
        return path


def _hottest(heat: Entering, temperatures: Array) -> Lubricant:
    """The oil of a film at the largest of `temperatures`, K; as it enters, if there is none."""
    return heat.lubricant(float(np.nanmax([heat.inlet_temperature, *temperatures])))
