"""Shells that turn with the shaft against their seats, in motion with both films."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import xarray as xr

from loadflow.errors import InputError
from loadflow.journal.models.composed import shared_sides
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import Scene, make_scene
from loadflow.scene.shaft_place import move_together
from loadflow.scene.unused import unused_keys
from loadflow.shaft.reactions import shaft_in_films
from loadflow.stages import journal, shaft
from loadflow.stages.effects.seats import SEATS
from loadflow.stages.frames import from_film, to_film
from loadflow.stages.shaft_in_films import films_together
from loadflow.stages.wear import touching_cycle
from loadflow.turbines import load_turbine

TILT = load_turbine("nrel-5mw").rotor.tilt
STEPS, STEP = 300, 0.05
FELT = {"stiffness": "journal", "takes_moment": True}
FILM = {"tilt": True, "motion": "transient", "rung": "reduced"}


def elastic(stiffness: float) -> dict:
    return {"kind": "elastic", "stiffness": stiffness}


def spherical(friction: float) -> dict:
    return {"kind": "spherical", "friction": friction, "radius": 1.4}


def scene_of(seat: dict | None, **more) -> Scene:
    """Two journal bearings with more clearance than a shaft fills; fixed shells without a seat."""
    own = {} if seat is None else {"self_aligning": True, "seat": seat}
    beam = {"sections": [{"outer_diameter": 2.0, "inner_diameter": 1.0}], "supports": [FELT, FELT]}
    geometry = {"diameter": 2.0, "width": 1.0, "relative_clearance": 1e-3}
    film = FILM | {"geometry": geometry, "grid": (40, 20), "lubricant": {"viscosity": 0.3}} | own
    return make_scene(
        {
            "name": "seats",
            "results": ["journal.film"],
            "shaft": {"two_point": {"span": 5.0, "beam": beam}},
            "journal": film,
        }
        | more
    )


def test_a_seat_that_has_no_load_at_all_gives_way_by_a_finite_moment():
    bearing = scene_of(spherical(0.1)).journal.at("N").geometry
    assert 0.0 < shared_sides.give_of_seat(bearing, np.inf, np.zeros(3)) < np.inf


@pytest.fixture(scope="module")
def loads() -> xr.Dataset:
    """A mean, and moments that swing at the passing of the blades and three times slower."""
    time = STEP * np.arange(STEPS)
    phase, lasting = 1.2 * time, np.ones(STEPS)
    force = np.stack([5e5 * lasting, 1e5 * lasting, -1.1e6 * lasting])
    swing = 0.3 * np.sin(3 * phase) + 0.4 * np.sin(phase)
    moment = np.stack([4e6 * lasting, 4e6 * (0.3 + swing), 2e6 * np.cos(3 * phase)])
    return xr.Dataset(
        {
            "speed": ("time", 1.2 * lasting),
            "hub_force": (("axis", "time"), force),
            "hub_moment": (("axis", "time"), moment),
        },
        {"time": time, "axis": ["x", "y", "z"]},
    )


@dataclass(frozen=True)
class Moved:
    """Of both films, (n, 2, 2): tilt in them, moment on them, turn of the shells; load (n, 2)."""

    tilt: np.ndarray
    moment: np.ndarray
    turn: np.ndarray
    load: np.ndarray
    film: np.ndarray


def moved(seat: dict | None, loads: xr.Dataset) -> Moved:
    """The turn is that of the shaft, by its own equations, less the tilt in the film."""
    concept = scene_of(seat).shaft.two_point
    path = films_together(scene_of(seat), concept, loads, TILT).path
    vectors = (loads[name].values for name in ("hub_force", "hub_moment"))
    lies = shaft_in_films(concept, *vectors, tilt=TILT)

    def cube(values: np.ndarray) -> np.ndarray:
        return from_film(values)[..., 1:].reshape(len(values), 4).T

    def film(values: np.ndarray) -> np.ndarray:
        y, z = values.reshape(2, 2, -1).transpose(1, 2, 0)
        return to_film(np.stack([0.0 * y, y, z], axis=-1))

    slope = film(lies.tilt(cube(path.position), cube(path.moment)))
    load = np.hypot(*np.moveaxis(film(lies.force(np.zeros((4, STEPS)))), -1, 0))
    least = np.stack([one["minimum_film"].values for one in path.paths], axis=1)
    return Moved(path.tilt, path.moment, slope - path.tilt, load, least)


def size(vectors: np.ndarray) -> np.ndarray:
    return np.hypot(vectors[..., 0], vectors[..., 1])


def test_an_elastic_seat_turns_by_the_moment_of_its_film_over_its_stiffness(loads):
    found = moved(elastic(1e8), loads)
    most = np.abs(found.moment).max()
    assert most > 1e3
    np.testing.assert_allclose(found.moment[1:], 1e8 * found.turn[1:], atol=1e-4 * most)


def test_a_seat_that_slides_holds_its_friction_and_none_else_turns(loads):
    friction = 0.01
    found = moved(spherical(friction), loads)
    most, moment = friction * 1.4 * found.load, size(found.moment)
    assert np.all(moment <= 1.01 * most)
    slides = moment > 0.9999 * most
    assert 0.1 < slides.mean() < 0.9
    steps = np.diff(found.turn, axis=0)
    sticks = (moment < 0.9 * most)[1:] & (moment < 0.9 * most)[:-1]
    assert sticks.any()
    # what it gives way by before it slides is 1e-3 of the clearance at its end: 2e-6 rad
    assert size(steps)[sticks].max() < 1e-6 < 0.2 * size(steps).max()
    # it slides along the moment that its film turns it with
    sliding = slides[1:] & (size(steps) > 2e-6)
    along = (found.moment[1:] * steps).sum(axis=-1) / (moment[1:] * size(steps) + 1e-300)
    assert along[sliding].min() > 0.98


def test_seats_lie_between_a_shell_that_is_fixed_and_one_that_turns_freely(loads):
    fixed, stiff, soft, easy = (
        moved(seat, loads) for seat in (None, elastic(1e14), elastic(1e3), spherical(1e-6))
    )
    np.testing.assert_allclose(np.abs(fixed.turn), 0.0, atol=1e-9)
    apart = np.abs(stiff.tilt - fixed.tilt)[1:].max()
    assert apart < 5e-3 * np.abs(fixed.tilt).max()
    rms = np.sqrt((fixed.moment**2).mean())
    for free in (soft, easy):
        assert np.sqrt((free.moment**2).mean()) < 1e-3 * rms
    assert np.quantile(soft.film, 0.01) > 1.2 * np.quantile(fixed.film, 0.01)


def test_seats_that_stick_keep_the_turn_that_they_have(loads):
    found = moved(spherical(1.0), loads)
    assert size(found.turn - found.turn[0]).max() < 5e-6 < 0.05 * size(found.tilt).max()


@pytest.mark.parametrize("times", [3, 6])
def test_shells_begin_aligned_where_heavy_loads_begin_nearer_the_middle(loads, times):
    steady = loads.isel(time=slice(60)).copy()
    steady["hub_force"] = times * steady["hub_force"]
    steady["hub_moment"] = steady["hub_moment"].isel(time=[0] * 60).assign_coords(steady.coords)
    scene = scene_of(spherical(1.0))
    path = films_together(scene, scene.shaft.two_point, steady, TILT).path
    assert size(path.tilt).max() < 1.2e-4


@pytest.mark.parametrize("tilt", [True, False])
def test_seats_that_are_followed_are_no_unused_keys(tilt):
    scene = scene_of(spherical(0.1), accuracy="given")
    films = scene.journal.model_copy(update={"tilt": tilt})
    told = unused_keys(scene.model_copy(update={"journal": films}))
    assert not {"journal.tilt", "journal.self_aligning", "journal.seat"} & {*told}


def test_whether_all_shells_are_followed_does_not_hang_on_the_order_of_the_bearings():
    film = FILM | {"kind": "journal", "self_aligning": True, "seat": spherical(0.1)}
    film |= {"geometry": {"diameter": 2.0, "width": 1.0, "relative_clearance": 1e-3}}
    beam = {"sections": [{"outer_diameter": 2.0}], "supports": [FELT, FELT]}
    told = {"name": "seats", "results": ["journal.film"], "shaft": {"two_point": {"beam": beam}}}
    for order in (("N", "N2"), ("N2", "N")):
        assert SEATS.is_on(make_scene(told | {"bearings": dict.fromkeys(order, film)}))


def test_films_on_seats_tell_their_tilt_and_are_those_of_the_path(loads):
    scene = scene_of(spherical(0.02))
    given = {"loads": loads, "shaft": shaft.bearing_loads(scene, None, {"loads": loads})}
    assert given["shaft"].attrs["converged"] == 1
    case = type("Case", (), {"dlc": "1.1"})()
    films = journal.orbit(scene, case, given)
    path = films_together(scene, scene.shaft.two_point, loads, TILT).path
    for k, name in enumerate(("N", "N2")):
        np.testing.assert_allclose(films[name]["tilt"].values, path.tilt[:, k])


def test_bores_on_seats_are_worn_by_what_tilt_the_seat_leaves(loads):
    scene, name = scene_of(spherical(0.02)), "N"
    given = {"loads": loads, "shaft": shaft.bearing_loads(scene, None, {"loads": loads})}
    case = type("Case", (), {"dlc": "4.1"})()
    film = journal.orbit(scene, case, given)[name].to_dataset()
    rubs = (film["time"] > 5.0) & (film["time"] < 8.0)
    touching = film.assign(contact_share=0.5 * rubs)
    asked = scene, scene.journal.at(name), touching, loads, given["shaft"].sel(bearing=name)
    cycle = touching_cycle(*asked)
    for k, column in enumerate(film["tilt"].values.T):
        np.testing.assert_allclose(
            cycle.tilt[:, k], np.interp(cycle.time, film["time"].values, column)
        )
    assert cycle.bend.shape == cycle.tilt.shape
    aligned = touching_cycle(*asked[:2], touching.drop_vars("tilt"), *asked[3:])
    assert aligned.tilt is aligned.bend is None


def test_a_shaft_that_stands_at_first_turns_freely_on_rigid_bearings(loads):
    still = loads.assign(speed=loads["speed"] * (loads["time"] > 1.0))
    found = shaft.bearing_loads(scene_of(spherical(0.02)), None, {"loads": still})
    assert not found["converged"].values.any()
    assert not found["moment"].sel(bearing=["N", "N2"], axis=["y", "z"]).values.any()


def test_what_a_seat_holds_is_followed_in_motion_alone():
    film = {"self_aligning": True, "seat": spherical(0.1) | {"radius": 1.9}, "tilt": True}
    with pytest.raises(InputError, match="what a seat holds is followed in motion alone"):
        scene_of(None, journal=film)
    scene_of(None, journal=film | FILM)


@pytest.mark.parametrize(
    ("second", "support"),
    [
        ({}, {"stiffness": "journal"}),
        ({"seat": None}, {"stiffness": "journal"}),
        ({}, {"radial": 1e9}),
    ],
)
def test_a_seat_does_not_hold_a_shaft_that_is_not_followed_in_two_films(second, support):
    film = FILM | {"kind": "journal", "self_aligning": True, "seat": spherical(0.1)}
    film |= {"geometry": {"diameter": 2.0, "width": 1.0, "relative_clearance": 1e-3}}
    own = {key: value for key, value in (film | second).items() if value is not None}
    beam = {"sections": [{"outer_diameter": 2.0}], "supports": [FELT, support]}
    told = {"name": "seats", "results": ["journal.film"], "shaft": {"two_point": {"beam": beam}}}
    with pytest.raises(InputError, match=r"support of bearing N .*followed where a shaft lies in"):
        make_scene(told | {"bearings": {"N": film, "N2": own}})


def test_a_plan_follows_shells_in_their_seats_where_the_accuracy_asks_for_it():
    beam = {"sections": [{"outer_diameter": 3.0, "inner_diameter": 1.5}]}
    film = {"self_aligning": True, "seat": {"kind": "spherical", "friction": 0.1, "radius": 1.9}}
    film |= {"geometry": {"diameter": 3.0, "width": 2.25, "relative_clearance": 1e-3}}
    more = {"shaft": {"two_point": {"beam": beam}}, "loads": {"wind_speeds": [12.0], "seeds": 1}}
    plan = make_plan(scene_of(None, journal=film, **more))
    assert SEATS.is_on(plan.scene)
    assert move_together(plan.scene.shaft, plan.scene.journal, plan.scene.shaft.two_point)
    assert plan.accurate
    held = make_plan(scene_of(None, journal=film | {"motion": "quasi-static"}, **more))
    assert not SEATS.is_on(held.scene)
    assert held.errors["journal.film"]["minimum film"] > 1.0
