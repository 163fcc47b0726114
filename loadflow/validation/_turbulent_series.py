"""Loads of the NREL 5 MW in turbulence beside one series of OpenFAST for each of three winds.

Both blow in winds of their own, so that a row can be as near as seeds of one wind are. `SERIES`
holds the series' measures and the scatter of ours between `SCATTER_OF`, seeds that no row uses; a
row allows what 95 % of single seeds stay within of the mean of `SEEDS`: t s √(1 + 1/n), Student's t
of the seeds that s is of. (``python -m benchmarks.references.turbulent_series`` prints both.)
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from ._load_series import compare
from .check import Check, evidence

CHANNELS = (
    "thrust", "tilt moment", "yaw moment", "N vertical", "N lateral", "N2 vertical", "N2 lateral",
)  # fmt: skip
MEASURED = ("mean", "std", "DEL m = 4")
SEEDS, SCATTER_OF = range(1, 4), range(13, 25)

Three = tuple[float, float, float]
# wind, m/s → channel: mean, standard deviation and damage-equivalent range of the series, and the
# standard deviation of each between seeds; kN and kN m
SERIES: dict[float, dict[str, tuple[Three, Three]]] = {
    4.0: {
        "thrust": ((210.1, 26.67, 44.77), (4.066, 6.683, 3.051)),
        "tilt moment": ((-215.4, 461.3, 1053.0), (34.23, 64.24, 60.59)),
        "yaw moment": ((3.076, 506.8, 1109.0), (43.21, 66.66, 66.59)),
        "N vertical": ((-1500.0, 127.7, 293.9), (9.647, 18.0, 15.89)),
        "N lateral": ((-1.921, 140.8, 310.7), (11.86, 18.42, 18.03)),
        "N2 vertical": ((-154.3, 128.0, 292.9), (9.556, 17.9, 16.49)),
        "N2 lateral": ((1.224, 140.8, 309.0), (11.95, 18.49, 18.32)),
    },
    8.0: {
        "thrust": ((486.2, 70.25, 83.73), (9.233, 14.64, 12.1)),
        "tilt moment": ((488.2, 896.8, 1926.0), (69.61, 95.25, 102.3)),
        "yaw moment": ((357.7, 1007.0, 1952.0), (87.84, 76.29, 66.06)),
        "N vertical": ((-1309.0, 245.3, 533.8), (18.48, 25.61, 27.88)),
        "N lateral": ((-106.0, 279.1, 545.4), (24.37, 20.3, 17.83)),
        "N2 vertical": ((-348.2, 247.7, 534.1), (19.03, 26.16, 28.3)),
        "N2 lateral": ((101.7, 279.5, 542.9), (24.39, 20.88, 18.16)),
    },
    24.0: {
        "thrust": ((364.7, 63.07, 155.3), (1.377, 2.205, 4.252)),
        "tilt moment": ((2641.0, 1829.0, 4125.0), (109.5, 99.41, 111.8)),
        "yaw moment": ((275.1, 1742.0, 4163.0), (76.69, 120.9, 82.77)),
        "N vertical": ((-696.3, 522.5, 1186.0), (30.77, 27.78, 32.0)),
        "N lateral": ((-140.1, 491.0, 1187.0), (21.29, 33.32, 23.26)),
        "N2 vertical": ((-951.4, 512.4, 1156.0), (30.54, 27.65, 31.23)),
        "N2 lateral": ((98.48, 485.8, 1165.0), (21.26, 33.49, 23.0)),
    },
}

_LATERAL = (
    "v and w of the series' wind are independent from point to point, ours are coherent: without "
    "it the tilt moment of 24 seeds is 9 % too large in place of 13 %, the yaw moment 6 % in place "
    "of 9 %; the rest is not found"
)
_MISSED = {(24.0, channel, "DEL m = 4"): _LATERAL for channel in CHANNELS if channel != "thrust"}


@evidence("another code")
def checks() -> Iterator[Check]:
    """Yield thrust, moments at the rotor apex and forces on two bearings."""
    from scipy.special import stdtrit

    from loadflow.rotor import simulate
    from loadflow.turbines import load_turbine

    tilt = load_turbine("nrel-5mw").rotor.tilt
    within = float(stdtrit(len(SCATTER_OF) - 1, 0.975)) * math.sqrt(1 + 1 / len(SEEDS))
    for wind, held in SERIES.items():
        ours = compare([simulate(wind_speed=wind, seed=seed) for seed in SEEDS], tilt)
        for channel, (series, scatter) in held.items():
            for measure, expected, spread in zip(MEASURED, series, scatter, strict=True):
                allowed = within * spread
                absolute = measure == "mean"  # some are near 0
                yield Check(
                    name=f"{channel}: {measure}, turbulence at {wind:g} m/s",
                    source="OpenFAST v5, one seed",
                    expected=expected,
                    got=ours[channel][measure],
                    tolerance=allowed if absolute else allowed / expected,
                    kind="absolute" if absolute else "relative",
                    unit="kN m" if channel.endswith("moment") else "kN",
                    missed=_MISSED.get((wind, channel, measure), ""),
                )
