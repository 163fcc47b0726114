"""Are seeds equal? Three stages, as printed or calibrated.

As printed (section 4.2 of [Jonuschies 2015]) every value of a record counts as
independent; on real load series the tests then reject nearly always although nothing differs.
Calibrated, each stage compares means of a feature by their true uncertainty
(`loadflow.seeds.longrun`): location the values, spread the distances from the median (as Brown and
Forsythe do), spectrum the logarithms of the power in frequency bands of tapered segments.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.seeds._samples import Floats, as_samples, check_level, sampling_step
from loadflow.seeds.longrun import LongRun, equal_means, holm
from loadflow.seeds.rank_tests import ONE_SEED, Pool, kruskal_wallis_of, meyer_bahlburg_of
from loadflow.seeds.spectra import (
    BAND,
    SpectralDifference,
    periodogram,
    relative_difference,
    segments,
)

Method = Literal["as-printed", "calibrated"]

SEGMENTS = 29  # half-overlapping: each a fifteenth of the shortest record
LEAST_VALUES = 8 * (SEGMENTS + 1) // 2
BAND_RATIO = 1.4  # of the frequencies that bound a band, about half an octave
BAND_COSINES = 10  # more than for single values: segments hardly correlate
LEAST_SHARE = 1e-4  # of the variance: bands below it do not matter to any bearing


@dataclass(frozen=True)
class Stage:
    """Outcome of one stage.

    Attributes
    ----------
    statistic : float
        H (as printed) or F (calibrated) of location and spread; of the spectrum the largest
        relative difference (as printed) or the F of the band that differs most (calibrated).
    pvalue : float
        Of this stage alone; nan for the printed spectrum, which is a band and not a test.
    equal : bool
        Verdict of the stage; calibrated with Holm's correction for there being three.
    text : str
        The verdict in words.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import equality
    >>> x = np.random.default_rng(0).standard_normal((3, 3000))
    >>> stage = equality(x, dt=0.05).spread
    >>> stage.equal, 0.0 < stage.pvalue <= 1.0
    (True, True)
    """

    statistic: float
    pvalue: float
    equal: bool
    text: str


@dataclass(frozen=True)
class SeedEquality:
    """Verdict on the equality of seeds.

    Attributes
    ----------
    location, spread, spectrum : Stage
        The three stages.
    pvalue : float
        Calibrated: of the three stages together (the smallest after Holm's correction); to be
        corrected with `holm` over the components and wind speeds tested. As printed: the smaller
        one of the two rank tests.
    alpha : float
        Level of significance.
    method : str
        ``"as-printed"`` or ``"calibrated"``.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import equality
    >>> x = np.random.default_rng(0).standard_normal((3, 3000))
    >>> equality(x, dt=0.05).location.equal
    True
    """

    location: Stage
    spread: Stage
    spectrum: Stage
    pvalue: float
    alpha: float
    method: str

    @property
    def equal(self) -> bool:
        """Whether the seeds may be merged: all three stages say equal."""
        return self.location.equal and self.spread.equal and self.spectrum.equal

    @property
    def text(self) -> str:
        """The verdict in words; what differs if something does."""
        stages = (self.location, self.spread, self.spectrum)
        if self.equal and self.location.text == ONE_SEED:
            return ONE_SEED
        return "; ".join(s.text for s in stages if self.equal or not s.equal)


class Evidence(Protocol):
    """Series prepared for comparing any subset of them."""

    def compare(self, subset: Sequence[int]) -> SeedEquality:
        """Verdict on the series of `subset`."""


@dataclass(frozen=True)
class AsPrinted:
    """Series and their raw periodograms."""

    samples: list[Floats]
    frequency: Floats
    density: Floats
    alpha: float
    band: float

    @classmethod
    def of(cls, samples: list[Floats], dt: float, alpha: float, band: float) -> AsPrinted:
        """Prepare `samples`; the spectra take the length of the shortest."""
        n = min(x.size for x in samples)
        return cls(samples, *periodogram(np.stack([x[:n] for x in samples]), dt), alpha, band)

    def compare(self, subset: Sequence[int]) -> SeedEquality:
        """Kruskal–Wallis, Meyer-Bahlburg and the spectral band on the series of `subset`."""
        if len(subset) == 1:
            return _one_seed(self.alpha, "as-printed")
        pool = Pool.of([self.samples[i] for i in subset])
        tests = kruskal_wallis_of(pool), meyer_bahlburg_of(pool)
        location, spread = (
            _stage(name, "H", t.statistic, t.pvalue, t.pvalue >= self.alpha)
            for name, t in zip(("location", "spread"), tests)
        )
        smallest = min(t.pvalue for t in tests)
        spectrum = self._spectrum(self.density[list(subset)])
        return SeedEquality(location, spread, spectrum, smallest, self.alpha, "as-printed")

    def _spectrum(self, density: Floats) -> Stage:
        """Largest relative difference over frequency and all ordered pairs (4.15–4.17)."""
        low, high = density.min(axis=0), density.max(axis=0)
        relative = relative_difference(low, high)
        found = SpectralDifference(self.frequency, low, high, relative, self.band)
        word = "equal" if found.equal else "differs"
        outside = f"{found.share_outside:.0%} outside ±{self.band:g}"
        text = f"spectrum {word} (at most by {found.maximum:.3g}, {outside})"
        return Stage(found.maximum, float("nan"), found.equal, text)


@dataclass(frozen=True)
class Calibrated:
    """Long-run means of the features of each series."""

    levels: list[LongRun]
    bands: list[LongRun]
    frequency: Floats
    alpha: float

    @classmethod
    def of(cls, samples: list[Floats], dt: float, alpha: float) -> Calibrated:
        """Prepare `samples`; all of them share segment length and frequency bands."""
        shortest = min(x.size for x in samples)
        if shortest < LEAST_VALUES:
            raise InputError(
                f"the shortest series has {shortest} values; "
                f'method="calibrated" needs at least {LEAST_VALUES}'
            )
        length = 2 * shortest // (SEGMENTS + 1)
        starts = _band_starts(length // 2 + 1)
        tapered = [segments(x, length, own_means=True) for x in samples]
        power = [np.add.reduceat(p, starts, axis=1)[:, 1:] for p in tapered]
        mean = np.mean([p.mean(axis=0) for p in power], axis=0)
        kept = mean > LEAST_SHARE * mean.sum()
        floor = 1e-12 * mean[kept]
        return cls(
            [LongRun.of(np.stack([x, np.abs(x - np.median(x))], axis=1)) for x in samples],
            [LongRun.of(np.log(np.maximum(p[:, kept], floor)), BAND_COSINES) for p in power],
            starts[1:][kept] / (length * dt),
            alpha,
        )

    def compare(self, subset: Sequence[int]) -> SeedEquality:
        """Compare the means of all features of the series of `subset`."""
        if len(subset) == 1:
            return _one_seed(self.alpha, "calibrated")
        level = equal_means([self.levels[i] for i in subset])
        bands = equal_means([self.bands[i] for i in subset])
        adjusted = holm(bands.pvalue)
        if adjusted.size:
            worst = int(np.argmin(adjusted))
            f, p, at = (
                bands.statistic[worst],
                adjusted[worst],
                f" at {self.frequency[worst]:.3g} Hz",
            )
        else:  # constant series
            f, p, at = 0.0, 1.0, ""
        statistics = [*level.statistic.tolist(), float(f)]
        pvalues = [*level.pvalue.tolist(), float(p)]
        joint = holm(pvalues)
        location, spread, spectrum = (
            _stage(name, "F", statistic, pvalue, bool(q >= self.alpha), where)
            for name, statistic, pvalue, q, where in zip(
                ("location", "spread", "spectrum"), statistics, pvalues, joint, ("", "", at)
            )
        )
        overall = float(joint.min())
        return SeedEquality(location, spread, spectrum, overall, self.alpha, "calibrated")


def evidence(
    x: Iterable[ArrayLike], dt: float, alpha: float, method: Method, band: float = BAND
) -> Evidence:
    """Check the input and prepare the series for comparison."""
    check_level(alpha)
    step = sampling_step(dt, None)
    samples = as_samples(x, least=2)
    if method == "as-printed":
        if band < 0:
            raise InputError(f"band = {band}; allowed: band >= 0")
        return AsPrinted.of(samples, step, alpha, band)
    if method == "calibrated":
        return Calibrated.of(samples, step, alpha)
    raise InputError(f'method = {method!r}; allowed: "as-printed", "calibrated"')


def equality(
    x: Iterable[ArrayLike],
    dt: float,
    alpha: float = 0.05,
    method: Method = "calibrated",
    band: float = BAND,
) -> SeedEquality:
    """Test whether the seeds of one wind speed may be merged, one variable at a time.

    Parameters
    ----------
    x : array_like, shape (case, time), or iterable of array_like, shape (n_i,)
        One series per seed; lengths may differ.
    dt : float
        Time step in s.
    alpha : float
        Level of significance; with ``"calibrated"`` the probability that equal seeds are called
        different by any of the three stages, as printed that of each rank test if the values were
        independent.
    method : {"calibrated", "as-printed"}
        Kruskal–Wallis, Meyer-Bahlburg and the ±2.5 % band on all values, as section 4.2 of the
        source prints them; or the same questions with the true uncertainty of correlated records.
    band : float
        Allowed relative difference of the printed spectral criterion (4.17).

    Returns
    -------
    SeedEquality
        One seed alone has the verdict "one seed, nothing to test".

    Raises
    ------
    InputError
        A series is not finite or too short (calibrated: 120 values); an option out of range.

    Examples
    --------
    >>> x = np.random.default_rng(0).standard_normal((6, 3000))
    >>> equality(x, dt=0.05).equal
    True
    """
    samples = as_samples(x, least=2)
    return evidence(samples, dt, alpha, method, band).compare(range(len(samples)))


def _stage(
    name: str, symbol: str, statistic: float, pvalue: float, equal: bool, where: str = ""
) -> Stage:
    """Put a test into words."""
    word = "equal" if equal else "differs"
    text = f"{name} {word}{where} ({symbol} = {statistic:.3g}, p = {pvalue:.2g})"
    return Stage(statistic, pvalue, equal, text)


def _one_seed(alpha: float, method: str) -> SeedEquality:
    """Verdict on one seed."""
    stage = Stage(0.0, 1.0, True, ONE_SEED)
    return SeedEquality(stage, stage, stage, 1.0, alpha, method)


def _band_starts(size: int) -> np.ndarray:
    """First bins of the frequency bands of `size` bins: zero alone, then half octaves."""
    starts = [0, 1]
    while True:
        following = max(starts[-1] + 1, int(np.ceil(starts[-1] * BAND_RATIO)))
        if following >= size:
            return np.array(starts)
        starts.append(following)
