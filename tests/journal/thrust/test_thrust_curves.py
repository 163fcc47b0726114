"""Films of thrust collars by interpolation in a table, beside those that are solved one by one."""

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    DoubleThrustBearing,
    Film,
    GasMixture,
    Guembel,
    Lubricant,
    Pivot,
    Step,
    ThrustBearing,
)
from loadflow.journal.thrust.curves import CollarCurves

LANDS = ThrustBearing(10, 0.75, 1.05, pad_angle=0.56, taper=6e-5)
STEPPED = ThrustBearing(10, 0.75, 1.05, pad_angle=0.56, profile=Step(6e-5))
TILTING = ThrustBearing(10, 0.75, 1.05, pad_angle=0.56, pivot=Pivot(0.6))
FORCES, SPEEDS = np.array([8e5, -5e5, 1e4, 1.4e6]), np.array([1.2, 0.7, 1.0, 1.27])


def film_of(law=None):
    law = law or Guembel(cavitation_pressure=1e5)
    return Film(Lubricant(0.2), law, inlet=None, grid=(20, 10), edge_pressure=1e5)


def exact(collar, film):
    found = [collar.equilibrium(f, w, film) for f, w in zip(FORCES, SPEEDS)]
    names = (
        "minimum_film", "maximum_pressure", "friction_torque", "friction_power", "side_flow",
    )  # fmt: skip
    return {name: np.array([getattr(one, name) for one in found]) for name in names}


@pytest.mark.parametrize(
    ("front", "back", "law"),
    [
        (LANDS, LANDS, None),
        (STEPPED, LANDS, None),
        (TILTING, TILTING, None),
        (LANDS, LANDS, GasMixture(0.05e6)),  # its film does not scale with the speed
    ],
    ids=["lands", "unlike rows", "tilting pads", "gas mixture"],
)
def test_a_curve_gives_the_films_of_the_grid(front, back, law):
    collar, film = DoubleThrustBearing(front, back, play=4e-4), film_of(law)
    found = CollarCurves(collar, film, thinnest=2e-6).equilibrium(FORCES, SPEEDS)
    assert found.converged.all()
    assert not found.touching.any()
    assert found.residual.max() < 1e-9
    assert found.interpolation_error < 0.01
    for name, values in exact(collar, film).items():
        np.testing.assert_allclose(getattr(found, name), values, rtol=2e-3, err_msg=name)


def test_the_stated_error_of_interpolation_is_no_less_than_the_true_one():
    collar, film = DoubleThrustBearing(LANDS, LANDS, play=4e-4), film_of(GasMixture(0.05e6))
    found = CollarCurves(collar, film, thinnest=2e-6).equilibrium(FORCES, SPEEDS)
    for name, values in exact(collar, film).items():
        assert np.abs(getattr(found, name) / values - 1).max() <= found.interpolation_error


def test_answers_do_not_depend_on_their_company():
    curves = CollarCurves(DoubleThrustBearing(LANDS, LANDS, play=4e-4), film_of(), 2e-6)
    together = curves.equilibrium(FORCES, SPEEDS)
    for k in range(FORCES.size):
        alone = curves.equilibrium(FORCES[k : k + 1], SPEEDS[k : k + 1])
        assert alone.minimum_film[0] == together.minimum_film[k]


def test_what_no_film_of_the_table_carries_touches():
    curves = CollarCurves(DoubleThrustBearing(LANDS, LANDS, play=4e-4), film_of(), 2e-6)
    found = curves.equilibrium([1e12, 8e5, 8e5], [1.2, 0.0, 1.2])
    assert found.touching.tolist() == [True, True, False]
    assert np.isnan(found.minimum_film).tolist() == [True, True, False]


def test_a_runner_against_its_lands_has_no_curve():
    curves = CollarCurves(DoubleThrustBearing(LANDS, LANDS, play=4e-4), film_of(), 2e-6)
    with pytest.raises(SolverError, match="diverges in this sense of rotation"):
        curves.equilibrium([8e5], [-1.2])


def test_pads_on_springs_and_a_table_thicker_than_the_play_are_refused():
    soft = ThrustBearing(10, 0.75, 1.05, pad_angle=0.56, pivot=Pivot(stiffness=1e9))
    with pytest.raises(InputError, match="front: pads on supports that give way"):
        CollarCurves(DoubleThrustBearing(soft, LANDS, play=4e-4), film_of(), 2e-6)
    with pytest.raises(InputError, match="half the play"):
        CollarCurves(DoubleThrustBearing(LANDS, LANDS, play=4e-4), film_of(), 3e-4)


def test_a_rotor_that_nearly_stands_touches_without_a_table(monkeypatch):
    """Five decades of speed, 1 film for each of 8 in a decade in place of 65 for both rows."""
    asked, solve = [], ThrustBearing.pressure
    monkeypatch.setattr(
        ThrustBearing, "pressure", lambda *given: asked.append(given) or solve(*given)
    )
    collar = DoubleThrustBearing(LANDS, LANDS, play=4e-4)
    curves = CollarCurves(collar, film_of(GasMixture(0.05e6)), thinnest=2.5e-6)
    speeds = np.geomspace(1e-8, 1e-3, 60)
    slow = curves.equilibrium(np.full(60, 2e6), speeds)
    assert slow.touching.all()
    assert not slow.converged.any()
    assert len(asked) <= 42
    both = curves.equilibrium([2e6, 2e6], [1e-4, 1.2])
    assert both.touching.tolist() == [True, False]
    alone = curves.equilibrium([2e6], [1.2])
    assert both.minimum_film[1] == alone.minimum_film[0]
