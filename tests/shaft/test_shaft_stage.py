"""Suspensions in a scene, and the lean of an elastic shaft on its way into the film."""

import numpy as np
import pytest
from synthetic import case as synthetic_case

from loadflow.errors import InputError
from loadflow.scene.scene import make_scene
from loadflow.shaft import Beam, ShaftSection, TwoPoint
from loadflow.shaft import bearing_loads as suspended
from loadflow.stages.films.of_bearing import equilibria
from loadflow.stages.films.support import film_model
from loadflow.stages.journal import film
from loadflow.stages.reduction import reduced_loads
from loadflow.stages.shaft import bearing_loads

STEEL = {"sections": [{"outer_diameter": 2.0, "inner_diameter": 1.6}]}


def scene_of(**sections):
    return make_scene({"name": "shaft", "results": ["journal.film"]} | sections)


class _Case:
    name, file = "dlc1.1_v12_s1", ""


def stages(scene):
    """Loads, shaft, reduction and film of one small case."""
    found = {"loads": synthetic_case(12.0, 1, steps=120)}
    found["shaft"] = bearing_loads(scene, _Case, found)
    found["reduction"] = reduced_loads(scene, _Case, found)
    return found | {"journal": film(scene, _Case, found)}


def test_the_lean_of_the_shaft_reaches_the_film():
    """The film of a shaft that leans is thinner at one rim; both bearings know how it lies."""
    journal = {"tilt": True, "grid": [36, 8]}
    size = {"size": 0.05}
    bent = stages(scene_of(shaft={"two_point": {"beam": STEEL}}, journal=journal, reduction=size))
    straight = stages(scene_of(shaft={"two_point": {}}, journal=journal, reduction=size))
    for bearing in ("N", "N2"):
        ours, theirs = (s["journal"][bearing].to_dataset() for s in (bent, straight))
        reduced = bent["reduction"][bearing]
        given = reduced["tilt"].values
        assert abs(given[:, 1:]).max() > 1e-5
        # the film's axes: down, then left
        np.testing.assert_allclose(ours["tilt"], np.stack([-given[:, 2], given[:, 1]], axis=1))
        np.testing.assert_allclose(theirs["tilt"], 0.0, atol=1e-12)
        assert bool(ours["converged"].all())
        assert (ours["minimum_film"] < theirs["minimum_film"]).all()
        # a determinate suspension: the same loads
        np.testing.assert_allclose(
            bent["shaft"]["force"].sel(bearing=bearing),
            straight["shaft"]["force"].sel(bearing=bearing),
            rtol=1e-5,
            atol=1.0,
        )


def test_a_rigid_suspension_beside_a_beam_stays_as_it_is():
    scene = scene_of(shaft={"two_point": {"beam": {}}, "moment": {}})
    series = {"loads": synthetic_case(12.0, 1, steps=50)}
    found = bearing_loads(scene, _Case, series)
    assert found["bearing"].values.tolist() == ["N", "N2", "M"]
    assert bool(found["tilt"].sel(bearing=["N", "N2"]).notnull().all())
    assert bool(found["tilt"].sel(bearing="M").isnull().all())
    reduced = reduced_loads(scene, _Case, series | {"shaft": found})
    assert "tilt" in reduced["N"]
    assert "tilt" not in reduced["M"]


@pytest.mark.parametrize(
    ("concept", "bearings"),
    [
        ("three_point", ("N", "G")),
        ("integrated", ("N", "N2")),
        ("direct_drive", ("N", "N2")),
        ("moment", ("M",)),
    ],
)
def test_every_concept_is_an_option_of_a_scene(concept, bearings):
    scene = scene_of(shaft={concept: {"shaft_mass": 2e4}}, results=["loads.statistics"])
    found = bearing_loads(scene, _Case, {"loads": synthetic_case(12.0, 1, steps=20)})
    assert tuple(found["bearing"].values) == bearings == scene.shaft.bearings


@pytest.mark.parametrize(
    ("sections", "message"),
    [
        ({"shaft": {"two_point": {}, "three_point": {}}}, "two_point and three_point all have"),
        ({"shaft": {"two_point": {"beam": {"supports": [{}]}}}}, "1 are given, the shaft has 2"),
        (
            {"shaft": {"two_point": {"beam": {"sections": [{"outer_diameter": -1.0}]}}}},
            "outer_diameter",
        ),
    ],
)
def test_mistakes_are_named(sections, message):
    with pytest.raises(InputError, match=message):
        scene_of(**sections)


def test_the_shaft_rests_on_the_films_of_its_bearings():
    """Determinate loads; the shaft lies where both films are, and leans from one to the other."""
    journal = scene_of(journal={"grid": [36, 8]}).journal
    concept = TwoPoint(beam=Beam((ShaftSection(2.0, 1.6),), youngs_modulus=1e16))
    speed = np.array([1.2, 1.3])
    film_of = film_model(journal, speed)
    force = np.array([[0.0, 0.0], [1e5, -5e4], [-1e6, -1.1e6]])
    moment = np.array([[0.0, 0.0], [5e5, 8e5], [3e5, 0.0]])
    found = suspended(concept, force, moment, models={"N": film_of, "N2": film_of})
    gaps = []
    for bearing in ("N", "N2"):
        one = found.sel(bearing=bearing)
        down_left = equilibria(journal, one["force"].values.T, speed).eccentricity
        gaps.append(np.stack([down_left[:, 1], -down_left[:, 0]]))
        np.testing.assert_allclose(one["displacement"].values[1:], gaps[-1], rtol=1e-6, atol=1e-12)
    turned = (gaps[1] - gaps[0]) / concept.span
    np.testing.assert_allclose(found["tilt"].values[0, 2], turned[0], rtol=1e-3)
    np.testing.assert_allclose(found["tilt"].values[0, 1], -turned[1], rtol=1e-3)
    assert found.attrs["converged"] == 1
