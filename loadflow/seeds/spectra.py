"""Power spectra of seeds and how far they lie apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.seeds._samples import Floats, as_samples, sampling_step

BAND = 0.025  # ±2.5 % of [Jonuschies 2015]


@dataclass(frozen=True)
class SpectralDifference:
    """How far two power spectral densities lie apart.

    Attributes
    ----------
    frequency : ndarray, shape (k,)
        Hz, without zero (the mean is the location test's business).
    reference, other : ndarray, shape (k,)
        One-sided densities of the two series, in unit²/Hz.
    relative : ndarray, shape (k,)
        |S_xx − S_yy| / S_xx.
    band : float
        The allowed relative difference.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import spectral_difference
    >>> x = np.sin(2 * np.pi * np.arange(400) * 0.05)
    >>> found = spectral_difference(x, 1.01 * x, dt=0.05, band=0.025)
    >>> float(found.frequency[19]), bool(found.relative[19] < found.band)
    (1.0, True)
    """

    frequency: Floats
    reference: Floats
    other: Floats
    relative: Floats
    band: float

    @property
    def maximum(self) -> float:
        """Largest relative difference over frequency."""
        return float(self.relative.max())

    @property
    def share_outside(self) -> float:
        """Share of the frequencies where the difference exceeds the band."""
        return float(np.mean(self.relative > self.band))

    @property
    def equal(self) -> bool:
        """Whether the difference is within the band at every frequency (4.17)."""
        return self.maximum <= self.band


def periodogram(x: Floats, dt: float) -> tuple[Floats, Floats]:
    """One-sided power spectral density of `x` about its mean, without zero frequency.

    The Fourier transform of the autocovariance (Wiener–Khinchin, (4.14) of [Jonuschies 2015]) is
    the squared transform of the series; no taper, no averaging.

    Parameters
    ----------
    x : ndarray, shape (..., n)
        Series along the last axis.
    dt : float
        Time step in s.

    Returns
    -------
    frequency : ndarray, shape (k,)
        Hz.
    density : ndarray, shape (..., k)
        unit²/Hz; its sum times the frequency step is the variance.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import periodogram
    >>> x = np.random.default_rng(0).standard_normal(1000)
    >>> frequency, density = periodogram(x, dt=0.1)
    >>> bool(np.isclose(density.sum() * frequency[0], x.var()))
    True
    """
    from scipy.fft import rfft, rfftfreq

    n = x.shape[-1]
    transform = rfft(x - x.mean(axis=-1, keepdims=True))[..., 1:]
    density = 2.0 * dt / n * (transform.real**2 + transform.imag**2)
    if n % 2 == 0:
        density[..., -1] *= 0.5
    return rfftfreq(n, dt)[1:], density


def relative_difference(reference: Floats, other: Floats) -> Floats:
    """|S_xx − S_yy| / S_xx; 0 where both vanish, infinite where only the reference does."""
    difference = np.abs(reference - other)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(difference == 0.0, 0.0, difference / reference)


def spectral_difference(
    x: ArrayLike,
    y: ArrayLike,
    dt: float | None = None,
    fs: float | None = None,
    *,
    band: float = BAND,
) -> SpectralDifference:
    """Compare the power spectra of two series as printed (4.14–4.17 of [Jonuschies 2015]).

    Two raw periodograms are compared, as there; each has a standard error of 100 %, so
    two seeds of one process are never within 2.5 %. `averaged_spectrum` and `equality` with
    ``method="calibrated"`` are the sound comparison.

    Parameters
    ----------
    x, y : array_like, shape (n,)
        Reference and other series; the longer one is cut to the length of the shorter.
    dt, fs : float
        Time step in s or sampling frequency in Hz; give one of them.
    band : float
        Allowed relative difference.

    Returns
    -------
    SpectralDifference
        Relative difference per frequency, its maximum and the verdict.

    Raises
    ------
    InputError
        A series is shorter than two values or not finite; neither or both of `dt`, `fs`.

    Examples
    --------
    >>> t = np.arange(400) * 0.05
    >>> x = np.sin(2 * np.pi * t)
    >>> round(float(spectral_difference(x, 1.01 * x, dt=0.05).relative[19]), 4)
    0.0201
    """
    step = sampling_step(dt, fs)
    if band < 0:
        raise InputError(f"band = {band}; allowed: band >= 0")
    first, second = as_samples([x, y], least=2)
    n = min(first.size, second.size)
    frequency, density = periodogram(np.stack([first[:n], second[:n]]), step)
    reference, other = density
    relative = relative_difference(reference, other)
    return SpectralDifference(frequency, reference, other, relative, band)


@dataclass(frozen=True)
class AveragedSpectrum:
    """Welch's averaged power spectral density with its confidence band.

    Attributes
    ----------
    frequency, density, low, high : ndarray, shape (k,)
        Hz and unit²/Hz; `low` and `high` bound the true density with the stated confidence at
        each frequency, if the series is Gaussian there.
    dof : float
        Equivalent degrees of freedom of the average.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import averaged_spectrum
    >>> noise = np.random.default_rng(0).standard_normal(6000)
    >>> spectrum = averaged_spectrum(noise, dt=0.1)
    >>> bool(spectrum.dof > 2.0)  # more than those of one periodogram
    True
    """

    frequency: Floats
    density: Floats
    low: Floats
    high: Floats
    dof: float


def segments(x: Floats, length: int, *, own_means: bool = False) -> Floats:
    """Power of Hann-tapered, half-overlapping segments of `x` about its mean.

    Parameters
    ----------
    x : ndarray, shape (n,)
        Series.
    length : int
        Values per segment.
    own_means : bool
        About the mean of each tapered segment instead. What is slower than a segment then does not
        leak into its first frequency, and with it the mean of the record, which all its segments
        share.

    Returns
    -------
    ndarray, shape (segments, length // 2 + 1)
        Squared magnitude of the transforms.
    """
    from scipy.fft import rfft

    hann = 0.5 - 0.5 * np.cos(2.0 * np.pi / length * np.arange(length))
    views = np.lib.stride_tricks.sliding_window_view(x - x.mean(), length)[:: max(length // 2, 1)]
    if own_means:
        views = views - (views @ hann / hann.sum())[:, None]
    transform = rfft(views * hann, axis=1)
    return transform.real**2 + transform.imag**2


def averaged_spectrum(
    x: ArrayLike,
    dt: float | None = None,
    fs: float | None = None,
    *,
    segment: float | None = None,
    confidence: float = 0.95,
) -> AveragedSpectrum:
    """Power spectral density averaged over segments (Welch), with a confidence band.

    Parameters
    ----------
    x : array_like, shape (n,)
        Series.
    dt, fs : float
        Time step in s or sampling frequency in Hz; give one of them.
    segment : float, optional
        Length of a segment in s (Hann window, half overlap); a fifteenth of the record if None.
    confidence : float
        Of the band at each single frequency.

    Returns
    -------
    AveragedSpectrum

    Raises
    ------
    InputError
        The series is not finite or the segment shorter than 8 values or longer than the record.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import averaged_spectrum
    >>> noise = np.random.default_rng(0).standard_normal(6000)
    >>> spectrum = averaged_spectrum(noise, dt=0.1)
    >>> bool((spectrum.low < spectrum.density).all() and (spectrum.density < spectrum.high).all())
    True
    """
    from scipy.special import chdtri

    step = sampling_step(dt, fs)
    if not 0.0 < confidence < 1.0:
        raise InputError(f"confidence = {confidence}; allowed: 0 < confidence < 1")
    (series,) = as_samples([x], least=8)
    length = max(series.size // 15, 8) if segment is None else round(segment / step)
    if not 8 <= length <= series.size:
        raise InputError(
            f"segment = {length * step:g} s; allowed: {8 * step:g} s to {series.size * step:g} s"
        )
    power = segments(series, length)
    density = power.mean(axis=0) * 2.0 * step / (0.375 * length)  # 3/8: mean square of Hann
    density[0] *= 0.5
    if length % 2 == 0:
        density[-1] *= 0.5
    # neighbours that overlap by half share (1/6)² of their power scatter
    count = power.shape[0]
    dof = 2.0 * count / (1.0 + 2.0 * (count - 1) / count / 36.0)
    low = density * dof / chdtri(dof, (1.0 - confidence) / 2.0)
    high = density * dof / chdtri(dof, (1.0 + confidence) / 2.0)
    frequency = np.arange(density.size) / (length * step)
    return AveragedSpectrum(frequency, density, low, high, dof)
