"""Benchmarks can be started, share one way of measuring, and are named where they are."""

import copy
import re
from importlib import import_module
from pathlib import Path

import pytest

from benchmarks import common
from benchmarks.ladder import physics, physics_scenes, physics_sizes
from benchmarks.references import ball_inertia

ROOT = common.ROOT
FOLDERS = ("ladder", "peers", "references", "robustness")
MODULES = sorted(
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for folder in FOLDERS
    for path in (ROOT / "benchmarks" / folder).glob("*.py")
    if path.stem != "__init__"
)
NAMED = re.compile(r"benchmarks(?:\.(?:ladder|peers|references|robustness)(?:\.\w+)?|/[\w/.]+)")


def text_of(module):
    path = ROOT / Path(*module.split("."))
    return path.with_suffix(".py").read_text(encoding="utf-8")


@pytest.mark.parametrize("module", MODULES)
def test_a_benchmark_can_be_imported_and_measures_as_all_do(module):
    import_module(module)
    text = text_of(module)
    assert "argparse.ArgumentParser" not in text, "benchmarks.common.arguments"
    if "__main__" in text:
        assert "arguments(__doc__)" in text, "answers --help"
        started = module.removesuffix(".__main__")
        assert re.search(rf"{re.escape(started)}\b", text), "says how it is started"


def test_every_benchmark_that_a_page_names_is_there():
    files = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").glob("*.md")]
    files += (ROOT / "loadflow").rglob("*.py")
    named = {name for file in files for name in NAMED.findall(file.read_text(encoding="utf-8"))}
    assert len(named) > 20
    missing = [name for name in named if not is_there(name.rstrip("."))]
    assert missing == []


def is_there(name):
    path = ROOT / (name if "/" in name else name.replace(".", "/"))
    return path.exists() or path.with_suffix(".py").exists()


def test_a_time_is_the_least_and_the_answer_that_of_the_work():
    answers = iter(range(10))
    result, seconds = common.timed(lambda: next(answers), repeat=3, warm=True)
    assert result == 3
    assert 0 <= seconds < 0.1
    assert common.timed(lambda: "once") == ("once", pytest.approx(0.0, abs=0.1))


def test_a_table_is_markdown():
    assert common.head("what", "s", numbers=True) == "| what | s |\n|---|---:|"
    assert common.row("film", 1.5) == "| film | 1.5 |"


def test_what_is_between_two_marks_of_a_page_is_replaced(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("before <!-- a -->old<!-- b --> after", encoding="utf-8")
    for text in ("new", "newer"):
        common.put(page, "<!-- a -->", "<!-- b -->", text)
        assert page.read_text(encoding="utf-8") == f"before <!-- a -->\n{text}\n<!-- b --> after"


def test_a_part_of_the_page_of_physics_that_was_killed_goes_on_where_it_was(tmp_path, monkeypatch):
    asked = []

    def part(known):
        for k in range(len(known), 3):
            asked.append(k)
            yield {"k": k}
            if asked == [0, 1]:
                raise KeyboardInterrupt

    monkeypatch.setattr(physics, "BEGUN", tmp_path)
    monkeypatch.setattr(physics, "rests_on", lambda part, found: part)
    monkeypatch.setitem(physics.PARTS, "toy", part)
    with pytest.raises(KeyboardInterrupt):
        physics.measured("toy")
    assert physics.measured("toy") == [{"k": k, physics.RESTS_ON: "toy"} for k in range(3)]
    assert asked == [0, 1, 2]


def test_no_size_of_an_effect_is_older_than_the_machine_that_it_was_measured_on():
    assert physics.outdated(physics.kept_so_far()) == []


def test_a_machine_or_a_turbine_that_changed_since_it_was_measured_is_told(monkeypatch):
    places = [{"turbine": turbine, "speed": 6.0} for turbine in ("nrel-5mw", "iea-15mw")]

    def kept():
        parts = ("elements", "clearances")
        return {
            part: [one | {physics.RESTS_ON: physics.rests_on(part, one)} for one in places]
            for part in parts
        }

    before = kept()
    assert physics.outdated(before) == []
    known = physics_sizes.machine

    def wider(turbine):
        found = copy.deepcopy(known(turbine))
        if turbine == "iea-15mw":
            found["candidates"]["journal-cylindrical"]["N"]["geometry"]["width"] *= 1.01
        return found

    with monkeypatch.context() as there:
        there.setattr(physics_sizes, "machine", wider)
        assert physics.outdated(before) == ["clearances, iea-15mw, 6.0"]
    with monkeypatch.context() as there:
        there.setattr(physics_scenes, "_turbine", lambda name: name.startswith("iea"))
        assert len(physics.outdated(before)) == 4
    assert physics.outdated({"elements": places}) == [  # of nothing that is known
        "elements, nrel-5mw, 6.0",
        "elements, iea-15mw, 6.0",
    ]


def test_the_page_of_physics_has_the_numbers_that_are_kept_beside_it():
    kept = physics.kept_so_far()
    assert set(kept) == set(physics.PARTS)
    page = physics.PAGE.read_text(encoding="utf-8")
    assert physics.size_table(physics.joined(kept)) in page
    assert physics.scene_table(kept["scenes"]) in page
    assert physics.run_table(kept["runs"]) in physics.DOC.read_text(encoding="utf-8")


def test_what_the_inertia_of_balls_changes_is_shown(capsys):
    common.show([ball_inertia.change("nrel-5mw", 12.0)], as_json=False)
    name, *numbers = capsys.readouterr().out.splitlines()
    assert name == "nrel-5mw, 12 m/s"
    changes = {line.split()[0]: float(line.split()[1]) for line in numbers}
    assert changes["pressure"] == pytest.approx(changes["force"] / 3, rel=1e-2)  # p ∝ F^(1/3)
    assert changes["life"] < 0.0
