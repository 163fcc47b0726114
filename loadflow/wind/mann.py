"""Turbulence after Mann (1994, 1998), the other model of IEC 61400-1; made by the extra ``mann``.

Its velocity is incompressible and sheared: u and w are correlated, and what is higher up comes
earlier. Spectral tensor with Γ = 3.9, l = 0.8 Λ1 and σ_iso = 0.55 σ1 (Annex B in edition 3, C in
edition 4). The box has the wavenumbers that its grid resolves, up to π over the spacing in each
direction, neither averaged over cells nor folded: a coarse grid lacks high frequencies.
"""

from __future__ import annotations

from functools import lru_cache
from math import gamma as gamma_function
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.wind.box import Box, spacing_of
from loadflow.wind.iec import length_scale as iec_length_scale
from loadflow.wind.seeding import Seed, as_sequence
from loadflow.wind.spectra import check_turbulence
from loadflow.wind.turbulence import sample_times

ISOTROPIC_SIGMA = 0.55
"""σ_iso of the Mann model over σ1."""
MANN_LENGTH = 0.8
"""Length scale of the Mann model over Λ1."""


def mann_box(
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
    gamma: float = 3.9,
    shear_exponent: float = 0.2,
    scaling: Literal["none", "hub"] = "none",
) -> Box:
    """Turbulence on a rectangular grid.

    Parameters
    ----------
    wind_speed, sigma : float
        Mean speed at the hub and σ1, m/s.
    y, z : array_like
        Equidistant lateral positions (0 at the tower axis, rising to the left when looking
        downwind) and heights above ground, rising, m.
    hub_height : float
        m; gives Λ1 unless `length_scale` does.
    duration, dt : float
        Length and step, s. The series repeats after it.
    seed : int or numpy.random.SeedSequence
        Seed.
    length_scale : float, optional
        Λ1, m.
    gamma : float
        Anisotropy Γ.
    shear_exponent : float
        Stored in the box, nothing else.
    scaling : {"none", "hub"}
        "none" leaves the variance to the model, the box and its cells; "hub" scales all components
        alike so that u has σ1 at the grid point nearest to the hub.

    Returns
    -------
    Box
        Fluctuation u, v, w over time and grid, m/s, without the mean.

    Raises
    ------
    InputError
        Grid lines that are not equidistant, nonsense, or the extra is not installed.

    Examples
    --------
    >>> from loadflow.wind import mann_box
    >>> box = mann_box(12.0, 1.8, y=[-20.0, 0.0, 20.0, 40.0], z=[60.0, 80.0, 100.0, 120.0],
    ...     hub_height=90.0, duration=20.0, dt=0.5, seed=1)
    >>> box.u.shape[0] == box.time.size
    True
    """
    lines_y, lines_z = np.asarray(y, float), np.asarray(z, float)
    scale = iec_length_scale(hub_height) if length_scale is None else length_scale
    check_turbulence(wind_speed, sigma, scale)
    if not 0 <= gamma <= 5:
        raise InputError(f"gamma = {gamma} must be within 0 … 5")
    check_one_of("scaling", scaling, ("none", "hub"))
    time = sample_times(duration, dt)
    cells = (time.size, lines_y.size, lines_z.size)
    steps = (wind_speed * dt, spacing_of("y", lines_y), spacing_of("z", lines_z))
    stencil = _stencil(MANN_LENGTH * scale, gamma, cells, steps)
    number = int(as_sequence(seed).generate_state(1, np.uint64)[0])
    strength = dissipation(ISOTROPIC_SIGMA * sigma, MANN_LENGTH * scale)
    spectra = stencil.partial_turbulence(strength, number, False)
    # the box drifts downwind: its far end comes first
    u, v, w = (np.ascontiguousarray(_in_space(part, cells)[::-1]) for part in spectra)
    if scaling == "hub" and sigma > 0:
        i, j = np.argmin(abs(lines_y)), np.argmin(abs(lines_z - hub_height))
        factor = np.float32(sigma / u[:, i, j].std(dtype=float))
        u, v, w = u * factor, v * factor, w * factor
    return Box(time, lines_y, lines_z, u, v, w, wind_speed, hub_height, shear_exponent)


def dissipation(sigma_iso: float, length: float) -> float:
    """α ε^(2/3) of von Kármán's energy spectrum with variance σ_iso² per component, m^(4/3)/s²."""
    shape = gamma_function(5 / 2) * gamma_function(1 / 3) / gamma_function(17 / 6) / 2
    return 1.5 * sigma_iso**2 / (shape * length ** (2 / 3))


def _in_space(spectrum: NDArray[np.complex64], cells: tuple[int, int, int]) -> NDArray[np.float32]:
    """Velocity of the box from Fourier coefficients of the generator, with the tensor's variance.

    Two weights of the generator (mannrs 2.0, hence its upper bound in the extra) are mended. It
    scales by 2 (count // 2 + 1) where the transform over z has `count` places. And its coefficients
    of k3 = 0 and of the highest k3 are independent for ±(k1, k2): a real field keeps half of their
    power, elsewhere all of it.
    """
    from scipy.fft import irfftn

    count = 2 * (spectrum.shape[2] - 1)
    weights = np.full(spectrum.shape[2], count / (count + 2), np.float32)
    weights[[0, -1]] *= np.sqrt(np.float32(2))
    shape = (*spectrum.shape[:2], count)
    nx, ny, nz = cells  # the rest keeps far edges of the box from being neighbours
    return irfftn(spectrum * weights, s=shape, overwrite_x=True)[:nx, :ny, :nz]


@lru_cache(maxsize=4)
def _stencil(
    length: float,
    gamma: float,
    cells: tuple[int, int, int],
    steps: tuple[float, float, float],
) -> Any:
    """Roots of the spectral tensor on a grid; the expensive part, the same for all seeds."""
    try:
        from mannrs import Stencil
    except ImportError as error:
        raise InputError(
            'Mann turbulence needs the extra "mann": pip install "loadflow[mann]"'
        ) from error
    sizes = (count * step for count, step in zip(cells, steps))
    shape = dict(zip(("Lx", "Ly", "Lz", "Nx", "Ny", "Nz"), (*sizes, *cells)))
    return Stencil(L=length, gamma=gamma, **shape).build(parallel=False).stencil
