"""The plain journal bearing as its user sees it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from annotated_types import Gt, Lt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.film.discretise import FilmOptions, Grading, Inlet, operating_points
from loadflow.journal.film.film import EVERY
from loadflow.journal.models.model import Control, Rung, check_rung, model
from loadflow.journal.options import Cavitation, Lubricant, require
from loadflow.journal.results import Equilibrium, FilmField, shaped, stack
from loadflow.journal.shapes import CYLINDER, Relief, Shape
from loadflow.journal.shells import Shell
from loadflow.journal.solvers.periodic import (
    Method,
    check_period,
    close_orbit,
    refuse_half_speed_whirl,
)
from loadflow.journal.solvers.statics import plain_fields, plain_film, plain_rows, plain_start
from loadflow.journal.solvers.statics_shaped import (
    Line,
    equilibrium_rows,
    field_rows,
    orbit_start,
    plain,
)
from loadflow.journal.solvers.transient import (
    Marcher,
    march,
    mass_balance,
    orbit_dataset,
    orbit_row,
)
from loadflow.journal.supply import Supply
from loadflow.journal.validity import warn_if_turbulent

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_METHODS = (False, True, "direct", "marching")


@dataclass(frozen=True)
class JournalBearing:
    """Journal bearing.

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
    >>> from loadflow.journal import GasMixture, JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    >>> state = bearing.equilibrium(
    ...     force=(2.0586e6, 0.4428e6), speed=1.2451, lubricant=Lubricant(0.05),
    ...     cavitation=GasMixture(0.05e6), edge_pressure=0.5e6, grid=(60, 20))
    >>> round(float(state.eccentricity_ratio), 2)
    0.61
    """

    diameter: Annotated[float, Gt(0)]
    width: Annotated[float, Gt(0)]
    relative_clearance: Annotated[float, Gt(0), Lt(0.1)]
    shape: Shape = CYLINDER
    relief: tuple[Relief, ...] = ()

    def __post_init__(self) -> None:
        require(self.diameter > 0, "diameter", self.diameter, "m, > 0")
        require(self.width > 0, "width", self.width, "m, > 0")
        psi = self.relative_clearance
        require(0 < psi < 0.1, "relative_clearance", psi, "0 … 0.1")
        object.__setattr__(self, "relief", tuple(self.relief))

    @property
    def radius(self) -> float:
        """Shaft radius, m."""
        return 0.5 * self.diameter

    @property
    def clearance(self) -> float:
        """Radial clearance c, m."""
        return self.relative_clearance * self.radius

    def sommerfeld_number(self, force: float, speed: float, viscosity: float) -> float:
        """So = F ψ²/(B D η |ω|), (1.13) of the source; 0 without load."""
        if force == 0.0:
            return 0.0
        drag = self.width * self.diameter * viscosity * abs(speed)
        return force * self.relative_clearance**2 / drag if drag else np.inf

    def equilibrium(
        self,
        force: ArrayLike,
        speed: ArrayLike,
        lubricant: Lubricant,
        cavitation: Cavitation | None = None,
        edge_pressure: float = 0.0,
        supply: Supply | None = None,
        inlet: Inlet = "auto",
        grid: tuple[int, int] | None = None,
        grading: Grading = "auto",
        rung: Rung = "grid",
        tolerance: float = 1e-10,
        max_iterations: int = 60,
        strict: bool = True,
        moment: ArrayLike | None = None,
        tilt: ArrayLike | None = None,
        bend: ArrayLike | None = None,
        whirl: float = 0.0,
        shell: Shell | None = None,
    ) -> Equilibrium:
        """Position of the shaft in which the film carries `force` at rest.

        Parameters
        ----------
        force : array_like (…, 2)
            What the shaft applies to the bearing, N; broadcasts with `speed`.
        speed : array_like (…)
            Speed of the shaft, rad/s, > 0 from the first axis toward the second.
        lubricant : Lubricant
            The liquid.
        cavitation : GasMixture, Sommerfeld, Guembel, Reynolds or MassConserving
            Law of the ruptured film; default ``Reynolds()``.
        edge_pressure : float
            Pressure at both rims and on an inlet line, Pa, absolute.
        supply : Supply, optional
            Grooves of the shell.
        inlet : {"auto", "widest gap"} or None
            Inlet line at the widest gap (ISO 7902) or none. "auto": the line for Reynolds and
            Gümbel without a supply.
        grid : tuple of int, optional
            Cells around and across the full width (even; half is solved). Default (60, 20) for the
            gas mixture, (120, 40) else.
        grading : {"auto", "uniform", "graded"}
            Uniform cells, or cells that crowd at the narrowest gap and the rims. "auto": uniform
            for the gas mixture and with a supply, graded else. A load so heavy that a few uniform
            cells span the narrowest gap is then solved on a graded mesh.
        rung : {"grid", "reduced", "map", "chart", "table", "butenschoen", "holland", "hahn"}
            Model: finite volumes; few unknowns across the width; the map of `mobility`; closed
            forms and tables of ISO 7902, which leave total_fill, stiffness and damping None; the
            historical methods of `superposed`.
        tolerance : float
            On the scaled residual.
        max_iterations : int
            Newton steps per load; with the law of Reynolds at least one for each cell around, as
            its rupture moves by a cell in a step.
        strict : bool
            Raise for the first load without an answer; else its results are NaN and `converged`
            is False.
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
        shell : LocalShell, LinedShell, ThickShell or MatrixShell, optional
            Elastic shell, whose gap follows the pressure above that of the rims; rigid by default.

        Returns
        -------
        Equilibrium

        Raises
        ------
        InputError
            Not finite or misshapen input; a law without oil (a mixture at edge pressure 0).
        SolverError
            A load at ω = 0 (no film without squeeze), no convergence, or a shaft that touches the
            bore wherever it is; names the first such load.
        """
        check_rung(rung)
        options = FilmOptions(
            lubricant, cavitation, edge_pressure, supply, inlet, grid, grading, shell
        )
        loads, speeds, shape = operating_points(force, speed, "force")
        warn_if_turbulent(self, speeds, lubricant)
        line = Line.of(shape, moment=moment, tilt=tilt, bend=bend)
        if not self._plain(line, shell, rung):
            control = Control(tolerance, max_iterations, strict)
            found = equilibrium_rows(self, options, loads, speeds, line, control, whirl)
            return Equilibrium(**stack(found, shape))
        if rung != "grid":
            control = Control(tolerance, max_iterations, strict)
            answer = model(rung).equilibrium(self, options, loads, speeds, control)
            return Equilibrium(**shaped(answer, shape))
        control = Control(tolerance, max_iterations, strict)
        rows = plain_rows(self, options, loads, speeds, control)
        return Equilibrium(**stack(rows, shape))

    def pressure(
        self,
        eccentricity: ArrayLike,
        speed: ArrayLike,
        lubricant: Lubricant,
        velocity: ArrayLike = (0.0, 0.0),
        cavitation: Cavitation | None = None,
        edge_pressure: float = 0.0,
        supply: Supply | None = None,
        inlet: Inlet = "auto",
        grid: tuple[int, int] | None = None,
        grading: Grading = "auto",
        tolerance: float = 1e-10,
        max_iterations: int = 100,
        strict: bool = True,
        tilt: ArrayLike | None = None,
        bend: ArrayLike | None = None,
        shell: Shell | None = None,
    ) -> FilmField:
        """Film at a given position and velocity of the shaft.

        Parameters
        ----------
        eccentricity : array_like (…, 2)
            Shaft centre relative to the shell, m.
        speed : array_like (…)
            rad/s.
        lubricant : Lubricant
            The liquid.
        velocity : array_like (…, 2)
            Velocity of the shaft centre, m/s. The squeeze is F ∂h/∂t, the fill is quasi-steady.
        cavitation, edge_pressure, supply, inlet, grid, grading, tolerance, max_iterations, \
strict, tilt, bend, shell
            As in `equilibrium`. Pads that tilt are where their film has no moment about the pivot.

        Returns
        -------
        FilmField

        Raises
        ------
        InputError
            Not finite or misshapen input, a shaft that touches the bore.
        SolverError
            No convergence.
        """
        options = FilmOptions(
            lubricant, cavitation, edge_pressure, supply, inlet, grid, grading, shell
        )
        both = np.broadcast_arrays(
            np.asarray(eccentricity, dtype=float), np.asarray(velocity, dtype=float)
        )
        places, speeds, shape = operating_points(both[0], speed, "eccentricity")
        velocities, _, _ = operating_points(both[1], speed, "velocity")
        places, velocities = places / self.clearance, velocities / self.clearance
        line = Line.of(shape, tilt=tilt, bend=bend)
        if not self._plain(line, shell, "grid"):
            control = Control(tolerance, max_iterations, strict)
            found, z = field_rows(self, options, places, velocities, speeds, line, control)
            return FilmField(z=z if z[0] < 0 else np.append(-z[::-1], z), **stack(found, shape))
        control = Control(tolerance, max_iterations, strict)
        found, z = plain_fields(self, options, places, velocities, speeds, control)
        return FilmField(z=np.concatenate([-z[::-1], z]), **stack(found, shape))

    def orbit(
        self,
        time: ArrayLike,
        force: ArrayLike,
        speed: ArrayLike,
        lubricant: Lubricant,
        cavitation: Cavitation | None = None,
        edge_pressure: float = 0.0,
        supply: Supply | None = None,
        inlet: Inlet = "auto",
        grid: tuple[int, int] | None = None,
        grading: Grading = "auto",
        rung: Rung = "grid",
        start: ArrayLike | None = None,
        tolerance: float = 1e-8,
        max_iterations: int = 30,
        step: Literal["given", "adaptive"] = "given",
        step_tolerance: float = 1e-3,
        periodic: bool | Literal["direct", "marching"] = False,
        closure: float = 1e-6,
        max_periods: int = 100,
        moment: ArrayLike | None = None,
        shell: Shell | None = None,
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
        lubricant, cavitation, edge_pressure, supply, inlet, grid, grading
            As in `equilibrium`; laws with fill keep it in cells fixed to the shell, so that their
            mesh is uniform and without an inlet line.
        rung : {"grid", "reduced", "map", "butenschoen", "holland", "hahn"}
            Model, as in `equilibrium`. "map" and the historical methods add ``in_range``, whether
            they cover the path; "butenschoen" and "holland" know no pressure, flow or fill.
        start : array_like (2,), optional
            First eccentricity, m; default the static equilibrium of the first load.
        tolerance : float
            On the scaled residual of a step.
        max_iterations : int
            Newton steps per time step.
        step : {"given", "adaptive"}
            One step from each time to the next, or as many as the accuracy asks for; load and
            speed are straight lines between the times. Only "grid" adapts.
        step_tolerance : float
            Error of an adaptive step, share of the narrowest gap.
        periodic : bool or {"direct", "marching"}
            Find the closed orbit; `time` is one period, whose last sample closes it. True is
            "direct": the state that comes back after a period, solved for; "marching" goes on from
            period to period. Only "grid" closes orbits.
        closure : float
            Largest change of position (clearances) and film (over the scale of pressure) from one
            period to the next.
        max_periods : int
            Periods to go through at most.
        moment : array_like (n, 2), optional
            What the shaft applies to the bearing about its middle, N m; the shaft then tilts, and
            the result has its `tilt`. Without it the shaft stays aligned.
        shell : LocalShell, LinedShell, ThickShell or MatrixShell, optional
            Elastic shell, without inertia; the result then has its `shell_deformation`.

        Returns
        -------
        xarray.Dataset
            Over ``time`` (and ``axis``, ``groove``): eccentricity_ratio, eccentricity,
            attitude_angle, minimum_film, maximum_pressure, friction_power, side_flow, supply_flow,
            supply_power, total_fill, groove_flow, groove_pressure, residual, iterations; steps
            where they adapt.
            Attributes: ``mass_balance``, what entered the film less what left and what stayed, over
            what left; of a closed orbit ``closure`` and ``periods``.

        Raises
        ------
        InputError
            Misshapen, not finite or not increasing input.
        SolverError
            No equilibrium to start from, a step that fails even when cut, an orbit that does not
            close, or a load that turns at half the speed of the shaft.
        """
        check_rung(rung)
        options = FilmOptions(
            lubricant, cavitation, edge_pressure, supply, inlet, grid, grading, shell
        )
        loads, speeds, shape = operating_points(force, speed, "force")
        warn_if_turbulent(self, speeds, lubricant)
        times = np.asarray(time, dtype=float)
        if times.shape != shape:
            raise InputError(f"time {times.shape} and force, speed {shape} differ in shape")
        bad = np.flatnonzero(~(np.diff(times) > 0))
        if bad.size:
            raise InputError(f"time[{bad[0] + 1}] = {times[bad[0] + 1]} does not increase")
        place = None if start is None else np.asarray(start, dtype=float) / self.clearance
        line = Line.of(shape, moment=moment)
        aligned = self._plain(line, shell, rung)
        if place is not None and aligned:
            require(bool(np.hypot(*place) < 1), "start", start, f"|start| < c = {self.clearance} m")
        require(step in ("given", "adaptive"), "step", step, '"given" or "adaptive"')
        require(step_tolerance > 0, "step_tolerance", step_tolerance, "> 0")
        require(periodic in _METHODS, "periodic", periodic, 'False, True, "direct" or "marching"')
        if rung != "grid":
            require(step == "given", "step", step, f'"given" for rung = "{rung}"')
            require(not periodic, "periodic", periodic, f'False for rung = "{rung}"')
            control = Control(tolerance, max_iterations)
            return model(rung).orbit(self, options, times, loads, speeds, place, control)
        if periodic:
            check_period(times, loads, speeds)
        control = Control(tolerance, 2 * max_iterations)
        free: slice | NDArray[np.int64] = EVERY
        if aligned:
            film = plain_film(self, options.for_history(), speeds)
            if periodic and not film.pockets.lifts(film.p_edge):
                refuse_half_speed_whirl(times, loads, speeds)
            first, forces = plain_start(self, film, loads, speeds, place, control), loads
        else:
            film, first, forces, free = orbit_start(
                self, options, loads, speeds, line, place, control
            )
        accuracy = step_tolerance if step == "adaptive" else np.inf
        marcher = Marcher(film, tolerance, max_iterations, accuracy, free)
        if periodic:
            way: Method = "marching" if periodic == "marching" else "direct"
            rows, ends, about = close_orbit(
                marcher, first, times, forces, speeds, way, closure, max_periods
            )
        else:
            past = marcher.begin(float(times[0]), first)
            rows, end = march(marcher, past, times, forces, speeds)
            rows, ends, about = [orbit_row(film, first, 0), *rows], (past[-1], end[-1]), {}
        values = {name: np.array([row[name] for row in rows]) for name in rows[0]}
        if step == "given":
            del values["steps"]
        about["mass_balance"] = mass_balance(*ends, rows, times)
        orbit = orbit_dataset(values, times, loads, speeds, self.clearance)
        return orbit.assign_attrs(about)

    # --- inside ----------------------------------------------------------------------------------
    def _plain(self, line: Line, shell: Shell | None, rung: Rung) -> bool:
        """Whether a rigid cylinder surrounds an aligned shaft; if not, only the grid serves."""
        if plain(self, line) and shell is None:
            return True
        allowed = '"grid" for a shaped bore, an elastic shell or a shaft that tilts or bends'
        require(rung == "grid", "rung", rung, allowed)
        return False
