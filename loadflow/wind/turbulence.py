"""Synthetic turbulence after Veers with the Kaimal model of IEC 61400-1.

The standard asks for a coherent downwind component and leaves the others open. Here all three have
the same coherence by default, because then the field has a limit as the grid gets finer; with
``lateral="independent"`` v and w of any two points are independent (what TurbSim does for IEC
spectra), and the loads from them depend on the spacing of the grid.

The noise is complex Gaussian: every point scatters alike from seed to seed, whatever its place in
the grid, and the field is a Gaussian process with exactly the spectrum and coherence asked for.
"""

from __future__ import annotations

from numbers import Integral
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.wind.box import Box
from loadflow.wind.coherence import (
    CoherenceFactors,
    ExactFactors,
    Grid,
    PointGrid,
    PolarGrid,
    same_points,
)
from loadflow.wind.field import Field
from loadflow.wind.iec import COMPONENT_SIGMA, Floats
from loadflow.wind.iec import length_scale as iec_length_scale
from loadflow.wind.options import Lateral, Scaling
from loadflow.wind.seeding import Seed, as_sequence, child
from loadflow.wind.spectra import check_turbulence, coherence_decay, kaimal_spectrum

Method = Literal["fast", "exact"]
Factors = CoherenceFactors | ExactFactors


def kaimal(
    wind_speed: float,
    sigma: float,
    *,
    radius: ArrayLike,
    angles: ArrayLike,
    duration: float,
    dt: float,
    seed: Seed,
    hub_height: float | None = None,
    length_scale: float | None = None,
    shear_exponent: float = 0.2,
    components: str = "uvw",
    scaling: Scaling = "none",
    lateral: Lateral = "coherent",
    method: Method = "fast",
    factors: CoherenceFactors | None = None,
    oversampled: int = 1,
) -> Field:
    """Turbulence on a polar grid around the hub.

    Parameters
    ----------
    wind_speed : float
        Mean speed at the hub, m/s.
    sigma : float
        Standard deviation σ1 of u, m/s; v and w have 0.8 and 0.5 of it.
    radius : (nr,) array_like
        Radii from 0 (hub centre), m.
    angles : (na,) array_like
        Equidistant angles from 0, rad (`polar_angles`).
    duration, dt : float
        Length and step, s. The field has the samples 0, dt, … up to the first at or after
        `duration`; it repeats only after that.
    seed : int or numpy.random.SeedSequence
        Seed, e.g. of `loadflow.wind.case_seed`.
    hub_height, length_scale : float, optional
        Hub height (gives Λ1) or Λ1 itself, m; exactly one of them.
    shear_exponent : float
        Stored in the field, nothing else.
    components : {"u", "uv", "uvw"}
        What to make. u does not change with it.
    scaling : {"none", "hub", "each"}
        "none" leaves the variance to the spectrum; what lies below 1/duration is missing, and a
        seed scatters. "hub" scales each component as a whole so that the hub has the standard
        deviation asked for over `duration`; "each" does so for every point.
    lateral : {"coherent", "independent"}
        Coherence of v and w, see the module.
    method : {"fast", "exact"}
        Factors interpolated over the decay, or computed at each frequency.
    factors : CoherenceFactors, optional
        Ready factors of this grid, for many seeds and speeds (only with "fast").
    oversampled : int
        How many times as fast as `dt` asks for the noise is drawn. The field is then that of the
        step dt / oversampled, gust for gust, without its fluctuations above 1 / (2 dt); of an odd
        number only where the Fourier transform takes both lengths as they are.

    Returns
    -------
    Field
        The fluctuation.

    Raises
    ------
    InputError
        If an argument makes no sense, or `factors` belong to another grid or length scale.

    Examples
    --------
    >>> from loadflow.wind import kaimal, polar_angles
    >>> field = kaimal(12.0, 1.8, radius=[0.0, 30.0, 60.0], angles=polar_angles(8), duration=60.0,
    ...     dt=0.5, seed=1, hub_height=90.0)
    >>> field.u.dtype.name, field.hub.shape
    ('float32', (121,))
    """
    from loadflow.wind._kernels import time_first

    grid = PolarGrid(np.asarray(radius, float), np.asarray(angles, float))
    scale = _length_scale(hub_height, length_scale)
    parts, time = _components(
        _choose(method, factors, grid, scale), wind_speed, sigma, duration, dt, seed,
        components, scaling, lateral, hub=(0, 0), oversampled=oversampled,
    )  # fmt: skip
    # one after another, so that each is freed: a fine grid takes 300 MB a component
    fields = [time_first(parts.pop(0)) for _ in components]
    u, v, w = (*fields, None, None)[:3]
    assert u is not None
    return Field(time, grid.radius, grid.angle, u, v, w, wind_speed, shear_exponent)


def kaimal_box(
    wind_speed: float,
    sigma: float,
    *,
    y: ArrayLike,
    z: ArrayLike,
    hub_height: float,
    duration: float,
    dt: float,
    seed: Seed,
    length_scale: float | None = None,
    shear_exponent: float = 0.2,
    components: str = "uvw",
    scaling: Scaling = "none",
    lateral: Lateral = "coherent",
    method: Method = "fast",
    factors: CoherenceFactors | None = None,
) -> Box:
    """Turbulence on a rectangular grid.

    Parameters
    ----------
    wind_speed, sigma, duration, dt, seed, length_scale, shear_exponent
        As `kaimal`.
    components, scaling, lateral, method, factors
        As `kaimal`.
    y, z : array_like
        Lateral positions (0 at the tower axis, rising to the left when looking downwind) and
        heights above ground of the grid lines, rising, m.
    hub_height : float
        Hub height, m. "hub" scaling refers to the grid point nearest to the hub.

    Returns
    -------
    Box
        The fluctuation.

    Raises
    ------
    InputError
        As `kaimal`; if two points coincide, lines do not rise or lie below the ground.

    Examples
    --------
    >>> from loadflow.wind import kaimal_box
    >>> box = kaimal_box(12.0, 1.8, y=[-20.0, 0.0, 20.0], z=[70.0, 90.0, 110.0], hub_height=90.0,
    ...     duration=30.0, dt=0.5, seed=1)
    >>> box.u.shape[0] == box.time.size
    True
    """
    lines_y, lines_z = np.asarray(y, float), np.asarray(z, float)
    if (lines_z < 0).any():
        raise InputError(f"z = {lines_z.min():g} m is below the ground; allowed: z >= 0")
    points_y, points_z = (p.ravel() for p in np.meshgrid(lines_y, lines_z, indexing="ij"))
    grid = PointGrid(points_y, points_z)
    scale = iec_length_scale(hub_height) if length_scale is None else length_scale
    nearest = int(np.argmin(np.hypot(points_y, points_z - hub_height)))
    parts, time = _components(
        _choose(method, factors, grid, scale), wind_speed, sigma, duration, dt, seed,
        components, scaling, lateral, hub=(nearest,),
    )  # fmt: skip
    shape = (len(time), len(lines_y), len(lines_z))
    u, v, w = (*(np.ascontiguousarray(part.T).reshape(shape) for part in parts), None, None)[:3]
    assert u is not None
    return Box(time, lines_y, lines_z, u, v, w, wind_speed, hub_height, shear_exponent)


def _length_scale(hub_height: float | None, length_scale: float | None) -> float:
    if hub_height is not None and length_scale is None:
        return iec_length_scale(hub_height)
    if length_scale is not None and hub_height is None:
        return length_scale
    raise InputError("give either hub_height or length_scale")


def _choose(method: Method, factors: CoherenceFactors | None, grid: Grid, scale: float) -> Factors:
    check_one_of("method", method, ("fast", "exact"))
    if method == "exact":
        return ExactFactors(grid, scale)
    if factors is None:
        return CoherenceFactors(grid, scale)
    if factors.length_scale != scale or not same_points(factors.grid, grid):
        raise InputError("the coherence factors belong to another grid or length scale")
    return factors


def _components(
    factors: Factors,
    wind_speed: float,
    sigma: float,
    duration: float,
    dt: float,
    seed: Seed,
    components: str,
    scaling: Scaling,
    lateral: Lateral,
    hub: tuple[int, ...],
    oversampled: int = 1,
) -> tuple[list[NDArray[np.float32]], Floats]:
    """Components with the axes of `Grid.to_points` and time last; and the time."""
    import scipy.fft

    check_turbulence(wind_speed, sigma, factors.length_scale)
    check_one_of("components", components, ("u", "uv", "uvw"))
    check_one_of("scaling", scaling, ("none", "hub", "each"))
    check_one_of("lateral", lateral, ("coherent", "independent"))
    time = sample_times(duration, dt)
    if not (isinstance(oversampled, Integral) and oversampled >= 1):
        raise InputError(f"oversampled = {oversampled} must be a whole number >= 1")
    # of two halves, so that a field of twice the step has the same frequencies
    halves = 1 if oversampled % 2 == 0 else 2
    period = halves * scipy.fft.next_fast_len(-(-len(time) // halves), real=True)
    drawn = oversampled * period // 2 + 1
    frequency = np.arange(period // 2 + 1) / (period * dt)
    decay = coherence_decay(frequency, wind_speed, factors.length_scale)
    root = as_sequence(seed)
    parts = []
    for k in range(len(components)):
        noise = _noise(factors.grid, len(frequency), drawn, child(root, k))
        if k == 0 or lateral == "coherent":
            factors.correlate(noise, decay)
        else:
            noise *= factors.grid.uncorrelated[..., None].astype(np.float32)
        density = kaimal_spectrum(frequency, wind_speed, sigma, factors.length_scale, k)
        noise *= np.sqrt(density * frequency[1] / 4).astype(np.float32)
        spectra = factors.grid.to_points(noise)
        series = scipy.fft.irfft(spectra, period, norm="forward", overwrite_x=True)
        parts.append(_scaled(series[..., : len(time)], COMPONENT_SIGMA[k] * sigma, scaling, hub))
    return parts, time


def sample_times(duration: float, dt: float) -> Floats:
    """Times 0, dt, … up to the first at or after `duration`, s."""
    if not (0 < dt < np.inf and 2 * dt <= duration < np.inf):
        raise InputError(f"duration = {duration} s must span at least two steps dt = {dt} s > 0")
    return np.arange(int(np.ceil(round(duration / dt, 6))) + 1, dtype=float) * dt


def _noise(
    grid: Grid, count: int, drawn: int, seed: np.random.SeedSequence
) -> NDArray[np.complex64]:
    """Complex Gaussian noise of variance 2 at the first `count` of the `drawn` frequencies, none at
    the first of them, zero.
    """
    noise = np.empty((grid.blocks, grid.order, 2 * count), dtype=np.float32)
    generator, row = np.random.default_rng(seed), np.empty(2 * drawn, dtype=np.float32)
    for part in noise.reshape(-1, 2 * count):
        generator.standard_normal(dtype=np.float32, out=row)
        part[:] = row[: 2 * count]
    noise[..., :2] = 0
    return noise.view(np.complex64)


def _scaled(
    series: NDArray[np.float32], sigma: float, scaling: Scaling, hub: tuple[int, ...]
) -> NDArray[np.float32]:
    if scaling == "none" or sigma == 0:
        return series
    if scaling == "hub":
        return series * np.float32(sigma / series[hub].std(dtype=float))
    return series * (sigma / series.std(axis=-1, dtype=float, keepdims=True)).astype(np.float32)
