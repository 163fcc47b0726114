"""Hard cases of the tests of seeds, of the reduction and of the wind."""

from __future__ import annotations

import numpy as np
from hard_case import Outcome, hard, refused

from loadflow.reduction import damage_equivalent_load, histogram, rainflow
from loadflow.rotor import simulate, steady_state
from loadflow.seeds import equality, kruskal_wallis, meyer_bahlburg
from loadflow.wind import PointGrid, iec, kaimal_box
from loadflow.wind.gusts import direction_change

RNG = np.random.default_rng


@hard(
    "seeds",
    "all samples tied",
    why="the tie correction divides by zero",
    what="a constant record has nothing to test: statistic 0, p = 1",
)
def constant():
    test = kruskal_wallis([np.ones(50), np.ones(40)])
    assert test.statistic == 0
    assert test.pvalue == 1
    return Outcome(f"H = {test.statistic:g}, p = {test.pvalue:g}")


@hard(
    "seeds",
    "N = 3 mod 4, many ties",
    why="alternating ranks depend on how the tail is dealt",
    what="Siegel–Tukey ranks for any N, ties by mid-ranks, and a note that says so",
)
def ties():
    rng = RNG(1)
    x, y = rng.integers(0, 6, 40).astype(float), rng.integers(0, 6, 43).astype(float)
    test = meyer_bahlburg([x, y])
    turned = meyer_bahlburg([-x, -y])
    assert abs(test.statistic - turned.statistic) < 0.5
    assert 0 <= test.pvalue <= 1
    return Outcome(f"H = {test.statistic:.3f}, mirrored {turned.statistic:.3f}")


@hard(
    "seeds",
    "one seed",
    why="nothing to compare",
    what="a valid verdict: nothing to test",
)
def single():
    verdict = equality(RNG(2).normal(size=(1, 4000)), dt=0.025)
    assert "one seed" in verdict.text
    return Outcome(verdict.text)


@hard(
    "seeds",
    "10⁷ samples",
    why="the sum of squared ranks passes 2⁶³, float sums lose digits",
    what="ranks in double precision, sums of group means; equal to the small test repeated",
)
def many():
    rng = RNG(3)
    test = kruskal_wallis([rng.normal(size=5_000_000), rng.normal(size=5_000_000)])
    assert np.isfinite(test.statistic)
    assert test.pvalue > 1e-3
    return Outcome(f"H = {test.statistic:.3f}, p = {test.pvalue:.2f}")


@hard(
    "reduction",
    "a constant series",
    why="classes of width zero",
    what="one class; weights still sum to the full length",
)
def one_class():
    n = 1000
    reduced = histogram(np.ones(n), np.full((n, 2), 5.0), np.arange(n) * 0.1, size=0.1, seed=1)
    assert reduced.weight.sum() == n
    return Outcome(f"{reduced.index.size} of {n} kept, weights sum to {reduced.weight.sum():g}")


@hard(
    "reduction",
    "one isolated extreme in 24,000 steps",
    why="a random pick of a tenth misses it nine times in ten",
    what="every class that is not empty keeps at least one sample; the severest is kept",
)
def isolated():
    rng = RNG(4)
    force = rng.normal(1e6, 1e5, (24_000, 2))
    force[12_345] = (9e6, 0.0)
    reduced = histogram(
        rng.normal(1.2, 0.05, 24_000),
        force,
        np.arange(24_000) * 0.025,
        size=0.1,
        seed=1,
        pick="extremes",
    )
    assert 12_345 in reduced.index
    return Outcome(f"kept among {reduced.index.size}")


@hard(
    "reduction",
    "a series with a gap to count",
    why="a NaN compares with nothing: turning points vanish around it, or damage is left out",
    what="a named error with the place of the gap",
)
def gap():
    return refused(lambda: rainflow([0, 5, np.nan, -5, 3, -2, 4, 0]), "nan", "index (2,)")


@hard(
    "reduction",
    "a constant series to count",
    why="no turning points at all; an equivalent load divides by their number or takes a root of 0",
    what="no cycles, and an equivalent load of 0",
)
def nothing_to_count():
    cycles = rainflow(np.ones(10))
    assert cycles.range.size == 0
    load = damage_equivalent_load(np.ones(10), 4.0, duration=10.0)
    assert load == 0
    return Outcome(f"{cycles.range.size} cycles, equivalent load {load:g}")


@hard(
    "wind",
    "gust at the extreme wind speed itself",
    why="the amplitude of the operating gust passes zero and would turn negative",
    what="a named error above V_e1",
)
def above_the_gust():
    return refused(
        lambda: iec.eog_amplitude(80.0, "I", "A", rotor_diameter=126, hub_height=90), "V_e1"
    )


@hard(
    "wind",
    "change of direction by 0° and by 180°",
    why="sign and start of the ramp; a half turn has two ways round",
    what="a smooth ramp from 0 to the angle asked for, monotonic",
)
def turning():
    time = np.linspace(0, 10, 500)
    none, half = (direction_change(time, angle) for angle in (0.0, np.pi))
    assert not none.any()
    assert np.all(np.diff(half) >= -1e-12)
    assert abs(half[-1] - np.pi) < 1e-9
    return Outcome(f"0 and {np.degrees(half[-1]):.0f}°")


BOX = {"hub_height": 90.0, "duration": 60.0, "dt": 0.1, "seed": 1}


@hard(
    "wind",
    "grid points a micrometre apart",
    why="a coherence matrix that is singular but for the last digits has no Cholesky factor",
    what="factored without a shift of its diagonal; both points get the same wind",
)
def touching():
    box = kaimal_box(12.0, 2.0, y=[0.0, 1e-6], z=[89.0, 90.0], **BOX)
    assert np.isfinite(box.u).all()
    apart = float(np.abs(np.diff(box.u, axis=1)).max() / box.u.std())
    assert apart < 0.01
    return Outcome(f"they differ by {apart:.0e} standard deviations at most")


@hard(
    "wind",
    "two grid points at the same place",
    why="the coherence matrix is singular",
    what="a named error",
)
def coinciding():
    return refused(lambda: PointGrid(np.zeros(2), np.full(2, 90.0)), "coincide")


@hard(
    "wind",
    "a grid that reaches below the ground",
    why="heights under roots: the profile of the wind has no value there",
    what="a named error with the lowest height",
)
def underground():
    return refused(lambda: kaimal_box(12.0, 2.0, y=[0.0, 10.0], z=[-5.0, 90.0], **BOX), "-5 m")


@hard(
    "wind",
    "turbulence without wind",
    why="wave lengths are speed over frequency",
    what="a named error",
)
def calm():
    return refused(lambda: kaimal_box(0.0, 2.0, y=[0.0, 10.0], z=[80.0, 90.0], **BOX), "> 0")


@hard(
    "rotor",
    "zero shear, cut-in and cut-out",
    why="control changes its region; divisions by the shear exponent",
    what="the steady state over the whole range, edges included",
)
def edges():
    state = steady_state("nrel-5mw", wind_speed=[3.0, 25.0], shear=0.0)
    assert np.isfinite(state["power"]).all()
    assert (state["power"] >= 0).all()
    return Outcome(
        f"{float(state['power'][0]) / 1e3:.0f} kW and {float(state['power'][1]) / 1e6:.2f} MW"
    )


@hard(
    "rotor",
    "stop in a gust at 13.4 m/s",
    why="the torque of the generator goes while that of the wind rises",
    what="pitch at its largest rate; the rotor stays below its overspeed",
)
def stop_in_a_gust():
    series = simulate(dlc="4.2", wind_speed=13.4, seed=4, duration=100, dt=0.05, rung="tables")
    fastest = float(series["speed"].max())
    assert 1.267 < fastest < 1.2 * 1.267
    assert np.isfinite(series["hub_moment"]).all()
    return Outcome(f"speed up to {fastest / 1.267:.2f} of the rated one")


@hard(
    "rotor",
    "a parked rotor",
    why="tip speed ratio zero: induction, azimuth and 1p have no meaning",
    what="the brake holds ω = 0 exactly; loads are those of the standing blades",
)
def parked():
    series = simulate(dlc="6.4", event="parked", wind_speed=15, duration=10, dt=0.05, rung="tables")
    assert not series["speed"].any()
    assert np.isfinite(series["hub_force"]).all()
    return Outcome("ω = 0, all loads finite")
