"""What bearings lose of the power of the rotor, against Table 5-23 of [Jonuschies 2015]."""

import numpy as np
import pytest
import xarray as xr

from loadflow.running.pages.energy import energy_table
from loadflow.scene.scene import make_scene
from loadflow.stages import loads
from loadflow.studies.lifetime.energy import run_energy
from loadflow.studies.lifetime.finished_run import run_lifetime

# V in m/s: supply, friction, loss kW, turbine MW, η %, Q l/min
TABLE = {
    4.0: (1.07, 2.58, 3.65, 0.29, 98.77, 107.26),
    8.0: (0.99, 4.94, 5.93, 2.18, 99.73, 98.71),
    12.0: (0.96, 6.40, 7.37, 4.97, 99.85, 96.49),
    24.0: (0.85, 7.73, 8.59, 5.18, 99.83, 85.81),
}
SCENE = make_scene(
    {"name": "x", "results": ["journal.film"], "bearings": {"N2": {"kind": "journal"}}}
)


def tables():
    """Results of a run that found what the table prints."""
    rows = np.array(list(TABLE.values()))
    cases = {
        "case": [f"dlc1.2_v{v:g}_s1" for v in TABLE],
        "dlc": ("case", ["1.2"] * len(TABLE)),
        "wind_speed": ("case", list(TABLE)),
        "weight": ("case", [0.25] * len(TABLE)),
        "length": ("case", [600.0] * len(TABLE)),
    }

    def of_bearing(values):
        return ("bearing", "case"), values[None]

    film = {
        "lost_power": of_bearing(1e3 * rows[:, 1]),
        "mean_supply_power": of_bearing(1e3 * rows[:, 0]),
        "mean_side_flow": of_bearing(rows[:, 5] / 6e4),
    }
    # the table's power is that behind the bearing
    rotor = 1e6 * rows[:, 3] + 1e3 * rows[:, 2]
    return {
        "loads": xr.Dataset({"rotor_power": ("case", rotor)}, cases),
        "journal": xr.Dataset(film, cases | {"bearing": ["N2"]}),
    }


def test_efficiency_is_that_of_the_printed_table():
    found = run_energy(SCENE, tables())
    printed = np.array([row[4] for row in TABLE.values()])
    # P_turbine is printed to 10 kW, which moves the first row by 0.04
    np.testing.assert_allclose(100 * found["journal_efficiency"][0], printed, atol=0.05)
    loss = np.array([row[2] for row in TABLE.values()])
    np.testing.assert_allclose(found["journal_loss"][0], 1e3 * loss, atol=15.0)


def test_the_oil_takes_the_loss_along():
    found = run_energy(SCENE, tables())
    rise, flow = (found[f"journal_{name}"].values[0] for name in ("oil_rise", "flow"))
    film = SCENE.journal
    carried = film.lubricant.density * 2000.0 * flow * rise
    np.testing.assert_allclose(carried, found["journal_loss"].values[0], rtol=1e-12)
    warm = make_scene(
        {"name": "x", "results": ["journal.film"], "bearings": {
            "N2": {"kind": "journal", "heat": {"oil": "iso-vg-68", "heat_capacity": 1000.0}}}}
    )  # fmt: skip
    assert warm.journal.volume_heat == pytest.approx(
        1000.0 * warm.journal.heat.liquid.density(313.15)
    )


def test_a_year_has_the_energy_of_rotor_and_bearing():
    found = tables()
    lifetime = run_lifetime(SCENE, found)
    share = float(lifetime["journal_energy"][0] / lifetime["rotor_energy"])
    balance = run_energy(SCENE, found)
    lost = 1 - balance["journal_efficiency"].values
    assert lost.min() < share < lost.max()


def test_a_standing_rotor_has_no_efficiency_and_unknown_power_no_balance():
    found = tables()
    found["loads"]["rotor_power"][0] = -100.0
    left = run_energy(SCENE, found)["journal_efficiency"].values[0]
    assert np.isnan(left).tolist() == [True, False, False, False]
    assert run_energy(SCENE, {"journal": found["journal"]}) is None
    assert run_energy(SCENE, {"loads": found["loads"]}) is None


def test_the_page_has_a_row_of_each_wind():
    (table,) = energy_table({"energy": run_energy(SCENE, tables())})
    assert [row[2] for row in table.rows] == ["4", "8", "12", "24"]
    assert table.rows[0][0] == "journal N2"
    assert float(table.rows[3][5]) == pytest.approx(99.83, abs=0.01)
    assert [*energy_table({})] == []


def test_loads_tell_their_power():
    class Case:
        name, dlc, wind_speed, seed, weight, duration = "a", "1.2", 8.0, 1, 1.0, 1.0

    time = np.linspace(0.0, 1.0, 11)
    moment = np.zeros((3, 11))
    moment[0] = 2e6
    part = xr.Dataset(
        {"speed": ("time", 1.0 + time), "hub_moment": (("axis", "time"), moment)},
        {"time": time, "axis": ["x", "y", "z"], "standing_share": 0.0, "doubts": ""},
    )
    assert loads.summary({Case(): part})["rotor_power"].item() == pytest.approx(3e6)
