"""Probability paper: a sample of the distribution lies on the line, others do not."""

import numpy as np
import pytest
import scipy.stats

from loadflow.errors import InputError
from loadflow.seeds import probability_paper

DISTRIBUTIONS = {
    "normal": (scipy.stats.norm(5, 2), {"mean": 5, "standard_deviation": 2}),
    "lognormal": (
        scipy.stats.lognorm(0.5, scale=np.exp(1.5)),
        {"log_mean": 1.5, "log_standard_deviation": 0.5},
    ),
    "weibull": (scipy.stats.weibull_min(2.2, scale=9), {"scale": 9, "shape": 2.2}),
    "gumbel": (scipy.stats.gumbel_r(100, 7), {"location": 100, "scale": 7}),
}


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_the_right_paper_gives_the_parameters(name):
    distribution, parameters = DISTRIBUTIONS[name]
    x = distribution.rvs(50_000, random_state=1)
    usable = DISTRIBUTIONS if x.min() > 0 else ("normal", "gumbel")
    papers = {other: probability_paper(x, other) for other in usable}
    for key, expected in parameters.items():
        assert papers[name].parameters[key] == pytest.approx(expected, rel=0.02)
    assert papers[name].error < 0.03
    assert min(papers, key=lambda other: papers[other].error) == name


@pytest.mark.parametrize("name", DISTRIBUTIONS)
def test_exact_quantiles_lie_on_the_line(name):
    distribution, parameters = DISTRIBUTIONS[name]
    p = (np.arange(1, 40) - 0.3) / 39.4
    paper = probability_paper(distribution.ppf(p), name)
    assert paper.error < 1e-12
    for key, expected in parameters.items():
        assert paper.parameters[key] == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(paper.quantile([0.01, 0.999]), distribution.ppf([0.01, 0.999]))
    np.testing.assert_allclose(paper.cdf(paper.quantile(p)), p)
    np.testing.assert_allclose(paper.cdf(distribution.ppf(p)), p)


def test_constant_sample_and_bad_input():
    constant = probability_paper([2.0, 2.0, 2.0])
    assert (constant.slope, constant.error) == (0.0, 0.0)
    with pytest.raises(InputError, match="all values of the sample are equal"):
        constant.cdf(2.0)
    for call, message in (
        (lambda: probability_paper([1, 2]), "at least 3"),
        (lambda: probability_paper([0, 1, 2], "weibull"), "positive values only; found 0"),
        (lambda: probability_paper([1, 2, 3], "weibull").cdf(0), "positive values only"),
        (lambda: probability_paper([1, 2, 3], "beta"), "allowed: normal, lognormal"),
        (lambda: probability_paper([1, 2, 3]).quantile(1.0), "between 0 and 1"),
    ):
        with pytest.raises(InputError, match=message):
            call()
