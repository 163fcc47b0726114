"""What thrust bearings, cones and pairs of cones share: how their verbs are asked and answered."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.film_model import Control, Film, Keywords, film_and_control
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState
from loadflow.journal.solvers.assembly.orbit import series
from loadflow.journal.solvers.assembly.solve import Assembly, raise_not_converged
from loadflow.journal.thrust.pad_results import ConicalResult, PairResult
from loadflow.journal.thrust.pads import Pads, check_film, finite
from loadflow.journal.validity import warn_if_beyond_pressure
from loadflow.numerics.convergence import Limits

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Rows = NDArray[np.int64]
Answer = TypeVar("Answer", ConicalResult, PairResult)

AT_REST = "without rotation and squeeze the film carries no load"
SHIFTS = np.arange(3)
HELD = np.array([], dtype=np.int64)
_ROTATIONS = np.array([3, 4])


def asked(
    film: Film | Lubricant | None,
    more: tuple[Any, ...],
    control: Control | None,
    words: Keywords,
    knows_heat: bool = False,
) -> tuple[Film, Control]:
    """Film and control of a verb, of which films of pads and cones know all that is asked for."""
    film, control = film_and_control(film, more, control, words)
    return check_film(film, knows_heat), control


def limits_of(control: Control) -> Limits:
    """Limits of films at rest."""
    return control.limits(tolerance=1e-10, max_iterations=60)


def loading(
    load: Array, moment: ArrayLike | None, tilt: ArrayLike | None, shifts: Rows = SHIFTS
) -> tuple[Array, Array, Rows]:
    """Load (5,), held tilt (2,) and what moves: `shifts`, and the rotations under a moment.

    Raises
    ------
    loadflow.errors.InputError
        Moment and tilt together, or values that are not finite.
    """
    if moment is not None and tilt is not None:
        raise InputError("moment and tilt are both given: one follows from the other")
    turned = finite("tilt", (0.0, 0.0) if tilt is None else tilt, 2)
    wanted = np.append(load, np.zeros(2))
    if moment is None:
        return wanted, turned, shifts
    wanted[3:] = finite("moment", moment, 2)
    return wanted, turned, np.append(shifts, _ROTATIONS)


def check_gap(assembly: Assembly, state: AssemblyState) -> None:
    """Refuse a position at which the shaft touches the bearing.

    Raises
    ------
    loadflow.errors.InputError
        With the narrowest gap.
    """
    narrowest = assembly.narrowest(state)
    if narrowest <= 0.0:
        raise InputError(f"the shaft touches the bearing: narrowest gap {narrowest:.6g} m")


def answered(head: str, assembly: Assembly, state: AssemblyState, limits: Limits) -> AssemblyState:
    """The state; raises a SolverError where it must be an answer and is none."""
    if not state.converged and limits.strict:
        raise_not_converged(head, state, assembly.narrowest(state))
    return state


class PadBearing(ABC):
    """A bearing of one row of pads: its path over time.

    A kind says how a position of its own is stated, and what films it has there.
    """

    _axes: ClassVar[int]
    """Components of its force: 1 along the axis, or 3."""

    @property
    @abstractmethod
    def row(self) -> Pads:
        """The pads."""

    @property
    @abstractmethod
    def _shifts(self) -> Rows:
        """Those of the shaft's shifts that move freely."""

    equilibrium: Any

    @abstractmethod
    def _place_of(self, found: Any) -> Any:
        """Position of an equilibrium as `orbit` takes its start."""

    @abstractmethod
    def _films_at(
        self, film: Film, place: Any, tilt: Array, speeds: Array, free: Rows, control: Control
    ) -> tuple[Assembly, AssemblyState]:
        """Films for all `speeds` (n,), and their state with the shaft at a first position."""

    def orbit(
        self,
        time: ArrayLike,
        force: ArrayLike,
        speed: ArrayLike,
        film: Film | Lubricant | None = None,
        *more: Any,
        moment: ArrayLike | None = None,
        tilt: ArrayLike | None = None,
        start: ArrayLike | None = None,
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> xr.Dataset:
        """Path of the shaft under a load that changes with time.

        Implicit steps of second order from one time to the next, the oil in every cell conserved;
        a step at which Newton fails is cut, load and speed being straight lines between the times.
        Pads on their supports follow without inertia.

        Parameters
        ----------
        time : array_like (n,)
            s, increasing.
        force : array_like (n, 3) or (3,), of a thrust bearing (n,) or float
            What the shaft applies to the bearing, N; of a thrust bearing along the axis, > 0
            presses the runner on the pads.
        speed : array_like (n,) or float
            rad/s.
        moment : array_like (n, 2) or (2,), optional
            N m; the shaft then tilts freely.
        tilt : array_like (2,), optional
            Rotation of the shaft, rad, held (where it starts, with a moment); aligned by default.
        start : array_like (3,), of a thrust bearing float, optional
            First eccentricity, or first gap, m; default the equilibrium of the first load.
        film, control, **keywords
            As in `pressure`; each step is solved to 1e-8 in 30 Newton steps by default.

        Returns
        -------
        xarray.Dataset
            Over ``time``: eccentricity, of a thrust bearing gap; tilt, minimum_film,
            maximum_pressure, friction_power, load_share, residual, iterations.

        Raises
        ------
        loadflow.errors.InputError
            Misshapen, not finite or not increasing input.
        loadflow.errors.SolverError
            No equilibrium to start from, or a step that fails even when cut.
        """
        film, control = asked(film, more, control, keywords)
        times, forces, speeds, moments = series(time, force, speed, moment, self._axes)
        turned = finite("tilt", (0.0, 0.0) if tilt is None else tilt, 2)
        if start is None:
            words: dict[str, Any] = {"tilt": turned} if moment is None else {"moment": moments[0]}
            first = forces[0] if self._axes > 1 else float(forces[0, 0])
            found = self.equilibrium(first, float(speeds[0]), film, **words)
            place, turned = self._place_of(found), found.tilt
        else:
            place = finite("start", start, self._axes if self._axes > 1 else None)
        free = self._shifts if moment is None else np.append(self._shifts, _ROTATIONS)
        assembly, state = self._films_at(film, place, turned, speeds, free, control)
        loads = np.zeros((times.size, BODY))
        loads[:, self._shifts], loads[:, 3:] = self._signs * forces, moments
        path = self.row.orbit(assembly, state, times, loads, speeds, free, control)
        warn_if_beyond_pressure(path["maximum_pressure"], contact=False)
        return self._named(path, place)

    _signs: ClassVar[float] = 1.0
    """Of its force as a load along the axes of the shaft."""

    def _named(self, path: xr.Dataset, place: Any) -> xr.Dataset:
        """The path, its position as this kind of bearing states it."""
        return path


class ConicalFilms(ABC, Generic[Answer]):
    """Films on one cone or two: what they do at a given position of the shaft."""

    @abstractmethod
    def _assembly(self, film: Film, speed: float, moving: float) -> Assembly:
        """Films around a shaft that turns at `speed`, rad/s, and moves at `moving`, m/s."""

    @abstractmethod
    def _started(self, assembly: Assembly, position: Array, speed: float) -> AssemblyState:
        """Films from which Newton starts at a `position` (5,)."""

    @abstractmethod
    def _result(self, assembly: Assembly, state: AssemblyState, speed: float) -> Answer:
        """What is answered of a state."""

    def pressure(
        self,
        eccentricity: ArrayLike,
        speed: float,
        film: Film | Lubricant | None = None,
        *more: Any,
        velocity: ArrayLike = (0.0, 0.0, 0.0),
        tilt: ArrayLike = (0.0, 0.0),
        control: Control | None = None,
        **keywords: Unpack[Keywords],
    ) -> Answer:
        """Film at a given position of the shaft.

        Parameters
        ----------
        eccentricity : array_like (3,)
            Shaft relative to the bearing, m.
        speed : float
            rad/s.
        film : Film or Lubricant
            The film, or its liquid and its other fields as keywords; `grid` counts cells around and
            across, default (80, 20) for a whole ring, (40, 20) for each segment. There is no line
            of fresh oil: `inlet` is "auto" or None.
        velocity : array_like (3,)
            Of the shaft, m/s; segments on supports stay at rest.
        tilt : array_like (2,)
            Rotation of the shaft about the first and the second axis, rad.
        control : Control, optional
            How hard to solve; by default to 1e-10 in 60 Newton steps.
        **keywords
            Fields of `Film` and of `Control`.

        Returns
        -------
        ConicalResult
            Of two cones a `PairResult`.

        Raises
        ------
        loadflow.errors.InputError
            Values that are not finite or misshapen; a shaft that touches the bearing.
        loadflow.errors.SolverError
            No convergence.
        """
        film, control = asked(film, more, control, keywords)
        place, speed = finite("eccentricity", eccentricity, 3), finite("speed", speed)
        moving, turned = finite("velocity", velocity, 3), finite("tilt", tilt, 2)
        assembly = self._assembly(film, speed, float(np.linalg.norm(moving)))
        state = self._started(assembly, np.append(place, turned), speed)
        state = AssemblyState(state.position, np.append(moving, np.zeros(2)), state.members)
        check_gap(assembly, state)
        limits = limits_of(control)
        state = assembly.solve(state, np.zeros(BODY), HELD, limits)
        head = f"e = {place.tolist()} m, ω = {speed:.6g} rad/s"
        found = self._result(assembly, answered(head, assembly, state, limits), speed)
        warn_if_beyond_pressure(found.maximum_pressure, contact=False)
        return found
