"""Everything that a journal film can have is reached from a scene and from the command line."""

import json
import tomllib
import types
import typing
from dataclasses import fields

import numpy as np
import pytest
from toy_film import TENTH, TENTH_RUNG, SoftGuembel

from loadflow.cli import main
from loadflow.errors import InputError
from loadflow.journal import Film, JournalBearing
from loadflow.journal.cavitation import LAWS
from loadflow.journal.film_model import Inlet
from loadflow.journal.relief import Relief
from loadflow.journal.rungs import RUNGS
from loadflow.journal.shapes import Shape
from loadflow.journal.shells import Shell
from loadflow.journal.supply import Restrictor
from loadflow.scene import read_scene
from loadflow.scene.journal import Journal
from loadflow.scene.scene import make_scene
from loadflow.stages.films.of_bearing import equilibria
from loadflow.studies.one_bearing import journal as journal_point

BARE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}

# one way to write each part in a scene's [journal]
LAW = {
    "gas-mixture": "cavitation = {kind = 'gas-mixture', mixing_constant = 5e4}",
    "sommerfeld": "cavitation = 'sommerfeld'",
    "guembel": "cavitation = {kind = 'guembel', cavitation_pressure = 1e4}",
    "reynolds": "cavitation = {kind = 'reynolds'}",
    "mass-conserving": "cavitation = {kind = 'mass-conserving'}",
}
BORE = {
    "Cylindrical": "geometry.shape = {kind = 'cylindrical'}",
    "Arc": "geometry.shape = {kind = 'arc', angle = 0.0, span = 2.6}",
    "Lobes": "geometry.shape = {kind = 'lobes', count = 3, preload = 0.3}",
    "TiltingPads": "geometry.shape = {kind = 'tilting pads', count = 4, arc = 1.2}",
}
RELIEF = {
    "Crown": "geometry.relief = [{kind = 'crown', height = 1e-5, length = 0.02}]",
    "Recess": "geometry.relief = [{kind = 'recess', depth = 1e-4, angle = 3.1, arc = 0.4}]",
    "Contour": (
        "geometry.relief = [{kind = 'contour', angle = [0.0, 3.1], z = [-0.05, 0.05], "
        "height = [[0.0, 1e-6], [0.0, 1e-6]]}]"
    ),
}
SHELL = {
    "LocalShell": "shell = {kind = 'local', compliance = 1e-13}",
    "LinedShell": "shell = {kind = 'lined', thickness = 2e-4, modulus = 5e10}",
    "ThickShell": "shell = {kind = 'thick', outer_diameter = 0.3, modulus = 2.1e11}",
    "MatrixShell": "shell = {kind = 'matrix', matrix = 'MATRIX'}",
    "HousedShell": (
        "shell = {kind = 'housed', outer_diameter = 0.3, "
        "support = {kind = 'feet', height = 0.2, width = 0.3}}"
    ),
    "InfluenceShell": "shell = {kind = 'influence', file = 'INFLUENCE'}",
}
FED = "supply.grooves = [{{angle = 3.0, arc = 0.3, length = 0.05, pressure = 3e5{}}}]"
SUPPLY = {
    "None": FED.format(""),
    "Capillary": FED.format(", restrictor = {diameter = 2e-3, length = 0.1}"),
    "Orifice": FED.format(", restrictor = {diameter = 2e-3, discharge_coefficient = 0.6}"),
    "ConstantFlow": (
        "supply.grooves = [{angle = 3.0, arc = 0.3, length = 0.05, restrictor = {flow = 1e-4}}]"
    ),
    "Pump": (
        "supply = {grooves = [{angle = 3.0, arc = 0.3, length = 0.05}], "
        "pump = {flow = [0.0, 1e-3], pressure = [4e5, 2e5]}}"
    ),
}
FROM_FILES = ("MatrixShell", "InfluenceShell")
INLET = {"auto": "inlet = 'auto'", "widest gap": "inlet = 'widest gap'", "None": "inlet = 'none'"}
HEAT = {"Heat": "heat = {oil = 'mineral-vg-320', inlet_temperature = 320.0}"}
CONTACT = {
    "Contact": (
        "contact = {friction = 'bronze', pattern = 3.0, asperities = {roughness = 5e-7, "
        "contact_modulus = 1e11, factor = 1e-3}}"
    )
}
WRITTEN = {
    "law": LAW,
    "bore": BORE,
    "relief": RELIEF,
    "shell": SHELL,
    "supply": SUPPLY,
    "inlet": INLET,
    "heat": HEAT,
    "contact": CONTACT,
    "rung": {rung: f"rung = '{rung}'" for rung in RUNGS},
}


def members(alias):
    """Names of the classes or values of a union."""
    found = []
    for part in typing.get_args(alias) or (alias,):
        if typing.get_origin(part) in (typing.Union, types.UnionType, typing.Literal):
            found += members(part)
        else:
            found.append(getattr(part, "__name__", str(part)).replace("NoneType", "None"))
    return set(found)


KNOWN = {
    "law": set(LAWS),
    "bore": members(Shape),
    "relief": members(Relief),
    "shell": members(Shell),
    "supply": members(Restrictor) | {"Pump", "None"},
    "inlet": members(Inlet),
    "heat": {"Heat"},
    "contact": {"Contact"},
    "rung": set(RUNGS),
}
CASES = [(kind, name) for kind, ways in WRITTEN.items() for name in ways]


@pytest.fixture
def matrix(tmp_path):
    """A file of influence coefficients of the cells of the default scene, and one of a housing."""
    cells = 60 * 20
    np.save(tmp_path / "matrix.npy", np.eye(cells) * 1e-14)
    angle, axial = np.linspace(0.0, 6.0, 24), np.linspace(-0.05, 0.05, 5)
    housing = {"angle": angle, "axial": axial, "influence": 1e-12 * np.eye(24 * 5)}
    np.savez(tmp_path / "housing.npz", **housing)
    return "matrix.npy"


def section(kind, name, matrix):
    """Lines of a scene's [journal] that ask for a part, and for nothing that its model lacks."""
    plain = "geometry = {diameter = 0.2, width = 0.1, relative_clearance = 1e-3}\n"
    if kind in ("bore", "relief"):
        line = WRITTEN[kind][name]
        table = plain.rstrip("}\n") + ", " + line.removeprefix("geometry.") + "}\n"
        return table + "edge_pressure = 1e5\n"
    lines = [
        plain,
        WRITTEN[kind][name].replace("MATRIX", matrix).replace("INFLUENCE", "housing.npz"),
    ]
    law = RUNGS[name].law if kind == "rung" else None
    if law is not None:
        lines += [f"\ncavitation = {{kind = '{law}', cavitation_pressure = 1e5}}"]
    if kind == "inlet" and name == "widest gap":
        lines += ["\ncavitation = 'guembel'"]
    return "".join(lines) + "\nedge_pressure = 1e5\n"


def test_nothing_is_out_of_reach():
    missing = {kind: KNOWN[kind] - set(WRITTEN[kind]) for kind in KNOWN}
    assert not any(missing.values()), missing
    keys = {part.name for part in fields(Film)} - set(Journal.model_fields)
    assert not keys


@pytest.mark.parametrize(("kind", "name"), CASES)
def test_scene_and_command_line_build_the_same_film(kind, name, matrix, tmp_path, monkeypatch):
    text = section(kind, name, matrix)
    file = tmp_path / "case.toml"
    file.write_text("[journal]\n" + text)
    journal = read_scene(file).journal
    built = []

    def keep(force, speed, bearing, film):
        built.append((bearing, film))
        raise SystemExit(0)

    monkeypatch.setattr(journal_point, "journal_point", keep)
    monkeypatch.chdir(tmp_path)
    point = ["--force-x", "8e3", "--speed-rpm", "900"]
    sets = [part for line in text.strip().splitlines() for part in ("--set", line)]
    viscosity = [] if kind == "heat" else ["--viscosity", "0.05"]
    for words in (["--scene", str(file)], [*viscosity, "--grid", "60", "20", *sets]):
        if words[0] != "--scene" and "cavitation" not in text:
            words = [*words, "--mixing-constant", "0.05e6"]
        with pytest.raises(SystemExit):
            main(["journal", *point, *words])
    assert len(built) == 2
    for bearing, film in built:
        assert bearing == journal.geometry
        if kind == "shell" and name in FROM_FILES:  # the scene's path is absolute
            assert type(film.shell).__name__ == name
            assert film.shell.sha256 == journal.film_model.shell.sha256
        else:
            assert film == journal.film_model
    again = make_scene(tomllib.loads(read_scene(file).to_toml())).journal
    assert again.geometry == journal.geometry
    if name != "MatrixShell":
        assert again.film_model == journal.film_model


def test_a_toy_law_is_reached_by_its_row(monkeypatch, tmp_path, capsys):
    """One class and one row: the law runs from a scene and from the command line."""
    monkeypatch.setitem(LAWS, SoftGuembel.kind, SoftGuembel)
    law = "cavitation = {kind = 'soft-guembel', tension_share = 0.5}\n"
    geometry = "geometry = {diameter = 0.2, width = 0.1, relative_clearance = 1e-3}\n"
    file = tmp_path / "toy.toml"
    file.write_text(f"[journal]\n{geometry}{law}edge_pressure = 0.0\ngrid = [36, 8]\n")
    journal = read_scene(file).journal
    assert journal.film_model.law == SoftGuembel(0.5)
    with pytest.raises(SystemExit) as end:
        main(["journal", "--scene", str(file), "--force-x", "8e3", "--speed-rpm", "900", "--json"])
    assert end.value.code in (0, None)
    answer = json.loads(capsys.readouterr().out)
    bearing = JournalBearing(**BARE)
    film = Film(journal.lubricant, SoftGuembel(0.5), grid=(36, 8))
    direct = bearing.equilibrium((8e3, 0.0), 900 * np.pi / 30, film)
    assert answer["eccentricity_ratio"]["value"] == float(direct.eccentricity_ratio)


def test_a_toy_rung_is_reached_by_its_row(monkeypatch, tmp_path, capsys):
    """One object and one row: the model runs from a scene and from the command line."""
    monkeypatch.setitem(RUNGS, TENTH_RUNG.name, TENTH_RUNG)
    scene = make_scene({"journal": {"rung": "tenth"}})
    force = np.array([[0.0, 1e6, -2e6], [0.0, -1e6, -2e6]])
    answer = equilibria(scene.journal, force, np.array([1.2, 1.3]))
    np.testing.assert_allclose(answer.eccentricity_ratio, TENTH)
    with pytest.raises(InputError, match="not for time"):
        make_scene({"journal": {"rung": "tenth", "motion": "transient"}})
    file = tmp_path / "toy.toml"
    file.write_text("[journal]\nrung = 'tenth'\n")
    with pytest.raises(SystemExit) as end:
        main(["journal", "--scene", str(file), "--force-x", "1e6", "--speed-rpm", "9", "--json"])
    assert end.value.code in (0, None)
    assert json.loads(capsys.readouterr().out)["eccentricity_ratio"]["value"] == TENTH
