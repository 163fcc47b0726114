"""What seats leave of the shaft's slope in bearings that align themselves is counted."""

from pathlib import Path

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import ElasticSeat, JournalBearing, Lubricant, SphericalSeat
from loadflow.planning.plan import make_plan
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.scene.shaft_place import films_of
from loadflow.stages.effects import seats
from loadflow.stages.effects.clearances import slopes
from loadflow.stages.effects.situation import FEW, situation

BORE = {"diameter": 3.0, "width": 2.25, "relative_clearance": 1e-3}
LANDS = {"pads": 18, "inner_radius": 1.6, "outer_radius": 1.9, "pad_angle": 0.3, "taper": 8e-5}
STICKS = {"kind": "spherical", "friction": 1.0, "radius": 50.0}
SLIDES = {"kind": "spherical", "friction": 0.02, "radius": 1.9}


def scene_of(seat=None, pads=None, winds=(12.0,), **more):
    """Two journal bearings at rest and a collar, which align themselves on a shaft that bends."""
    own = {"motion": "quasi-static"} | ({} if seat is None else {"seat": seat})
    collar = {} if pads is None else {"seat": pads}
    film = {"kind": "journal", "self_aligning": True, "geometry": BORE} | own
    thrust = {"kind": "thrust", "self_aligning": True, "play": 6e-4, "geometry": LANDS} | collar
    sections = [{"outer_diameter": 3.0, "inner_diameter": 1.5}]
    return make_scene(
        {
            "name": "seats",
            "results": ["journal.film", "thrust.film"],
            "loads": {"wind_speeds": list(winds), "seeds": 1, "duration": 60.0},
            "shaft": {"two_point": {"beam": {"sections": sections}}},
            "bearings": {"N": film, "N2": [film, thrust]},
        }
        | more
    )


def estimated(scene):
    return situation(scene, list_cases(scene))


def sizes(seat, effect=seats.SEATS):
    return effect.indicator(estimated(scene_of(seat, seat)))


def test_a_seat_passes_the_moment_of_its_friction_or_of_its_stiffness():
    load, slope = np.array([1e6, -2e6]), np.array([1e-4, 3e-4])
    slides, bends = SphericalSeat(friction=0.1, radius=2.0), ElasticSeat(stiffness=5e8)
    np.testing.assert_allclose(slides.largest_moment(load, slope), [2e5, 4e5])
    np.testing.assert_allclose(bends.largest_moment(load, slope), [5e4, 1.5e5])


@pytest.mark.parametrize("arm", ["about the load", "across the load"])
def test_a_cosine_of_pressure_over_half_a_sphere_has_the_friction_that_is_taken(arm):
    polar, around = ((np.arange(800) + 0.5) / 800 * end for end in (0.5 * np.pi, 2.0 * np.pi))
    polar, around = np.meshgrid(polar, around, indexing="ij")
    pressed = np.cos(polar) * np.sin(polar)
    away = np.sin(polar)
    if arm == "across the load":
        away = np.sqrt(1.0 - (np.sin(polar) * np.cos(around)) ** 2)
    found = (pressed * away).sum() / (pressed * np.cos(polar)).sum()
    taken = float(SphericalSeat(friction=1.0, radius=1.0).largest_moment(1.0, 0.0))
    assert found / taken == pytest.approx(1.0 if arm == "about the load" else 4 / np.pi, rel=1e-4)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"seat": SLIDES | {"friction": 0.0}}, "friction"),
        ({"seat": SLIDES | {"friction": 1.5}}, "friction"),
        ({"seat": SLIDES | {"radius": 1.4}}, r"seat.radius = 1.4: must be > 1.5 m"),
        ({"seat": {"kind": "elastic", "stiffness": -1.0}}, "stiffness"),
        ({"seat": {"kind": "elastic", "friction": 0.1}}, "friction"),
        ({"seat": {"kind": "loose"}}, "kind must be one of spherical, elastic"),
        ({"seat": SLIDES, "self_aligning": False}, "seat: only a bearing with self_aligning"),
    ],
)
def test_a_seat_that_cannot_be_is_refused_by_its_key(change, said):
    film = {"kind": "journal", "self_aligning": True, "geometry": BORE} | change
    with pytest.raises(InputError, match=said):
        scene_of(bearings={"N": film, "N2": film}, results=["journal.film"])


def test_a_collar_without_alignment_has_no_seat_and_no_seat_has_a_tolerance():
    collar = {"kind": "thrust", "play": 6e-4, "geometry": LANDS, "seat": SLIDES}
    with pytest.raises(InputError, match="seat: only a bearing with self_aligning"):
        scene_of(bearings={"N2": collar}, results=["thrust.film"])
    with pytest.raises(InputError, match=r"seat\.friction = 0\.01: no film has its seat"):
        scene_of(SLIDES, tolerances={"N": {"seat.friction": 0.01}})


@pytest.mark.filterwarnings("ignore:the cells do not resolve")
@pytest.mark.parametrize("ratio", [0.4, 1.0])
@pytest.mark.parametrize("eccentricity", [0.5, 0.93])
@pytest.mark.parametrize("moment", [0.02, 0.08])
def test_films_under_the_moment_of_a_seat_are_as_thin_as_indicated(ratio, eccentricity, moment):
    """Solved at rest, tilted in the plane of the load and across it."""
    bearing = JournalBearing(diameter=3.0, width=3.0 * ratio, relative_clearance=1e-3)
    film = {"lubricant": Lubricant(viscosity=0.05), "edge_pressure": 0.5e6, "grid": (60, 20)}
    place = (eccentricity * bearing.clearance, 0.0)
    force = float(np.hypot(*np.ravel(bearing.pressure(place, 1.2, **film).force)[:2]))
    aligned = bearing.equilibrium((force, 0.0), 1.2, **film)
    along = np.asarray(aligned.eccentricity) / np.hypot(*aligned.eccentricity)
    about = moment * force * bearing.width * np.array([[-along[1], along[0]], along])
    tilted = bearing.equilibrium(
        np.tile([force, 0.0], (2, 1)), 1.2, moment=about, strict=False, **film
    )
    # thinner ones are those of surfaces that touch
    left = np.maximum(tilted.minimum_film[tilted.converged], scene_of().journal.contact_film)
    found = float(aligned.minimum_film) / left - 1.0
    assert found.size  # where one has no answer, its ends touch
    indicated = np.expm1(18.0 * moment)
    assert np.all((found < 10.0 * indicated) & (indicated < seats.SEATS.smaller * found))


def test_films_of_pads_on_a_slope_and_their_moment_are_as_indicated():
    collar = scene_of().thrust.collars["N2"].on_cells(FEW)
    thrust, outer = 8e5, LANDS["outer_radius"]
    load, none = np.array([0.0, 0.0, thrust]), np.zeros(3)
    aligned = collar.solve(load, none, 1.2)
    for x in (0.1, 0.3, 0.6, 1.0):
        slope = x * aligned.minimum_film / outer
        tilted = collar.solve(load, none, 1.2, np.array([slope, 0.0]))
        thinner = aligned.minimum_film / tilted.minimum_film - 1.0
        assert x * (1.0 + 0.15 * x) == pytest.approx(thinner, rel=0.1)
        passed = tilted.restoring_moment / (thrust * outer)
        assert passed / (1.0 - 0.55 * passed) == pytest.approx(x, rel=0.25)


def test_the_slope_in_a_seat_is_that_in_the_clearances_and_that_of_the_bent_shaft():
    scene = scene_of(SLIDES, winds=(8.0, 12.0))
    at = estimated(scene)
    concept = scene.shaft.two_point
    slope, places = slopes(at, concept, films_of(concept, scene.journal))
    for name in ("N", "N2"):
        bent = at.bearings[name].slope
        assert np.all(bent > 0)
        np.testing.assert_allclose(
            seats.shaft_slopes(at, name), np.linalg.norm(slope, axis=-1) + bent
        )
        # in the film as it lies at the same time: one bearing is pushed as the other is pulled
        np.testing.assert_array_equal(seats.place_on_seat(at, name).load, places[name].load)


@pytest.mark.parametrize("effect", [seats.SEATS, seats.OF_COLLARS])
def test_a_seat_leaves_no_more_than_one_that_sticks_and_the_less_the_easier_it_turns(effect):
    stuck, rigid = sizes(STICKS, effect), sizes({"kind": "elastic", "stiffness": 1e14}, effect)
    assert stuck == rigid
    assert stuck["minimum film"] > 0.5
    friction = [
        sizes(SLIDES | {"friction": mu}, effect)["minimum film"] for mu in (1e-4, 1e-3, 1e-2)
    ]
    stiffness = [
        sizes({"kind": "elastic", "stiffness": k}, effect)["minimum film"] for k in (1e5, 1e6, 1e7)
    ]
    for found in (friction, stiffness):
        assert 0.0 < found[0] < found[1] < found[2] < stuck["minimum film"]
        assert found[0] < 0.02


def test_a_plan_counts_described_seats_and_tells_which_are_not_known():
    silent, eased, stiff = (
        make_plan(scene_of(*both)) for both in ((None, None), (SLIDES, None), (STICKS, STICKS))
    )
    assert {key for key in silent.left_out if "seats" in key} == {
        "journal: seats of N, N2", "thrust: seats of N2",
    }  # fmt: skip
    assert {key for key in eased.left_out if "seats" in key} == {
        seats.SEATS.name, "thrust: seats of N2",
    }  # fmt: skip
    for result, effect in (("journal.film", seats.SEATS), ("thrust.film", seats.OF_COLLARS)):
        added = stiff.errors[result]["minimum film"] - silent.errors[result]["minimum film"]
        assert added == pytest.approx(sizes(STICKS, effect)["minimum film"], rel=0.05)
    assert any("seats of the bearings left out" in said for said in stiff.shortfalls)


def test_a_shaft_that_stands_lies_on_its_shell_whatever_its_seat():
    parked = scene_of(STICKS, loads={"dlc": "6.1", "seeds": 1, "duration": 60.0})
    assert max(seats.SEATS.indicator(estimated(parked)).values()) == 0.0


def test_where_no_bearing_aligns_itself_nothing_is_told_of_seats():
    film = {"kind": "journal", "geometry": BORE}
    plan = make_plan(scene_of(bearings={"N": film, "N2": film}, results=["journal.film"]))
    assert not any("seats" in key for key in plan.left_out)


def test_the_pipelines_tell_that_their_seats_are_not_known():
    from loadflow.scene.scene import read_scene

    main = read_scene(Path(__file__).parents[2] / "pipelines" / "dlc_1_1.toml")
    assert "journal: seats of N, N2" in make_plan(main).left_out
