"""Probability paper: on the right one, a sample lies on a straight line.

Annex A 2 of [Jonuschies 2015].

A value is drawn over the reduced variate of its rank. The line fitted to the points gives the
parameters, its distance from them says whether the distribution is the right one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.seeds._samples import Floats, as_samples

Distribution = Literal["normal", "lognormal", "weibull", "gumbel"]


@dataclass(frozen=True)
class _Scales:
    """Scales of one paper: the standard distribution of its variate, by its name in `scipy.stats`.

    And whether values are logarithmic, and the parameters by intercept and slope.
    """

    standard: str
    logarithmic: bool
    parameters: Callable[[float, float], dict[str, float]]

    def variate(self, p: Floats) -> Floats:
        """Reduced variate of a probability."""
        return np.asarray(self._distribution.ppf(p))

    def probability(self, u: Floats) -> Floats:
        """Probability of a reduced variate."""
        return np.asarray(self._distribution.cdf(u))

    @property
    def _distribution(self) -> Any:
        from scipy import stats

        return getattr(stats, self.standard)


_PAPERS: dict[str, _Scales] = {
    "normal": _Scales("norm", False, lambda a, b: {"mean": a, "standard_deviation": b}),
    "lognormal": _Scales("norm", True, lambda a, b: {"log_mean": a, "log_standard_deviation": b}),
    "weibull": _Scales(
        "gumbel_l",  # of the logarithm
        True,
        lambda a, b: {"scale": float(np.exp(a)), "shape": 1.0 / b if b > 0 else float("inf")},
    ),
    "gumbel": _Scales("gumbel_r", False, lambda a, b: {"location": a, "scale": b}),
}


@dataclass(frozen=True)
class ProbabilityPaper:
    """A sample on probability paper, with the line through it.

    Attributes
    ----------
    distribution : str
        The paper.
    value : ndarray, shape (n,)
        Sorted sample.
    probability : ndarray, shape (n,)
        Plotting positions (i − 0.3)/(n + 0.4), the median ranks.
    variate : ndarray, shape (n,)
        Reduced variate of each position: the linear scale of the paper.
    intercept, slope : float
        The line: value (or its logarithm) = intercept + slope · variate.
    error : float
        Root mean square distance of the points from the line over their standard deviation; 0 on
        the right paper as n grows, √(1 − R²) of the fit.
    parameters : dict of str to float
        Of the distribution, read from the line.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import probability_paper
    >>> paper = probability_paper(np.random.default_rng(0).normal(5.0, 1.0, 2000), "normal")
    >>> bool(paper.error < 0.1)
    True
    """

    distribution: str
    value: Floats = field(repr=False)
    probability: Floats = field(repr=False)
    variate: Floats = field(repr=False)
    intercept: float
    slope: float
    error: float
    parameters: dict[str, float]

    def quantile(self, probability: ArrayLike) -> Floats:
        """Value on the line that is not exceeded with a probability between 0 and 1."""
        p = np.asarray(probability, dtype=float)
        if np.any((p <= 0) | (p >= 1)):
            raise InputError(f"probability = {p.tolist()}; allowed: between 0 and 1")
        paper = _PAPERS[self.distribution]
        x = self.intercept + self.slope * paper.variate(p)
        return np.exp(x) if paper.logarithmic else x

    def cdf(self, value: ArrayLike) -> Floats:
        """Probability on the line that a value is not exceeded."""
        paper, x = _PAPERS[self.distribution], np.asarray(value, dtype=float)
        if self.slope == 0.0:
            raise InputError("all values of the sample are equal; the line has no probabilities")
        if paper.logarithmic:
            if np.any(x <= 0):
                raise InputError(f"{self.distribution} paper holds positive values only")
            x = np.log(x)
        return paper.probability((x - self.intercept) / self.slope)


def probability_paper(x: ArrayLike, distribution: Distribution = "normal") -> ProbabilityPaper:
    """Put a sample on probability paper and fit the line.

    Parameters
    ----------
    x : array_like, shape (n,)
        Sample of three values at least; positive for lognormal and Weibull paper.
    distribution : {"normal", "lognormal", "weibull", "gumbel"}
        The paper; Weibull has two parameters, Gumbel is that of maxima.

    Returns
    -------
    ProbabilityPaper

    Raises
    ------
    InputError
        The sample is too small, not finite, or not positive where it must be; unknown paper.

    Examples
    --------
    >>> x = np.random.default_rng(0).weibull(2.0, 20_000) * 10
    >>> paper = probability_paper(x, "weibull")
    >>> round(paper.parameters["scale"], 1), round(paper.parameters["shape"], 1)
    (10.0, 2.0)
    """
    if distribution not in _PAPERS:
        raise InputError(f"distribution = {distribution!r}; allowed: {', '.join(_PAPERS)}")
    paper = _PAPERS[distribution]
    value = np.sort(as_samples([x], least=3)[0])
    if paper.logarithmic and value[0] <= 0:
        raise InputError(f"{distribution} paper holds positive values only; found {value[0]:g}")
    n = value.size
    probability = (np.arange(1.0, n + 1.0) - 0.3) / (n + 0.4)
    variate = paper.variate(probability)
    linear = np.log(value) if paper.logarithmic else value
    u, v = variate - variate.mean(), linear - linear.mean()
    slope = float(u @ v / (u @ u))
    intercept = float(linear.mean() - slope * variate.mean())
    scatter = float(np.sqrt(np.mean(v**2)))
    residual = float(np.sqrt(np.mean((v - slope * u) ** 2)))
    return ProbabilityPaper(
        distribution=distribution,
        value=value,
        probability=probability,
        variate=variate,
        intercept=intercept,
        slope=slope,
        error=residual / scatter if scatter > 0 else 0.0,
        parameters=paper.parameters(intercept, slope),
    )
