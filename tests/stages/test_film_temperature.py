"""The one temperature of a film in motion."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import FilmHeat, Heat
from loadflow.scene import Journal
from loadflow.stages.films.temperature import mean_temperature

WARM = Heat(oil="iso-vg-220", inlet_temperature=313.15)
SPEED = np.linspace(1.0, 1.3, 80)
FORCE = np.column_stack([np.linspace(2e5, 8e5, 80), np.full(80, 5e4)])


def test_films_are_as_warm_for_a_closed_path_or_with_their_shaft_as_on_a_path_alone():
    """To the last digit: a path whose temperature is sought elsewhere has another one."""
    journal = Journal(rung="reduced", grid=(36, 8), heat=WARM)
    warm = mean_temperature(journal, FORCE, SPEED)
    time = np.linspace(0.0, 2.0, 80)
    path = journal.geometry.orbit(time, FORCE, SPEED, journal.film_model)
    assert path["temperature"].values.tolist() == [warm] * 80
    assert 313.2 < warm < 340.0


def test_a_film_without_heat_has_no_temperature_and_one_with_heat_over_its_area_not_one():
    assert mean_temperature(Journal(rung="reduced"), FORCE, SPEED) is None
    over_area = Journal(rung="reduced", heat=FilmHeat(oil="iso-vg-220"))
    with pytest.raises(InputError, match=r"journal\.heat over the area .* no single temperature"):
        mean_temperature(over_area, FORCE, SPEED)
