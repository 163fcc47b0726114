"""The notebooks run from top to bottom, and what they keep is small."""

import json
import os
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed (extra test)")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel", reason="ipykernel is not installed (extra test)")

FOLDER = Path(__file__).parents[1] / "notebooks"
FAST = ("journal_film_and_orbit", "rolling_bearing_revolution", "speed_against_error")
"""Those that take a few seconds; the others simulate loads."""
NAMES = sorted(path.stem for path in FOLDER.glob("*.ipynb"))
LARGEST = 500_000


def test_there_is_one_for_each_topic():
    assert {*FAST, "cube_explorer", "seeds", "reduction", "compare"} == {*NAMES}


@pytest.mark.parametrize(
    "name", [n if n in FAST else pytest.param(n, marks=pytest.mark.slow) for n in NAMES]
)
def test_it_runs_from_top_to_bottom(name, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "module://matplotlib_inline.backend_inline")
    book = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    here = str(FOLDER.parent)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([here, os.environ.get("PYTHONPATH", "")]))
    client = nbclient.NotebookClient(book, timeout=300, kernel_name="python3")
    client.execute(cwd=str(FOLDER))
    outputs = [o for cell in book.cells for o in cell.get("outputs", [])]
    assert outputs
    said = [o.get("text", "") for o in outputs if o.get("name") == "stderr"]
    assert not [text for text in said if "Error" in text or "Warning" in text], said


@pytest.mark.parametrize("name", NAMES)
def test_what_it_keeps_is_small_whole_and_of_no_machine(name):
    path = FOLDER / f"{name}.ipynb"
    text = path.read_text(encoding="utf-8")
    assert len(text) < LARGEST
    book = json.loads(text)
    cells = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    assert any(cell["outputs"] for cell in cells)
    for cell in cells:
        assert not [o for o in cell["outputs"] if o["output_type"] == "error"]
    assert "/home/" not in text
    assert "/tmp/" not in text


@pytest.mark.parametrize("name", NAMES)
def test_every_figure_of_it_is_a_picture_and_stands_there_once(name):
    book = json.loads((FOLDER / f"{name}.ipynb").read_text(encoding="utf-8"))
    for cell in book["cells"]:
        shown = [o["data"] for o in cell.get("outputs", []) if "data" in o]
        figures = [data for data in shown if "".join(data["text/plain"]).startswith("<Figure")]
        assert all("image/png" in data for data in figures)
        assert len(figures) <= 1
        assert not any("".join(d["text/plain"]).startswith("<function") for d in shown)
