"""NREL 5 MW in steady wind, and starting in it, and IEA 15 MW in steady wind, beside OpenFAST.

Source: OpenFAST v5, quasi-steady wake, two flap and one edge mode, tower dam, shear 0.2, tilt 5°,
cone 2.5°; means over the part after the start-up. The aims are 2 % of power, 3 % of thrust, 0.4° of
pitch, 1 % of speed, and 8 % or 60 kN m of the moments; those in turbulence stand with their
numbers. Where the model misses its aim, the row says so and why; see docs/rotor.md.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from . import _turbulent_series
from ._load_series import SWINGING, channels
from .check import Check, evidence

_SOURCE = "OpenFAST v5"
# wind m/s: speed 1/min, pitch °, power kW, thrust kN, tilt and yaw moment kN m
_ROWS = {
    4.0: (7.157, 0.0, 170.0, 209.6, -198.0, 54.0),
    8.0: (9.030, 0.0, 1800.0, 470.4, 453.0, 291.0),
    12.0: (12.097, 3.01, 5296.0, 718.8, 1067.0, 538.0),
    16.0: (12.100, 11.67, 5296.0, 482.1, 1617.0, 469.0),
    24.0: (12.100, 21.78, 5296.0, 369.9, 2466.0, 104.0),
}
# start at 12 m/s, blades from feather to fine pitch at 2°/s: s after its begin, speed in 1/min
_START = ((10, 0.835), (20, 2.124), (30, 4.052), (40, 8.221), (45, 10.61), (50, 12.16), (60, 11.87))
# amplitudes of tilt and yaw moment at three times the rotor speed, in the same wind, kN m; the aim
# is the factor of 1.25 in power that holds in turbulence
_STEADY_3P = {4.0: (67.2, 47.3), 8.0: (208.0, 133.0), 12.0: (347.0, 226.0), 24.0: (482.0, 275.0)}
_AIM_3P = 1.25**0.5 - 1
# blade 1 at its root in the same wind, flapwise and edgewise: mean, amplitude once a turn; tilting
# moment of the yaw bearing: mean and standard deviation; kN m
_STEADY_ROOT = {
    4.0: ((2221.1, 41.5), (75.0, 3572.8), (-860.1, 51.9)),
    8.0: ((5617.0, 461.3), (608.8, 3611.7), (303.5, 153.8)),
    12.0: ((8691.4, 873.3), (1334.0, 3698.0), (1390.8, 249.9)),
    24.0: ((3034.3, 1727.7), (1301.8, 3710.9), (2175.7, 352.5)),
}
_AIM_ROOT = (0.03, 10.0)  # of the blade: share, kN m; of the yaw bearing as the moments at the hub
# turbulence of category B at 12 m/s, 600 s, means over three seeds on either side, other winds:
# kN and kN m, power in bands (kN m)²; tolerance. The aims are 10 % of the mean and of the thrust's
# std, 8 % of the others, a factor of 1.25 for the bands, 8 % of DEL, 12 % of the extremes
_TURBULENT = {
    ("thrust", "std"): (120.3, 0.06),
    ("tilt moment", "mean"): (1037.0, 0.05),
    ("tilt moment", "std"): (1222.0, 0.05),
    ("tilt moment", "0 … 0.1 Hz"): (8.279e5, 0.10),
    ("tilt moment", "0.1 … 0.5 Hz"): (5.064e4, 0.12),
    ("tilt moment", "3p"): (4.292e5, 0.14),
    ("tilt moment", "DEL m = 4"): (2795.0, 0.06),
    ("tilt moment", "highest"): (5576.0, 0.12),
    ("yaw moment", "std"): (1262.0, 0.06),
    ("yaw moment", "0 … 0.1 Hz"): (9.591e5, 0.12),
    ("yaw moment", "0.1 … 0.5 Hz"): (4.982e4, 0.14),
    ("yaw moment", "3p"): (4.069e5, 0.14),
    ("yaw moment", "DEL m = 4"): (2711.0, 0.06),
    ("yaw moment", "highest"): (4553.0, 0.12),
    ("root flap", "mean"): (8183.4, 0.05),
    ("root flap", "std"): (1918.6, 0.05),
    ("root flap", "DEL m = 4"): (3594.5, 0.06),
    ("root edge", "mean"): (1247.5, 0.05),
    ("root edge", "std"): (2634.0, 0.05),
    ("root edge", "DEL m = 4"): (5136.5, 0.06),
    ("yaw bearing", "mean"): (1288.8, 0.05),
    ("yaw bearing", "std"): (1212.8, 0.05),
    ("yaw bearing", "DEL m = 4"): (2769.8, 0.06),
    ("N vertical", "std"): (334.7, 0.05),
    ("N lateral", "std"): (348.4, 0.05),
    ("N2 vertical", "mean"): (-498.9, 0.05),
    ("N2 vertical", "std"): (337.6, 0.05),
    ("N2 lateral", "mean"): (161.5, 0.05),
    ("N2 lateral", "std"): (349.8, 0.05),
}
_AIM_START = 0.05
# IEA 15 MW without shear, from the power and thrust coefficients that OpenFAST gives for it (windIO
# 2.1, IEA37_15MW_turbine), over the area that makes their power above rated 15.665 MW; they are of
# blades that do not twist (thrust at 10 m/s 14 % above that of HAWC2, whose blades do), so ours are
# held from twisting. With it: the table `turbines`. m/s: power MW, thrust without weight MN
_IEA = {
    5.0: (1.493, 0.5565),
    6.0: (2.776, 0.8127),
    8.0: (6.774, 1.392),
    10.0: (13.231, 2.173),
    13.0: (15.667, 1.468),
    20.0: (15.661, 0.920),
}
_AIM_MOMENT = (0.08, 60.0)  # share, kN m
# what misses its aim, and why
_MISSED = {
    (6.0, "power"): "ours of rigid blades is 0.2 % off, and power is at its top over the pitch: "
    "our blades straighten more in light wind than those of the print"
}


@evidence("another code")
def checks() -> Iterator[Check]:
    """Yield operating points of the NREL 5 MW turbine."""
    from loadflow.rotor import steady_state

    points = steady_state("nrel-5mw", wind_speed=list(_ROWS), shear=0.2)
    moment = points["hub_moment"].values / 1e3
    for i, (wind, row) in enumerate(_ROWS.items()):
        speed, pitch, power, thrust, tilt, yaw = row
        point = points.isel(wind_speed=i)
        yield _row(wind, "speed", speed, float(point["speed"]) * 30 / np.pi, 0.01, "1/min")
        yield _row(wind, "pitch", pitch, np.degrees(float(point["pitch"])), 0.4, "°")
        yield _row(wind, "power", power, float(point["power"]) / 1e3, 0.02, "kW")
        yield _row(wind, "thrust", thrust, float(point["thrust"]) / 1e3, 0.03, "kN")
        for name, expected, got in (
            ("tilt moment", tilt, moment[i, 1]),
            ("yaw moment", yaw, moment[i, 2]),
        ):
            allowed = max(_AIM_MOMENT[0] * abs(expected), _AIM_MOMENT[1])
            yield _row(wind, name, expected, float(got), allowed, "kN m")
    yield from _three_per_revolution()
    yield from _iea()
    yield from _start()
    yield from _turbulent()
    yield from _turbulent_series.checks()


def _three_per_revolution() -> Iterator[Check]:
    """Yield moments at 3p, of blade and yaw bearing in steady wind with shear and tower."""
    from loadflow.rotor import simulate
    from loadflow.turbines import load_turbine
    from loadflow.wind.field import Field, polar_angles

    tilt = load_turbine("nrel-5mw").rotor.tilt
    calm = np.zeros((2, 2, 3), dtype=np.float32)
    for wind, row in _STEADY_3P.items():
        field = Field(
            np.arange(2.0),
            np.arange(2.0),
            polar_angles(3),
            calm,
            None,
            None,
            wind,
            shear_exponent=0.2,
        )
        series = simulate(wind_speed=wind, duration=30.0, run_in=90.0, field=field)
        turn = np.unwrap(series["azimuth"].values) / (2 * np.pi)
        last = series.isel(time=turn > turn[-1] - np.floor(turn[-1] - turn[0]))  # whole turns
        wave = np.exp(-3j * last["azimuth"].values)
        for axis, name, expected in zip("yz", ("tilt moment", "yaw moment"), row, strict=True):
            moment = last["hub_moment"].sel(axis=axis).values / 1e3
            got = 2 * abs(np.mean((moment - moment.mean()) * wave))
            yield _row(wind, f"{name}, 3p", expected, float(got), _AIM_3P, "kN m")
        found = channels(last, tilt)
        wave = np.exp(-1j * last["azimuth"].values)
        for name, (mean, moved) in zip(SWINGING, _STEADY_ROOT[wind], strict=True):
            moment, once = found[name], name != "yaw bearing"
            deviation = moment - moment.mean()
            got = 2 * abs(np.mean(deviation * wave)) if once else deviation.std()
            what = "amplitude once a turn" if once else "standard deviation"
            for label, expected, ours in (("mean", mean, moment.mean()), (what, moved, got)):
                share, least = _AIM_ROOT if once else _AIM_MOMENT
                aim = max(share * abs(expected), least)
                yield _row(wind, f"{name}, {label}", expected, float(ours), aim, "kN m")


def _turbulent() -> Iterator[Check]:
    """Yield moments at the rotor apex and forces on two bearings in turbulence, NREL 5 MW."""
    from loadflow.rotor import simulate
    from loadflow.turbines import load_turbine

    from ._load_series import BANDS, compare

    tilt = load_turbine("nrel-5mw").rotor.tilt
    ours = compare([simulate(wind_speed=12, seed=seed) for seed in (1, 2, 3)], tilt)
    for (channel, measure), (expected, tolerance) in _TURBULENT.items():
        unit = "kN m" if channel.endswith("moment") or channel in SWINGING else "kN"
        yield Check(
            name=f"{channel}: {measure}, turbulence at 12 m/s",
            source=f"{_SOURCE}, three seeds",
            expected=expected,
            got=ours[channel][measure],
            tolerance=tolerance,
            unit=f"({unit})²" if measure in BANDS else unit,
        )


def _iea() -> Iterator[Check]:
    """Yield power and thrust of the IEA 15 MW turbine."""
    from loadflow.rotor import RotorOptions, steady_state
    from loadflow.turbines import load_turbine

    turbine = load_turbine("iea-15mw")
    weight = turbine.rotor_mass * 9.80665 * np.sin(turbine.rotor.tilt)
    # the coefficients are of the air alone; a tower that is bent turns weight into the shaft
    untwisted = RotorOptions(blade_torsion=False)
    points = steady_state(turbine, wind_speed=list(_IEA), shear=0.0, rung="flap", options=untwisted)
    for i, (wind, (power, thrust)) in enumerate(_IEA.items()):
        point = points.isel(wind_speed=i)
        got = float(point["power"]) / 1e6, (float(point["thrust"]) - weight) / 1e6
        for name, expected, value, aim, unit in (
            ("power", power, got[0], 0.02, "MW"),
            ("thrust", thrust, got[1], 0.03, "MN"),
        ):
            yield Check(
                name=f"IEA 15 MW: {name}, V = {wind:g} m/s",
                source="OpenFAST, IEA Wind Task 37",
                expected=expected,
                got=value,
                tolerance=aim,
                kind="relative",
                unit=unit,
                missed=_MISSED.get((wind, name), ""),
            )


def _start() -> Iterator[Check]:
    """Yield the speed of the NREL 5 MW turbine in a start."""
    from loadflow.rotor import simulate

    begin = 5.0
    series = simulate(dlc="3.1", wind_speed=12, event_time=begin, duration=70.0, run_in=5.0)
    for time, expected in _START:
        got = float(series["speed"].sel(time=begin + time, method="nearest")) * 30 / np.pi
        yield Check(
            name=f"speed {time} s after the begin of a start, V = 12 m/s",
            source=_SOURCE,
            expected=expected,
            got=got,
            tolerance=_AIM_START,
            kind="relative",
            unit="1/min",
        )


def _row(wind: float, name: str, expected: float, got: float, aim: float, unit: str) -> Check:
    relative = name in ("speed", "power", "thrust") or name.endswith("3p")
    return Check(
        name=f"{name}, V = {wind:g} m/s",
        source=_SOURCE,
        expected=expected,
        got=got,
        tolerance=aim,
        kind="relative" if relative else "absolute",
        unit=unit,
    )
