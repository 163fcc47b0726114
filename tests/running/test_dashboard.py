"""The dashboard on a run: what it draws, and that a browser shows it without a network."""

import asyncio
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec

import numpy as np
import pytest
import xarray as xr
from synthetic import cube_file

from loadflow.errors import InputError
from loadflow.running.dashboard import RunView, application
from loadflow.running.runner import run
from loadflow.scene.scene import make_scene

if find_spec("panel") is None:  # to read it takes seconds, of each process that collects tests
    pytest.skip("panel is not installed (extra view)", allow_module_level=True)
browser = pytest.importorskip("browser", reason="needs tornado, which comes with panel")


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    cube = cube_file(folder / "loads.h5", wind_speeds=(8.0, 12.0), seeds=(1,), steps=60)
    scene = make_scene(
        {
            "name": "seen",
            "accuracy": "given",
            "results": ["journal.film", "rolling.loads"],
            "loads": {"files": [str(cube)]},
            "shaft": {"two_point": {}, "moment": {}},
            "journal": {"grid": [24, 8], "bearings": ["N"]},
            "rolling": {"arrangement": "tapered-pair"},
        }
    )
    return run(scene, out=folder, report=False)


def test_it_finds_what_the_run_has(finished):
    view = RunView(finished.path)
    assert len(view.cases) == 2
    assert view.bearings() == ["N"]
    assert {"speed", "hub_moment.y", "force.N.z"} <= set(view.channels())
    assert {row["verdict"] for row in view.verdicts()} <= {
        "holds", "broken", "no limit", "not answered",
    }  # fmt: skip
    film = next(row for row in view.verdicts() if row["what"] == "smallest film")
    assert film["bearing"] == "journal N"
    assert film["value"].endswith(" µm")
    assert film["limit"] == "≥ 13.8 µm"
    assert {"loads", "journal"} <= {row["stage"] for row in view.models()}


def test_it_draws_the_numbers_of_the_run(finished):
    view = RunView(finished.path)
    case = view.cases[0]
    drawn = view.load_figure(case, "speed").axes[0].lines[0].get_ydata()
    assert np.allclose(drawn, view.series(case)["speed"] * 30 / np.pi)
    film = view.part("journal", case)["N"]
    ratio = view.film_figure(case, "N").axes[0].lines[0].get_ydata()
    assert np.allclose(ratio, film["eccentricity_ratio"], equal_nan=True)
    assert view.orbit_figure(case, "N") is not None
    assert view.film_figure(case, "N2") is None
    forces = view.rolling_figure(case).axes[0].lines[0].get_ydata()
    assert np.allclose(forces, view.part("rolling", case)["maximum_force"] / 1e3)


def test_it_draws_the_film_of_a_collar_beside_that_of_a_journal_at_one_place(finished, tmp_path):
    folder = tmp_path / "with a collar"
    shutil.copytree(finished.path, folder)
    case = RunView(folder).cases[0]
    film = RunView(folder).part("journal", case)["N"].to_dataset().load()
    collar = film.drop_vars(["eccentricity", "eccentricity_ratio"])
    collar = collar.assign(minimum_film=2 * film["minimum_film"])
    (folder / "thrust").mkdir()
    part = xr.DataTree.from_dict({"N": collar})
    part.to_netcdf(folder / "thrust" / f"{case}.h5", engine="h5netcdf")
    view = RunView(folder)
    assert view.bearings() == ["N", "N, axial"]
    ratio, *_ = view.film_figure(case, "N").axes
    assert "ε" in ratio.get_title() or "eccentricity" in ratio.get_title()
    thickness, pressure = view.film_figure(case, "N, axial").axes
    drawn = thickness.lines[0].get_ydata()
    assert np.allclose(drawn, 2e6 * film["minimum_film"], equal_nan=True)
    assert "pressure" in pressure.get_title()
    assert view.orbit_figure(case, "N, axial") is None


def test_a_folder_that_is_no_run_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"manifest\.json"):
        application(tmp_path)


def test_a_file_in_place_of_a_run_is_refused_as_one(tmp_path):
    (tmp_path / "scene.toml").write_text("", encoding="utf-8")
    with pytest.raises(InputError, match=r"scene\.toml: is a file; the folder of a run"):
        RunView(tmp_path / "scene.toml")


def test_it_tells_why_verdicts_are_missing(finished, tmp_path):
    assert RunView(finished.path).state() == "2 load cases"
    begun = tmp_path / "begun"
    shutil.copytree(finished.path, begun)
    (begun / "result.h5").unlink()
    assert RunView(begun).verdicts() == []
    assert RunView(begun).state().startswith("2 load cases so far. Not finished")
    (begun / "compare.html").touch()
    shutil.copy(finished.path / "result.h5", begun)
    (begun / "candidates" / "two-spherical").mkdir(parents=True)
    assert RunView(begun).state().endswith("Its candidates are runs: two-spherical.")


@pytest.mark.browser
@pytest.mark.skipif(browser.BROWSER is None, reason="no Chromium on this machine")
def test_a_browser_shows_verdicts_and_figures_and_follows_a_choice(finished, tmp_path):
    server = subprocess.Popen(
        [sys.executable, "-u", "-m", "loadflow.cli", "view", str(finished.path), "--no-browser"],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    try:
        address = _line(server, r"http://127\.0\.0\.1:\d+/")
        asyncio.run(_look(address, tmp_path / "profile"))
        assert _line(server, "a browser shows it")
    finally:
        server.kill()
        server.wait(20)


def _line(server, pattern):
    """What the server says that matches; others of its lines are passed over."""
    said = []
    for line in server.stdout:
        said.append(line)
        if found := re.search(pattern, line):
            return found[0]
    raise AssertionError("".join(said))


async def _look(address, profile):
    async with browser.Browser(profile) as page:
        await page.open(address)
        await page.shows("load case", "dlc1.1_v8_s1", "dlc1.1_v12_s1", "smallest film")
        await page.open(f"{address}?tab=2&case=dlc1.1_v12_s1")
        text = await page.shows("bearing", "picture")
        assert text.count("picture") >= 2  # the film over time, and the orbit
        await page.resize(400, 900)
        await asyncio.sleep(0.5)
        assert await page.evaluate("document.documentElement.scrollWidth") <= 400
        await page.open(f"{address}?tab=0")
        await page.shows("smallest film", "limit from")
        assert await page.evaluate("document.documentElement.scrollWidth") <= 400
        assert page.console == []
