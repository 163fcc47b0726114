"""From a wind condition to the field that the rotor flies through."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from loadflow.wind import gusts
from loadflow.wind.box import Box
from loadflow.wind.coherence import CoherenceFactors, PolarGrid
from loadflow.wind.expansion import Condition
from loadflow.wind.field import Field, polar_angles
from loadflow.wind.iec import length_scale
from loadflow.wind.mann import mann_box
from loadflow.wind.options import Machine, WindOptions
from loadflow.wind.seeding import case_seed
from loadflow.wind.turbulence import Method, kaimal, sample_times

DRAWN_STEP = 0.05
"""Step down to which the noise of a field is drawn, s: a field of a longer step is the same wind,
gust for gust, without what is faster than it can show."""


def rotor_grid(machine: Machine, options: WindOptions) -> PolarGrid:
    """Polar grid over the rotor: equidistant radii from the hub to the tip.

    Parameters
    ----------
    machine : Machine
        The turbine.
    options : WindOptions
        Number of radii and angles.

    Returns
    -------
    PolarGrid
        Radii from 0 to half the diameter of the rotor, m, and angles, rad.

    Examples
    --------
    >>> from loadflow.wind import Machine, WindOptions, rotor_grid
    >>> machine = Machine(
    ...     cut_in=3.0, rated=11.4, cut_out=25.0, rotor_diameter=126.0, hub_height=90.0
    ... )
    >>> grid = rotor_grid(machine, WindOptions(radii=3, angles=12))
    >>> grid.radius.tolist()
    [0.0, 31.5, 63.0]
    """
    radius = np.linspace(0.0, machine.rotor_diameter / 2, options.radii)
    return PolarGrid(radius, polar_angles(options.angles))


def coherence_factors(machine: Machine, options: WindOptions) -> CoherenceFactors:
    """Factors for `inflow`, good for all conditions of a study.

    Parameters
    ----------
    machine : Machine
        The turbine.
    options : WindOptions
        Number of radii and angles; nothing else of them counts.

    Returns
    -------
    CoherenceFactors
        Cholesky factors of the coherence between the points of the grid, to be handed to `inflow`.

    Examples
    --------
    >>> from loadflow.wind import Machine, WindOptions, coherence_factors
    >>> factors = coherence_factors(Machine(3.0, 11.4, 25.0, 126.0, 90.0), WindOptions(radii=3,
    ...     angles=8))
    >>> factors.table.shape[0] > 1
    True
    """
    return CoherenceFactors(rotor_grid(machine, options), length_scale(machine.hub_height))


_factors = lru_cache(maxsize=2)(coherence_factors)


def inflow(
    condition: Condition,
    machine: Machine,
    options: WindOptions | None = None,
    *,
    seed: int = 0,
    factors: CoherenceFactors | None = None,
    components: str = "uvw",
    method: Method = "fast",
) -> Field:
    """Make the wind of a condition: turbulence or a gust, on the polar grid of the options.

    Parameters
    ----------
    condition : Condition
        One of `conditions`.
    machine, options
        As for `conditions`.
    seed : int
        Seed of the scene; the condition's own seed follows from it (`case_seed`).
    factors : CoherenceFactors, optional
        From `coherence_factors`, to save making them anew.
    components, method
        As for `kaimal`; the Mann model has all three.

    Returns
    -------
    Field
        Wind over time on the polar grid, m/s.

    Notes
    -----
    The mean yaw error of the condition is not in the field: it turns the mean wind as well, and the
    rotor does that.

    Examples
    --------
    >>> from loadflow.wind import Machine, WindOptions, conditions, inflow
    >>> machine, options = Machine(3.0, 11.4, 25.0, 126.0, 90.0), WindOptions(radii=3, angles=8)
    >>> case = conditions("1.1", machine, options, wind_speeds=[12.0], duration=20.0)[0]
    >>> field = inflow(case, machine, options)
    >>> field.wind_speed, field.u.shape[1:]  # radius, angle
    (12.0, (3, 8))
    """
    options = options or WindOptions()
    grid = rotor_grid(machine, options)
    seeds = case_seed(condition.dlc, condition.wind_speed, condition.index, seed)
    if condition.sigma > 0 and options.spectrum == "mann":
        return _mann(condition, machine, options, seeds).to_polar(grid.radius, grid.angle)
    if condition.sigma > 0:
        return kaimal(
            condition.wind_speed,
            condition.sigma,
            radius=grid.radius,
            angles=grid.angle,
            hub_height=machine.hub_height,
            duration=condition.duration,
            dt=options.step,
            seed=seeds,
            shear_exponent=condition.shear_exponent,
            components=components,
            scaling=options.scaling,
            lateral=options.lateral,
            method=method,
            factors=factors or (_factors(machine, options) if method == "fast" else None),
            oversampled=max(1, round(options.step / DRAWN_STEP)),
        )
    time = sample_times(condition.duration, options.step)
    return gusts.gust_field(
        time,
        grid.radius,
        grid.angle,
        condition.wind_speed,
        machine.hub_height,
        condition.shear_exponent,
        **transient(condition, machine, time),
    )


def _mann(
    condition: Condition, machine: Machine, options: WindOptions, seed: np.random.SeedSequence
) -> Box:
    """Box as wide as the rotor, with a grid point at the hub."""
    radius = machine.rotor_diameter / 2
    lines = np.linspace(-radius, radius, 2 * options.radii - 1)
    return mann_box(
        condition.wind_speed,
        condition.sigma,
        y=lines,
        z=machine.hub_height + lines,
        hub_height=machine.hub_height,
        duration=condition.duration,
        dt=options.step,
        seed=seed,
        shear_exponent=condition.shear_exponent,
        scaling="hub" if options.scaling == "hub" else "none",
    )


def transient(
    condition: Condition, machine: Machine, time: NDArray[np.float64]
) -> dict[str, NDArray[np.float64]]:
    """Course of a gust over `time` (s from the start of the series), for `gusts.gust_field`.

    Parameters
    ----------
    condition : Condition
        With the gust: its kind, size and start.
    machine : Machine
        Whose rotor diameter a change of shear is spread over.
    time : ndarray (n,)
        From the start of the series, s.

    Returns
    -------
    dict
        What changes of ``rise`` (m/s), ``direction`` (rad), ``vertical`` and ``horizontal`` (1/s).

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.wind import Machine, conditions, transient
    >>> machine = Machine(3.0, 11.4, 25.0, 126.0, 90.0)
    >>> gust = conditions("3.2", machine)[0]
    >>> time = np.arange(0.0, 70.0, 0.1)
    >>> {name: change.shape == time.shape for name, change in transient(gust, machine,
    ...     time).items()}
    {'rise': True}
    """
    since = time - condition.gust_time
    if condition.wind == "EOG":
        return {"rise": gusts.operating_gust(since, condition.gust)}
    if condition.wind == "EDC":
        return {"direction": gusts.direction_change(since, condition.gust)}
    if condition.wind == "ECD":
        rise, direction = gusts.coherent_gust(since, condition.gust)
        return {"rise": rise, "direction": direction}
    if condition.wind == "EWS":
        gradient = gusts.wind_shear(since, condition.gust) / machine.rotor_diameter
        return {"horizontal" if condition.horizontal else "vertical": gradient}
    return {}
