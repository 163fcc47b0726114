"""Models of the film: one registry, and what each of them refuses by name."""

import numpy as np
import pytest
from toy_film import TENTH, TENTH_RUNG

from loadflow.errors import InputError
from loadflow.journal import (
    Capillary,
    Contact,
    Contour,
    Crown,
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    Guembel,
    Heat,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Recess,
    Reynolds,
    Sommerfeld,
    Supply,
    ThickShell,
    Turbulence,
)
from loadflow.journal.rungs import FEATURES, RUNGS
from loadflow.tribology import AsperityContact

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
BEARING = JournalBearing(**SIZE)
OIL = Lubricant(0.03)
ROUGH = Contact(AsperityContact(roughness=5e-7, contact_modulus=1e11, factor=1e-3))
LOAD, TIME = (8e3, 1e3), np.linspace(0.0, 0.01, 3)

# of every feature: what asks for it, as fields of the film, of the bearing and of the verb
ASKING = {
    "shape": ({}, {"shape": Lobes(3)}, {}),
    "relief": ({}, {"relief": (Recess(1.0, 0.3, depth=1e-5),)}, {}),
    "contour": ({}, {"relief": (Contour((0.0, 3.0), (0.0, 1e-5)),)}, {}),
    "crown": ({}, {"relief": (Crown(height=1e-5, length=0.02),)}, {}),
    "moment": ({}, {}, {"moment": (1.0, 0.0)}),
    "tilt": ({}, {}, {"tilt": (1e-5, 0.0)}),
    "bend": ({}, {}, {"bend": (1e-5, 0.0)}),
    "supply": ({"supply": Supply((Groove(1.0, arc=0.3, pressure=2e5),))}, {}, {}),
    "inlet": ({"inlet": "widest gap", "cavitation": Reynolds()}, {}, {}),
    "grading": ({"grading": "graded"}, {}, {}),
    "shell": ({"shell": ThickShell(outer_diameter=0.3, modulus=2.1e11)}, {}, {}),
    "local_shell": ({"shell": LocalShell(1e-12)}, {}, {}),
    "heat": ({"lubricant": None, "heat": Heat()}, {}, {}),
    "slow_heat": ({"lubricant": None, "heat": Heat(capacity=1e5)}, {}, {}),
    "film_heat": ({"lubricant": None, "heat": FilmHeat(shell_transfer=500.0)}, {}, {}),
    "contact": ({"contact": ROUGH}, {}, {}),
    "turbulence": ({"turbulence": Turbulence()}, {}, {}),
    "pressure_coefficient": ({"lubricant": Lubricant(0.03, pressure_coefficient=2e-8)}, {}, {}),
    "step": ({}, {}, {"step": "adaptive"}),
    "periodic": ({}, {}, {"periodic": True}),
}


AT_REST = [name for name in FEATURES if name not in ("step", "periodic", "slow_heat")]
IN_MOTION = list(FEATURES)


def film_for(rung, **words):
    """A film that the rung knows, but for `words`."""
    base = {"lubricant": OIL, "grid": (36, 8), "rung": rung}
    if RUNGS[rung].law is None:
        base |= {"cavitation": GasMixture(5e4), "edge_pressure": 1.5e5, "inlet": None}
    return Film(**base | words)


@pytest.mark.parametrize("feature", AT_REST)
@pytest.mark.parametrize("rung", RUNGS)
def test_at_rest_a_rung_answers_or_refuses_by_name(rung, feature):
    film, size, more = ASKING[feature]
    bearing, described = JournalBearing(**SIZE | size), film_for(rung, **film)
    own = {"grading", "inlet"} if RUNGS[rung].law else set()  # no mesh, and an inlet of its own
    if rung == "hahn":
        own = {"grading"}
    if feature in RUNGS[rung].at_rest | own:
        if rung != "map":  # whose tables have tests of their own
            assert bearing.equilibrium(LOAD, 100.0, described, **more).converged
        return
    named = rung if RUNGS[rung].law else f"rung = '{rung}' .* {feature} = "
    with pytest.raises(InputError, match=named):
        bearing.equilibrium(LOAD, 100.0, described, **more)


@pytest.mark.parametrize("feature", IN_MOTION)
@pytest.mark.parametrize("rung", ["map", "reduced", "grid", "holland"])
def test_in_motion_a_rung_refuses_by_name_what_it_does_not_know(rung, feature):
    film, size, more = ASKING[feature]
    if feature in RUNGS[rung].in_motion or (RUNGS[rung].law and feature in ("inlet", "grading")):
        return
    first = feature
    with pytest.raises(InputError, match=rf"rung = '{rung}' .* {FEATURES[first]}; {first} = "):
        JournalBearing(**SIZE | size).orbit(
            TIME, np.tile(LOAD, (3, 1)), 100.0, film_for(rung, **film), **more
        )


@pytest.mark.parametrize("rung", ["chart", "table", "holland", "butenschoen"])
@pytest.mark.parametrize(
    "words",
    [
        {"cavitation": GasMixture(5e4), "edge_pressure": 1e5},
        {"cavitation": MassConserving(), "edge_pressure": 1e5},
        {"cavitation": Guembel()},
        {"cavitation": Sommerfeld()},
        {"cavitation": Reynolds(), "edge_pressure": 1e5},
    ],
)
def test_a_chart_refuses_laws_and_pressures_that_are_not_its_own(rung, words):
    with pytest.raises(InputError, match=rf'cavitation = .* reynolds .* rung = "{rung}"'):
        BEARING.equilibrium(LOAD, 100.0, OIL, rung=rung, **words)


def test_a_chart_knows_its_film_at_any_ambient_pressure():
    low, high = (
        BEARING.equilibrium(LOAD, 100.0, OIL, rung="chart", edge_pressure=p, cavitation=law)
        for p, law in ((0.0, None), (1e5, Reynolds(1e5)))
    )
    assert high.minimum_film == low.minimum_film
    assert high.maximum_pressure == pytest.approx(float(low.maximum_pressure) + 1e5)
    with pytest.raises(InputError, match=r'inlet = None .* "chart"'):
        BEARING.equilibrium(LOAD, 100.0, OIL, rung="chart", inlet=None)


def test_hahn_has_no_inlet_line():
    with pytest.raises(InputError, match=r'inlet = .* "hahn"'):
        BEARING.equilibrium(LOAD, 100.0, OIL, rung="hahn", inlet="widest gap")


def test_a_rung_without_a_field_of_pressure_names_those_that_have_one():
    with pytest.raises(InputError, match=r'rung = "map" .* "reduced" or "grid" for a field'):
        BEARING.pressure((0.0, 0.0), 100.0, film_for("map"))


def test_a_rung_is_one_object_and_one_row(monkeypatch):
    monkeypatch.setitem(RUNGS, TENTH_RUNG.name, TENTH_RUNG)
    state = BEARING.equilibrium(LOAD, 100.0, Film(OIL, rung="tenth"))
    assert state.eccentricity_ratio == TENTH
    warm = BEARING.equilibrium(LOAD, 100.0, Film(heat=Heat(), rung="tenth"))
    assert warm.eccentricity_ratio == TENTH
    with pytest.raises(InputError, match=r"rung = 'tenth' .* a shell that gives way"):
        BEARING.equilibrium(LOAD, 100.0, Film(OIL, rung="tenth", shell=LocalShell(1e-12)))
    with pytest.raises(InputError, match="not for time"):
        BEARING.orbit(TIME, np.tile(LOAD, (3, 1)), 100.0, Film(OIL, rung="tenth"))


def test_a_fed_groove_is_part_of_the_grid():
    groove = Groove(2.0, arc=0.3, pressure=1e6, restrictor=Capillary(diameter=2e-3, length=0.1))
    assert BEARING.equilibrium(LOAD, 100.0, film_for("grid", supply=Supply((groove,)))).converged
