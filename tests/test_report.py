"""The report page holds all it shows, and a real browser shows it without complaint."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from synthetic import cube_file

import loadflow as lf
from loadflow.plots.style import envelope, figure
from loadflow.scene.scene import make_scene

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report")
    scene = make_scene(
        {
            "name": "page",
            "loads": {"source": "files", "files": [str(cube_file(folder / "loads.h5"))]},
            "reduction": {"size": 0.05},
            "journal": {"grid": [24, 8]},
        }
    )
    return lf.run(scene, out=folder).report


def test_the_page_needs_no_other_file_and_no_network(page):
    addresses = re.findall(r'(?:src|href)="([^"]*)"', page.read_text())
    assert len(addresses) > 10
    assert all(address.startswith(("data:", "#")) for address in addresses)


def test_the_page_shows_every_figure_that_was_promised(page):
    text = page.read_text()
    for section in ("Loads", "Seeds", "Reduction", "Journal bearing", "Rolling bearing"):
        assert f"<h2>{section}</h2>" in text
    assert text.count("<img ") >= 12


@pytest.mark.browser
@pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine")
def test_a_browser_loads_every_figure_without_a_console_error(page, tmp_path):
    # the copy says in its title how many pictures came out with a size, after all has loaded
    probe = (
        "<script>window.addEventListener('load', () => {"
        "const all = [...document.images];"
        "const shown = all.filter(i => i.naturalWidth > 100).length;"
        "document.title = `shown ${shown} of ${all.length}`;"
        "});</script></body>"
    )
    copy = tmp_path / "probe.html"
    copy.write_text(page.read_text().replace("</body>", probe), encoding="utf-8")
    done = subprocess.run(
        [
            BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            "--enable-logging=stderr", f"--user-data-dir={tmp_path / 'profile'}",
            "--virtual-time-budget=5000", "--dump-dom", copy.as_uri(),
        ],
        capture_output=True, text=True, timeout=900, check=True,
    )  # fmt: skip
    shown, there = map(int, re.search(r"<title>shown (\d+) of (\d+)</title>", done.stdout).groups())
    assert shown == there >= 12
    assert "CONSOLE" not in done.stderr


def test_a_long_series_is_drawn_with_its_extremes():
    values = np.zeros(100_000)
    values[54_321], values[77_777] = 5.0, -3.0
    _, axis = figure()
    envelope(axis, np.arange(values.size), values, "spikes")
    drawn = axis.lines[0].get_ydata()
    assert drawn.size < 4000
    assert (drawn.max(), drawn.min()) == (5.0, -3.0)
