"""Forces on the two main bearings over the wind speed, and the numbers taken from OpenFAST."""

import numpy as np
import pytest

from loadflow.readers import read_loads
from loadflow.readers.openfast import read_table
from loadflow.rotor import RotorOptions, simulate, steady_state
from loadflow.shaft import TwoPoint, bearing_loads
from loadflow.validation._load_series import SWINGING, compare, measures
from loadflow.validation._turbulent_series import MEASURED, SERIES
from loadflow.validation.loads import _TURBULENT

TILT = np.radians(5.0)


def test_mean_forces_on_n2_follow_the_wind_speed():
    points = steady_state("nrel-5mw", wind_speed=[4.0, 8.0, 11.4, 16.0, 24.0])
    loads = bearing_loads(
        TwoPoint(), points["hub_force"].values.T, points["hub_moment"].values.T, tilt=TILT
    )
    n2 = loads["force"].sel(bearing="N2")
    vertical, lateral = n2.sel(axis="z").values, n2.sel(axis="y").values
    assert np.all(np.diff(np.abs(vertical)) > 0)
    assert np.all(np.diff(lateral[:3]) > 0)  # rises to rated
    assert np.all(np.diff(lateral[2:]) < 0)  # then falls


def test_1p_of_an_imbalance_and_3p_reach_the_bearing():
    from scipy.signal import welch

    series = simulate(
        wind_speed=14.0,
        duration=120.0,
        run_in=20.0,
        rung="tables",
        options=RotorOptions(mass_imbalance=0.02, pitch_imbalance=0.01),
    )
    loads = bearing_loads(
        TwoPoint(), series["hub_force"].values, series["hub_moment"].values, tilt=TILT
    )
    force = loads["force"].sel(bearing="N2", axis="z").values
    f, power = welch(force, 40.0, nperseg=2048)
    once = float(series["speed"].mean()) / (2 * np.pi)
    for order in (1, 3):
        near = np.abs(f - order * once) < 0.03
        around = (np.abs(f - order * once) > 0.06) & (np.abs(f - order * once) < 0.15)
        assert power[near].max() > 3 * power[around].mean(), order


@pytest.mark.openfast
@pytest.mark.parametrize("wind", SERIES)
def test_the_numbers_of_one_series_a_wind_are_its_own(openfast_data, wind):
    file = openfast_data / f"nrel5mw_dlc11_v{wind:02.0f}_s1.outb"
    if not file.exists():
        pytest.skip(f"{file.name} is not there")
    theirs = compare([read_loads(str(file)).isel(case=0).load()], TILT)
    for channel, (expected, _) in SERIES[wind].items():
        found = [theirs[channel][measure] for measure in MEASURED]
        assert found == pytest.approx(expected, rel=1e-3), channel


@pytest.mark.openfast
def test_the_numbers_beside_ours_are_those_of_the_series(openfast_data):
    files = sorted(openfast_data.glob("nrel5mw_dlc11_v12_s*.outb"))
    theirs = compare([read_loads(str(file)).isel(case=0).load() for file in files], TILT)
    # channels that a cube does not hold, or that ours follow from others
    for channel, name in zip(SWINGING, ("RootMyc1", "RootMxc1", "YawBrMyp"), strict=True):
        tables = [read_table(file) for file in files]
        found = [
            measures(t.series(name, "N m") / 1e3, 0.025, t.series("RotSpeed", "rad/s").mean())
            for t in tables
        ]
        theirs[channel] = {m: np.mean([one[m] for one in found]) for m in found[0]}
    for (channel, measure), (expected, _) in _TURBULENT.items():
        assert theirs[channel][measure] == pytest.approx(expected, rel=1e-3), (channel, measure)
