"""The report page holds all it shows, and a real browser shows it without complaint."""

import asyncio
import base64
import json
import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from browser import BROWSER, looked_at, on_paper
from synthetic import cube_file

import loadflow as lf
from loadflow.planning.budget import Answer
from loadflow.plots.style import envelope, figure
from loadflow.report import Chart, Panel
from loadflow.report.charts import thinned
from loadflow.report.page import ASSETS
from loadflow.report.run_charts import over_wind_speed, seed_verdicts
from loadflow.running import report_state
from loadflow.running.code_stamp import code_stamp
from loadflow.running.pages.answers import answer_row, without_film
from loadflow.running.pages.report import _spread, _took, write_report
from loadflow.running.pages.verdicts import verdict_sentence, verdict_table
from loadflow.running.pages.wear import wear_section
from loadflow.running.report_state import report_is_current
from loadflow.scene.scene import make_scene
from loadflow.studies.tolerances import Band
from loadflow.verdict import Verdict, to_dataset


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
    text = page.read_text()
    addresses = re.findall(r'(?:src|href)="([^"]*)"', text)
    assert len(addresses) > 6
    assert all(address.startswith(("data:", "#")) for address in addresses)
    for target in (address[1:] for address in addresses if address.startswith("#")):
        assert f'id="{target}"' in text


def test_verdicts_and_answers_lead_to_the_series_around_their_moment(page):
    text = page.read_text()
    for title in ("Answers", "Verdicts"):
        table = text.partition(f"<caption>{title}</caption>")[2].partition("</table>")[0]
        for link, said in re.findall(r'<a href="#(at-[^"]*)">([^<]*)</a>', table):
            chart = re.search(rf'id="{re.escape(link)}".*?json">(.*?)</script>', text)
            data = json.loads(chart[1])
            if said.endswith(" s"):  # the moment is marked, and the series shown around it
                assert data["mark"] == pytest.approx(float(said.split(", ")[-1][:-2]), abs=0.051)
            labels = [panel["label"] for panel in data["panels"]]
            assert labels[0].startswith("force, ")
            film = "-M" not in link  # which stands on balls
            assert any(label.startswith("smallest film") for label in labels) == film, link
        assert 'href="#at-' in table, title


def test_the_page_opens_with_the_verdict_and_answers_and_ends_with_what_made_it(page):
    text = page.read_text()
    shown = text[text.index("<h1>") :]
    parts = [
        "<h2>Overview</h2>", " limits hold", "Not accurate enough: ", "<table", "<dt>Turbine</dt>",
        "<dt>Loads</dt>", "<svg ", "<h2>Loads</h2>", "<h2>Provenance</h2>", "<dt>Took</dt>",
        "<dt>Software</dt>",
    ]  # fmt: skip
    places = [shown.find(part) for part in parts]
    assert -1 not in places
    assert places == sorted(places)
    assert "<dl>" not in shown[: places[3]]


def test_the_page_shows_every_figure_that_was_promised(page):
    text = page.read_text()
    for section in ("Loads", "Seeds", "Reduction", "Journal bearing", "Rolling bearing"):
        assert f"<h2>{section}</h2>" in text
    assert text.count('<div class="chart"') >= 5
    assert text.count("<svg ") >= 4
    assert "MIT License" in (ASSETS / "uPlot-LICENSE.txt").read_text()


def test_the_lifetime_of_the_loads_stands_behind_them(page):
    text = page.read_text()
    assert text.index("<h2>Loads</h2>") < text.index("<h2>Lifetime of the loads</h2>")
    assert "DEL of the lifetime" in text
    for bearing in ("N", "N2", "M"):
        assert f"Bearing {bearing}: hours and revolutions above" in text
        assert f"Bearing {bearing}: Markov matrix" in text


def test_duration_and_equivalent_loads_are_those_of_the_series(page):
    """Hours, revolutions and the DEL by hand from the parts of the run."""
    tables = page.parent / "tables"
    turns = pd.read_csv(tables / "N_revolutions.csv")
    years = 20 * 8766 * 3600
    assert turns["seconds"].sum() == pytest.approx(years, rel=1e-3)
    speeds = [xr.open_dataset(p)["speed"].mean().item() for p in (page.parent / "loads").iterdir()]
    mean = 2 * np.pi * turns["revolutions"].sum() / turns["seconds"].sum()
    assert min(speeds) < mean < max(speeds)
    cases = pd.read_csv(next(tables.glob("*bearing-n-damage*.csv")))
    share = cases["share"].str.rstrip("%").astype(float) / 100
    assert share.sum() == pytest.approx(1.0, abs=1e-4)
    column = "Fz, m = 4, kN"
    whole = (share @ cases[column] ** 4) ** 0.25
    first = pd.read_csv(next(tables.glob("lifetime-of-the-loads.csv")))
    [told] = first[(first["bearing"] == "N") & first["what"].str.startswith("DEL of Fz, m = 4")][
        "value"
    ]
    assert float(told) == pytest.approx(whole, rel=2e-3)


def test_forces_that_a_bearing_never_carries_have_no_column_but_a_note(page):
    tables = page.parent / "tables"
    for path in tables.glob("lifetime-of-the-loads-bearing-*-damage*.csv"):
        ranges = pd.read_csv(path).drop(columns=["case", "share"])
        assert ranges.any().all(), path.name
    lives = pd.read_csv(tables / "lifetime-of-the-loads.csv")
    assert not (lives["value"].astype(str) == "0").any()
    text = page.read_text()
    assert "<p>Zero in all cases: Fx of bearing N" in text  # which floats
    assert {"journal-bearing.csv", "rolling-bearing.csv"} <= {p.name for p in tables.iterdir()}
    films = text.split("<h2>Journal bearing</h2>")[1]
    [zero] = re.findall(r"<summary>Zero in all cases: \d+ columns</summary><p>([^<]*)", films)
    [none] = re.findall(r"<summary>In no case: \d+ columns</summary><p>([^<]*)", films)
    assert "samples without an answer" in zero
    assert "speed of the transition at E_krit" in none  # nothing starts


def test_a_speed_does_no_damage(page):
    loads = pd.read_csv(page.parent / "tables/loads-loads.csv", dtype=str)
    told = loads.set_index("over all cases").filter(like="DEL")
    [speed] = [name for name in told.index if name.startswith("speed,")]
    assert (told.loc[speed] == "-").all()
    assert (told.drop(speed)["mean DEL (m = 4)"].astype(float) > 0).any()


def test_every_table_stands_beside_the_page_as_csv_and_no_old_one(page):
    tables = page.parent / "tables"
    old = tables / "long-gone.csv"
    old.write_text("a\n1\n")
    write_report(page.parent, again=True)
    assert not old.exists()
    names = {path.name for path in tables.glob("*.csv")}
    assert {"loads-loads.csv", "loads-ultimate-loads.csv", "N_markov.csv"} <= names
    text = page.read_text()
    shown = text.count("<table")
    assert shown <= len(names)
    loads = pd.read_csv(tables / "loads-loads.csv", dtype=str)
    assert len(loads) > 6
    for value in loads["largest"]:
        assert value in text


def test_an_unchanged_report_is_not_written_again(page, monkeypatch):
    before = page.stat().st_mtime_ns
    assert report_is_current(page.parent)
    write_report(page.parent)
    assert page.stat().st_mtime_ns == before
    manifest = page.parent / "manifest.json"
    told = manifest.read_text()
    manifest.write_text(json.dumps(json.loads(told) | {"shortfalls": ["a new one"]}))
    assert not report_is_current(page.parent)
    assert "a new one" in write_report(page.parent).read_text()
    manifest.write_text(told)
    assert "a new one" not in write_report(page.parent).read_text()
    monkeypatch.setattr(report_state, "code_stamp", lambda: "another")
    assert not report_is_current(page.parent)


def test_code_is_another_where_a_file_of_it_has_another_text_or_name(tmp_path, monkeypatch):
    def stamp():
        return code_stamp.__wrapped__()

    package = tmp_path / "package"
    shutil.copytree(Path(lf.__file__).parent / "report", package)
    own = stamp()
    monkeypatch.setattr(lf, "__file__", str(package / "__init__.py"))
    stamps = {own, stamp()}
    (package / "mark.py").touch()
    assert stamp() in stamps
    for name in ("mark.py", "assets/page.js", "templates/page.html"):
        with (package / name).open("a", encoding="utf-8") as stream:
            stream.write("\n")
        stamps.add(stamp())
    (package / "mark.py").rename(package / "marks.py")
    assert len(stamps | {stamp()}) == 6


def test_a_chart_holds_the_extremes_of_every_interval():
    rng = np.random.default_rng(3)
    time = np.arange(0.0, 600.0, 0.025)
    force = rng.normal(size=time.size)
    force[[4_321, 17_777]] = 50.0, -30.0
    x, y = thinned(time, force, 2000)
    assert y.size <= 2000
    assert np.all(np.diff(x) > 0)
    assert (y.max(), y.min()) == (50.0, -30.0)
    # within an interval of its place, too
    assert abs(x[y.argmax()] - time[4_321]) <= 2 * 600 / 2000
    assert abs(x[y.argmin()] - time[17_777]) <= 2 * 600 / 2000


def test_what_a_chart_packs_is_unpacked_within_a_65535th():
    wave = np.sin(np.arange(5000.0)) * 3e5
    wave[7] = np.nan
    text = Chart("c", "t", np.arange(5000.0) ** 2, [Panel("p", {"a": wave})], samples=6000).markup
    told = json.loads(re.search(r">(\{.*\})<", text)[1])["panels"][0]["lines"][0]["y"]
    codes = np.frombuffer(base64.b64decode(told["data"]), "<u2")
    values = told["low"] + codes * (told["high"] - told["low"]) / 65534
    assert codes[7] == 65535
    known = np.isfinite(wave)
    assert np.abs(values - wave)[known].max() <= 0.51 * 6e5 / 65534


def test_points_over_wind_speed_stand_at_their_own_case_and_none_is_left_out():
    """A case may have an answer of one bearing alone; points are not thinned as lines are."""
    cases = [f"c{k}" for k in range(3000)]
    speed = np.repeat(np.arange(30.0), 100)
    table = xr.Dataset(
        {
            name: ("case", np.arange(3000.0), {"long_name": name, "units": unit})
            for name, unit in (
                ("largest_eccentricity_ratio", "1"), ("smallest_film", "m"),
                ("largest_pressure", "1"), ("largest_ball_force", "1"),
                ("smallest_static_safety", "1"),
            )
        },
        {"case": cases, "wind_speed": ("case", speed)},
    )  # fmt: skip
    [chart] = over_wind_speed(table.isel(case=slice(1, None)), table, "c")
    number = [int(name[1:]) for name in chart.names]
    assert sorted(number) == [*range(3000)]
    assert np.array_equal(chart.x, speed[number])
    for panel in chart.panels:
        [values] = panel.lines.values()
        known = np.isfinite(values)
        assert known.sum() >= 2999
        scale = 1e6 if panel.label.endswith("µm") else 1.0
        assert np.allclose(values[known], scale * np.array(number)[known], rtol=1e-12)
    told = json.loads(re.search(r">(\{.*\})<", chart.markup)[1])
    assert len(base64.b64decode(told["x"]["data"])) == 2 * len(cases)


def test_orbits_are_thinned_to_samples_with_an_answer_the_largest_among_them():
    ratio = np.random.default_rng(1).uniform(0.2, 0.9, 9000)
    ratio[::2] = np.nan
    shown = _spread(xr.Dataset({"eccentricity_ratio": ("sample", ratio)}))["eccentricity_ratio"]
    assert shown.size == 3000
    assert np.isfinite(shown).all()
    assert shown.max() == np.nanmax(ratio)


def test_no_frame_of_a_chart_is_empty(page):
    packed = re.findall(r'<script type="application/json">(.*?)</script>', page.read_text("utf-8"))
    panels = [
        panel for text in packed for panel in json.loads(text.replace("<\\/", "</"))["panels"]
    ]
    assert len(panels) > 10
    for panel in panels:
        assert any(
            isinstance(line["y"], dict) or any(y is not None for y in line["y"])
            for line in panel["lines"]
        ), panel["label"]


def test_a_test_without_p_values_has_no_frame():
    tests, shape = ["location", "spectrum"], ("variant", "group", "component", "test")
    values = np.array([[[[0.2, np.nan]], [[1e-20, np.nan]]]])
    seeds = xr.Dataset(
        {"pvalue": (shape, values), "dlc": ("group", ["1.1", "1.1"])},
        {"variant": ["as-printed"], "component": ["N Fz"], "test": tests,
         "wind_speed": ("group", [8.0, 12.0])},
        {"alpha": 0.05},
    )  # fmt: skip
    chart = seed_verdicts(seeds, "as-printed", "tests")
    assert [panel.label for panel in chart.panels] == ["p of location"]
    assert chart.panels[0].lines["N Fz"].tolist() == [0.2, 1e-12]


def test_many_starts_and_a_large_worn_volume_are_written_out():
    """As the rest of a report: a life of 20,000 starts has no exponent."""
    each = ("minimum_film", "contact_speed", "contact_time", "contact_pressure", "contact_energy",
            "friction_energy")  # fmt: skip
    bore = xr.Dataset(
        {
            **{name: (("renewal", "cycle"), [[2e7], [1e-6]]) for name in each},
            "depth_of_bore": (("angle", "axial"), [[0.0], [1.08e-5]]),
            "roughness": ("renewal", [5e-7, 4e-7]),
            "count": ("cycle", [2e4]),
            "case": ("cycle", ["start"]),
        },
        {"angle": [0.0, 1.0], "cycle": ["start"]},
        {"cycles": 1, "volume": 1.37e-5},
    )
    worn, each_start = wear_section({"N": bore}).tables
    assert worn.rows == [["N", "1", "10.8", "13700", "57.3 … 57.3", "0.4"]]
    assert [row[:2] for row in each_start.rows] == [
        ["start N, new", "20000"], ["start N, worn", "20000"],
    ]  # fmt: skip
    assert each_start.rows[0][-1] == "20000"
    spells = bore.assign_coords(cycle=["start, 2"])
    both = xr.concat([bore, spells], "cycle", data_vars="minimal", combine_attrs="override")
    worn, each_spell = wear_section({"N": both}).tables
    assert worn.rows[0][1] == "1"  # both of one load case
    assert len(each_spell.rows) == 4


def test_answers_have_a_unit_that_fits_on_value_and_interval():
    kept = {"result": "journal.film", "bearing": "N", "error": 0.03}
    pressure = Answer(quantity="p", unit="Pa", value=2e7, low=1.9e7, high=2.1e7, **kept)
    ratio = Answer(quantity="e", unit="1", value=0.8, low=0.7, high=0.81, **kept)
    assert answer_row(pressure)[1] == "journal N"
    assert answer_row(pressure)[2:4] == ["20 MPa", "19 … 21 MPa"]
    assert answer_row(ratio)[2:4] == ["0.8", "0.7 … 0.81"]
    banded = replace(pressure, band=Band(-0.1, 0.2, {"clearance": 0.2}))
    assert answer_row(banded, banded=True)[4:7] == [
        "18 … 24 MPa",
        "≤ 3 %",
        "tolerance of clearance",
    ]


COUNT = """(() => {
  for (const one of document.querySelectorAll('details')) one.open = true;
  return document.querySelectorAll('.chart').length;
})()"""
DRAWN = """[...document.querySelectorAll('.chart')].filter(box => box.plots &&
  box.plots.every(plot => {
  const c = plot.root.querySelector('canvas'), {left, top, width, height} = plot.bbox;
  const seen = new Set(new Uint32Array(
    c.getContext('2d').getImageData(left, top, width, height).data.buffer));
  return c.width > 100 && seen.size > 3;
})).length"""
WIDE = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
PRESS = """(key => { const box = document.querySelector('#loads .chart');
  box.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
  const {min, max} = box.plots[0].scales.x; return max - min; })"""
DECADES = """[...document.querySelectorAll('.chart')].flatMap(box => box.plots)
  .filter(plot => plot.scales.y.distr === 3)
  .map(plot => plot.axes[1]._values.filter(label => label))"""
SORT = """(() => { const table = document.querySelector('#journal-bearing table.sortable');
  const head = table.querySelectorAll('thead th')[1];
  const column = () => [...table.tBodies[0].rows].map(row => Number(row.cells[1].textContent));
  head.focus(); head.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true}));
  const up = column(); head.click(); return [up, column(), head.getAttribute('aria-sort')]; })()"""


@pytest.mark.browser
@pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine")
def test_a_browser_draws_every_chart_zooms_sorts_and_prints(page, tmp_path):
    async def look(browser):
        await browser.shows("Journal bearing", "Provenance")
        count = await browser.evaluate(COUNT)
        for width in (400, 1600):
            await browser.resize(width)
            await browser.becomes(f"{DRAWN} === {count}")
            assert await browser.evaluate(WIDE) <= 0, width
        decades = await browser.evaluate(DECADES)
        whole = await browser.evaluate(f"{PRESS}('0')")
        await asyncio.sleep(0.2)
        await browser.evaluate(f"{PRESS}('+')")
        await asyncio.sleep(0.2)
        half = await browser.evaluate(f"{PRESS}('Shift')")
        up, down, said = await browser.evaluate(SORT)
        sheets = await browser.printed()
        errors = [text for text in browser.console if page.as_uri() not in text]
        return count, decades, whole, half, up, down, said, sheets, errors

    told = looked_at(page.as_uri(), tmp_path / "profile", look)
    count, decades, whole, half, up, down, said, sheets, errors = told
    assert count >= 5
    assert decades
    for labels in decades:  # of a logarithmic scale: each once, and short
        assert len(labels) == len({*labels}) > 1
        assert max(map(len, labels)) <= 5
    assert half == pytest.approx(whole / 2)
    assert up == sorted(up)
    assert down == sorted(up, reverse=True)
    assert said == "descending"
    assert {*sheets} == {(595, 842), (842, 595)}  # A4, and the widest table on one that lies
    assert errors == []


FOLLOWED = """(() => { const one = document.activeElement, plot = one.plots && one.plots[0];
  return plot && { there: '#' + one.id === location.hash, top: one.getBoundingClientRect().top,
    span: plot.scales.x.max - plot.scales.x.min, at: plot.cursor.idx ?? null,
    read: plot.root.querySelector('.u-value').textContent }; })()"""
HIDDEN = """(() => { const label = document.activeElement, box = label.closest('.chart');
  return box.plots.flatMap(plot => plot.series).filter(one => one.show === false).length; })()"""


@pytest.mark.browser
@pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine")
def test_a_keyboard_alone_sorts_follows_zooms_reads_hides_and_unfolds(page, tmp_path):
    async def look(browser):
        passed = await browser.tab_to("table.sortable th")
        await browser.press("Enter")
        assert await browser.evaluate("document.activeElement.ariaSort") == "ascending"

        passed += await browser.tab_to('td a[href^="#at-"]')
        await browser.press("Enter")
        await browser.becomes(f"({FOLLOWED} || {{}}).there")  # within what was folded
        before = await browser.evaluate(FOLLOWED)
        assert -1 < before["top"] < 1200
        await browser.press("+", shift=True)  # as many keyboards have it
        await browser.press("ArrowRight", shift=True)
        await browser.press("ArrowRight", shift=True)
        after = await browser.evaluate(FOLLOWED)
        assert after["span"] == pytest.approx(before["span"] / 2)
        assert after["at"] > 0
        assert float(after["read"]) > 0
        await browser.press("ArrowLeft", shift=True)
        assert (await browser.evaluate(FOLLOWED))["at"] < after["at"]

        passed += await browser.tab_to(".u-legend th")
        for hidden in (1, 0):
            await browser.press("Enter")
            assert await browser.evaluate(HIDDEN) == hidden
        passed += await browser.tab_to("summary")
        await browser.press("Enter")
        assert await browser.evaluate("document.activeElement.parentNode.open")
        return passed

    passed = looked_at(page.as_uri(), tmp_path / "profile", look)
    assert len(passed) > 20
    unseen = [one for one in passed if one and not (one["seen"] and one["outlined"])]
    assert unseen == []


@pytest.mark.browser
@pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine")
def test_a4_holds_the_report_with_what_was_folded_and_nothing_beyond_its_edge(page, tmp_path):
    def look(browser):
        return on_paper(browser, 182.0)

    told = looked_at(page.as_uri(), tmp_path / "profile", look)
    assert told["folded"] == told["again"] > 3
    assert told["lost"] == told["silent"] == 0
    assert len(told["other"]) > 20
    assert max(told["other"]) <= 688  # px, 182 mm
    assert 0 < max(told["wide"]) <= 1032  # 273 mm
    assert told["smallest"] >= 6.5 / 0.75  # 6.5 pt


def test_films_of_verdicts_stand_in_micrometres_and_ratios_without_a_unit():
    film = Verdict("journal N", "smallest film", 1.857e-4, 1.38e-5, "at least", "m")
    ratio = Verdict("journal N", "eccentricity ratio ε", 0.75, 0.95, "at most")
    life = Verdict("rolling M", "rating life L10h", 20 * 8766.0, 10 * 8766.0, "at least", "h")
    table = to_dataset([film, ratio, life])
    [shown] = verdict_table({"verdicts": table})
    assert shown.rows[0][2:5] == ["185.7 µm", "≥ 13.8 µm", "171.9 µm"]
    assert shown.rows[1][2:5] == ["0.75", "≤ 0.95", "0.2"]
    assert shown.rows[2][2:5] == ["20 years", "≥ 10 years", "10 years"]


def test_the_report_begins_with_how_many_limits_hold_and_which_do_not(page):
    kept = Verdict("journal N", "eccentricity ratio ε", 0.75, 0.95, "at most")
    film = Verdict("journal N", "smallest film", 1e-5, 1.38e-5, "at least", "m")
    lost = Verdict("rolling M", "static safety", np.nan, 1.0, "at least")
    told = Verdict("rolling M", "largest force", 1e5, np.nan, "at most", "N")
    said = verdict_sentence({"verdicts": to_dataset([kept, film, lost, told])})
    assert said == (
        "1 of 3 limits hold; broken: smallest film (journal N, 10 µm, limit ≥ 13.8 µm); "
        "not answered: static safety (rolling M)."
    )
    assert verdict_sentence({"verdicts": to_dataset([kept])}) == "1 of 1 limits hold."
    overview = page.read_text().split("<h2>Overview</h2>")[1]
    assert re.match(r'\s*<p class="conclusion">\d+ of \d+ limits hold', overview)
    points = re.findall("<li>(.*?)</li>", overview[: overview.index("<table")])
    assert any(one.startswith("Not accurate enough: ") for one in points)
    assert sum("±" in one and "smallest film" in one for one in points) <= 1  # one interval each


def test_films_that_end_where_surfaces_touch_are_told_beside_the_answers():
    touching = [[3, 2, 0], [0, 0, 0]]
    table = xr.Dataset(
        {"in_contact": (("bearing", "case"), touching)},
        {"bearing": ["N", "N2"], "case": ["a", "b", "c"]},
    )
    scene = make_scene({"name": "x", "shaft": {"two_point": {}}})
    said = without_film(scene, {"journal": table})
    assert said.startswith("Where surfaces touch there is no film (journal N, 5 samples in 2 load")
    assert "N2" not in said
    rough = {"asperities": {"roughness": 1e-6, "contact_modulus": 1e11, "factor": 1e-3}}
    scene = make_scene(
        {
            "name": "x",
            "shaft": {"two_point": {}},
            "journal": {"contact": rough, "edge_pressure": 0.0},
        }
    )
    assert without_film(scene, {"journal": table}) == ""  # asperities carry: all are answered


def test_what_a_run_took_is_told_in_minutes_where_it_is_long():
    assert _took({"wall_seconds": 1618.0, "workers": 1}) == "27 min with 1 process"
    assert _took({"wall_seconds": 40.0, "workers": 2}) == "40 s with 2 processes"


def test_a_long_series_is_drawn_with_its_extremes():
    values = np.zeros(100_000)
    values[54_321], values[77_777] = 5.0, -3.0
    _, axis = figure()
    envelope(axis, np.arange(values.size), values, "spikes")
    drawn = axis.lines[0].get_ydata()
    assert drawn.size < 4000
    assert (drawn.max(), drawn.min()) == (5.0, -3.0)
