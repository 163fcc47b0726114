"""Loops of smooth films are compiled without the effects that these have none of."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import Film, Groove, JournalBearing, Lubricant, Supply, Turbulence
from loadflow.journal.cavitation import GasMixture
from loadflow.journal.contact import Contact
from loadflow.journal.line import Line
from loadflow.journal.models import composed_model
from loadflow.journal.models.composed_film import Composed, SmoothFilm
from loadflow.journal.shells import LocalShell
from loadflow.tribology.asperities import AsperityContact

BEARING = JournalBearing(diameter=1.2, width=0.9, relative_clearance=1e-3)
FILM = Film(
    lubricant=Lubricant(0.05), edge_pressure=1.5e5, cavitation=GasMixture(5e4), grid=(60, 20),
    inlet=None, rung="reduced", grading="uniform",
)  # fmt: skip
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)
EFFECTS = {
    "asperities": {"contact": ROUGH},
    "turbulence": {"turbulence": Turbulence()},
    "supply": {"supply": Supply((Groove(1.57, arc=0.3, length=0.4, pressure=3e5),))},
}
TILT = np.array([[6e-5, 3e-5]])


def kind_of(film):
    return type(composed_model.build(BEARING, film, np.array([2.0]), Line(tilt=TILT)).film)


def test_films_of_smooth_surfaces_without_turbulence_and_supply_are_smooth():
    assert kind_of(FILM) is SmoothFilm
    assert kind_of(replace(FILM, shell=LocalShell(3e-12))) is SmoothFilm


@pytest.mark.parametrize("effect", EFFECTS)
def test_films_with_an_effect_have_the_loops_of_all(effect):
    assert kind_of(replace(FILM, **EFFECTS[effect])) is Composed


@pytest.mark.parametrize("shell", [None, LocalShell(3e-12)])
def test_loops_of_smooth_films_answer_as_those_of_all_effects(shell, monkeypatch):
    film, time = replace(FILM, shell=shell), np.linspace(0.0, 0.5, 20)
    force = np.array([5e4, -4e5]) * (1.0 + 0.3 * np.sin(6.0 * time))[:, None]
    speed, tilt = np.full(20, 2.0), np.repeat(TILT, 20, axis=0)

    def answers():
        rest = BEARING.equilibrium(force[:1], speed[:1], film, tilt=TILT)
        path = BEARING.orbit(time, force, speed, film, tilt=tilt)
        fields = ("eccentricity", "maximum_pressure", "friction_power", "stiffness", "side_flow")
        return [np.asarray(getattr(rest, name)) for name in fields] + [
            path[name].values for name in ("eccentricity", "maximum_pressure", "friction_power")
        ]

    ours = answers()
    monkeypatch.setattr(composed_model, "SmoothFilm", Composed)
    for one, other in zip(ours, answers()):
        np.testing.assert_allclose(one, other, rtol=1e-11)
