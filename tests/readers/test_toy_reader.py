"""A reader is one file and one row: its files run through a scene and through the command line."""

import json

import numpy as np
import pytest
from synthetic import case
from toy_reader import BARS

import loadflow as lf
from loadflow.cli import main
from loadflow.errors import InputError
from loadflow.readers import registry
from loadflow.readers.aliases import COMPONENTS
from loadflow.scene.scene import make_scene

AXES = {"x": 0, "y": 1, "z": 2}


@pytest.fixture
def toy(monkeypatch):
    """The row; modules that import the tuple see a longer one."""
    readers = (*registry.READERS, BARS)
    monkeypatch.setattr(registry, "READERS", readers)
    monkeypatch.setattr("loadflow.readers.loads.READERS", readers)


def write(path, series):
    """Write a case as the format has it: forces in kN."""
    columns = {"time": series["time"].values}
    for name in COMPONENTS:
        base, _, axis = name.rpartition("_")
        if name in series:
            columns[name] = series[name].values
        elif base in series:
            columns[name] = series[base].values[AXES[axis]] / 1e3
    rows = np.column_stack(list(columns.values())).tolist()
    lines = ["|".join(columns), *("|".join(map(repr, row)) for row in rows)]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_a_toy_reader_is_reached_from_a_scene_by_its_row(toy, tmp_path):
    series = case(8.0, 1)
    file = write(tmp_path / "dlc1.1_ws08_seed1.bars", series)
    scene = make_scene(
        {
            "name": "toy-reader",
            "accuracy": "given",
            "loads": {"source": "files", "files": [str(file)]},
            "results": ["loads.statistics"],
        }
    )
    run = lf.run(scene, out=tmp_path, report=False, workers=1)
    found = run.tree["statistics"]["hub_force"]
    mean = float(found.sel(statistic="mean", axis="z").squeeze())
    assert mean == pytest.approx(float(series["hub_force"].values[2].mean()), rel=1e-5)


def test_a_toy_reader_is_reached_from_the_command_line_by_its_row(toy, tmp_path, capsys):
    file = write(tmp_path / "dlc1.1_ws08_seed1.bars", case(8.0, 1))
    with pytest.raises(SystemExit) as end:
        main(["convert", str(file), "--list", "--json"])
    assert end.value.code in (0, None)
    assert json.loads(capsys.readouterr().out)[0]["wind_speed"] == 8.0
    cube = lf.read_loads(file, quiet=True)
    assert cube["hub_force"].attrs["units"] == "N"


def test_without_its_row_the_format_is_unknown(tmp_path):
    file = write(tmp_path / "dlc1.1_ws08_seed1.bars", case(8.0, 1))
    with pytest.raises(InputError, match="no reader for this kind of file"):
        lf.read_loads(file)


def test_damaged_files_of_a_toy_format_are_refused_by_name(toy, tmp_path):
    file = write(tmp_path / "dlc1.1_ws08_seed1.bars", case(8.0, 1))
    lines = file.read_text().splitlines()
    for damaged in ([], lines[:2], [*lines[:5], lines[5].rpartition("|")[0], *lines[6:]]):
        file.write_text("\n".join(damaged))
        with pytest.raises(InputError, match=file.name):
            lf.read_loads(file)
    nan = lines[3].split("|")
    nan[1] = "nan"
    file.write_text("\n".join([*lines[:3], "|".join(nan), *lines[4:]]))
    with pytest.raises(InputError, match="not finite"):
        lf.read_loads(file)
