"""Every load case of the standard that loadflow knows runs to a report, in a short form."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import loadflow as lf
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import read_scene
from loadflow.wind import LOAD_CASES
from loadflow.wind.cases import VARIANTS

FOLDER = Path(__file__).parents[1] / "pipelines"
PIPELINES = {
    "dlc_1_1": ("1.1", "1.2"),
    "dlc_1_3": ("1.3",),
    "dlc_1_4": ("1.4", "1.5"),
    "dlc_2_2": ("2.1", "2.2", "2.3", "2.4"),
    "dlc_3_1_startup": ("3.1", "3.2", "3.3"),
    "dlc_4_2_shutdown": ("4.1", "4.2"),
    "dlc_5_1": ("5.1",),
    "dlc_6_1_parked": ("6.1", "6.2", "6.3"),
    "dlc_6_4_idling": ("6.4",),
    "dlc_7_1": ("7.1",),
}
"""Load cases by the scene that runs them; it takes others of its group by `loads.dlc`."""
SPEEDS = {"6.1": 50.0, "6.2": 50.0, "6.3": 40.0, "7.1": 40.0}
"""Wind speed, m/s, of load cases in storms; the others have 12."""
GUST, LENGTH = 25.0, 60.0
"""Start of a gust or a fault and length of a series, s."""
START = -15.0
"""Start of the rotor from there, s: the gust meets it as it runs up."""


def test_each_load_case_has_a_scene():
    assert sorted(dlc for dlcs in PIPELINES.values() for dlc in dlcs) == sorted(LOAD_CASES)


def short(dlc, monkeypatch):
    """One case of `LENGTH`, with its gust and its event at `GUST`."""
    row = LOAD_CASES[dlc]
    delay = START if row.events == ("start",) else 0.0
    early = {"gust_time": GUST, "event_delays": (delay,), "yaw_errors": row.yaw_errors[:1]}
    monkeypatch.setitem(LOAD_CASES, dlc, replace(row, **early))
    if row.wind in VARIANTS:
        monkeypatch.setitem(VARIANTS, row.wind, VARIANTS[row.wind][:1])
    name = next(name for name, dlcs in PIPELINES.items() if dlc in dlcs)
    scene = read_scene(FOLDER / f"{name}.toml")
    keys = {"dlc": dlc, "wind_speeds": [SPEEDS.get(dlc, 12.0)], "seeds": 1, "azimuths": [0.0]}
    keys |= {"duration": LENGTH, "step": 0.05, "rung": "tables"}
    loads = type(scene.loads).model_validate(scene.loads.model_dump(exclude_unset=True) | keys)
    return scene.model_copy(update={"loads": loads})


@pytest.mark.slow
@pytest.mark.parametrize("dlc", LOAD_CASES)
def test_every_load_case_of_the_standard_that_loadflow_knows_runs_to_a_report(
    dlc, tmp_path, monkeypatch
):
    scene = short(dlc, monkeypatch)
    cases = list_cases(scene)
    assert [case.dlc for case in cases] == [dlc]
    run = lf.run(scene, out=tmp_path)
    assert run.failures == {}
    assert run.report.stat().st_size > 0
    wanted = {giving.split(".")[0] for giving in scene.results} - {"loads", "reduction", "seeds"}
    assert wanted | {"statistics"} <= {*run.tree.children}
    journal = run.tree["journal"].to_dataset()
    assert np.isfinite(journal["smallest_film"].values).all()
    for place in run.flagged:  # samples without an answer are counted, and a warning says why
        stage = place.rsplit(", ", 1)[1]
        assert any(stage in warning for warning in run.warnings), (place, run.warnings)
