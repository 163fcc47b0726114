"""A shaft in two journal films: how it lies in them, and both in motion together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from loadflow.errors import InputError, SolverError, ValidityWarning
from loadflow.journal import Control
from loadflow.journal.models.composed.shared_path import SharedPath
from loadflow.scene.scene import Scene, make_scene
from loadflow.scene.shaft_place import move_together
from loadflow.shaft import Beam, BearingSupport, MomentBearing, ShaftSection, TwoPoint, reactions
from loadflow.shaft import bearing_loads as suspended
from loadflow.shaft.reactions import shaft_in_films
from loadflow.stages import journal, shaft
from loadflow.stages import shaft_in_films as shaft_in_films_stage
from loadflow.stages.films.past import AT_REST
from loadflow.stages.films.support import film_model
from loadflow.stages.frames import from_film, to_film
from loadflow.stages.shaft_in_films import films_together, followed_together
from loadflow.studies.candidate.factor import at_place, grown
from loadflow.turbines import load_turbine

STEPS, STEP = 600, 0.05
TILT = load_turbine("nrel-5mw").rotor.tilt


def scene_of(supports: list[dict] | None = None, modulus: float = 2.1e11, **film) -> Scene:
    """Two journal bearings with more clearance than a shaft fills, and a shaft in them."""
    own = {"stiffness": "journal", "takes_moment": True}
    beam = {"sections": [{"outer_diameter": 2.0, "inner_diameter": 1.0}]}
    beam |= {"supports": supports or [own, own], "youngs_modulus": modulus}
    return make_scene(
        {
            "name": "films",
            "results": ["journal.film"],
            "shaft": {"two_point": {"span": 5.0, "beam": beam}},
            "journal": {
                "geometry": {"diameter": 2.0, "width": 1.0, "relative_clearance": 1e-3},
                "tilt": True,
                "motion": "transient",
                "rung": "reduced",
                "grid": (40, 20),
            }
            | ({} if "heat" in film else {"lubricant": {"viscosity": 0.3}})
            | film,
        }
    )


def loads_of(swing: float = 0.3, steps: int = STEPS, step: float = STEP) -> xr.Dataset:
    """Loads of a hub: a mean, and a `swing` at three times the speed of the shaft."""
    time, speed = step * np.arange(steps), np.full(steps, 1.2)
    phase, lasting = 3.0 * 1.2 * time, np.ones(steps)
    force = np.stack([5e5 * lasting, 1e5 * lasting, -1.1e6 * lasting])
    moment = np.stack(
        [4e6 * lasting, 2e6 * (0.3 + swing * np.sin(phase)), 2e6 * swing * np.cos(phase)]
    )
    return xr.Dataset(
        {
            "speed": ("time", speed),
            "hub_force": (("axis", "time"), force),
            "hub_moment": (("axis", "time"), moment),
        },
        {"time": time, "axis": ["x", "y", "z"]},
    )


@pytest.fixture(scope="module")
def moved() -> tuple[Scene, xr.Dataset, xr.Dataset]:
    scene, loads = scene_of(), loads_of()
    return scene, loads, shaft.bearing_loads(scene, None, {"loads": loads})


def test_a_shaft_on_springs_lies_as_its_reactions_say():
    supports = (
        BearingSupport(radial=3e9, takes_moment=True, tilt=2e8, housing_vertical=8e9),
        BearingSupport(radial=2e9, takes_moment=True, tilt=3e8, housing_tilt=9e8),
    )
    concept = TwoPoint(beam=Beam((ShaftSection(1.0, 0.4),), supports))
    rng = np.random.default_rng(1)
    force, moment = rng.normal(size=(3, 5)) * 1e6, rng.normal(size=(3, 5)) * 3e6
    known = suspended(concept, force, moment, tilt=0.08)
    lying = shaft_in_films(concept, force, moment, tilt=0.08)
    reactions, moments = (known[name].values[:, 1:] for name in ("force", "moment"))
    stiff = np.array([3e9, 2e9])[:, None, None]
    at = (reactions / stiff).reshape(4, 5), moments.reshape(4, 5)
    assert np.allclose(lying.force(at[1]), reactions.reshape(4, 5), rtol=1e-11)
    against = (known["tilt"] - known["bore_tilt"]).values[:, 1:].reshape(4, 5)
    assert np.allclose(lying.tilt(*at), against, rtol=1e-10, atol=1e-16)
    motion = lying.motion(*at, np.ones(5, dtype=bool), 0.0)
    for name in ("moment", "displacement", "tilt", "curvature", "bore_tilt"):
        assert np.allclose(getattr(motion, name), known[name].values, rtol=1e-9, atol=1e-15), name


def test_a_shaft_turns_freely_in_its_films_but_in_a_single_one():
    film = BearingSupport(stiffness="journal", takes_moment=True, housing_tilt=1e9)
    two, one = (Beam(supports=(film,) * count).free_in_films() for count in (2, 1))
    assert [part.takes_moment for part in two.supports_of(2)] == [False, False]
    assert one.supports_of(1) == (replace(film, stiffness="given"),)


def test_a_shaft_lies_in_films_of_two_bearings_alone():
    concept = MomentBearing(beam=Beam())
    with pytest.raises(InputError, match="two bearings"):
        shaft_in_films(concept, np.zeros((3, 1)), np.zeros((3, 1)))


def test_a_stiff_shaft_is_tilted_by_where_it_is_in_both_films():
    scene, loads = scene_of(modulus=2.1e14), loads_of()
    found = shaft.bearing_loads(scene, None, {"loads": loads})
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    slope = (both.position[:, 1] - both.position[:, 0]) / 5.0
    tilt = to_film(found["tilt"].transpose("time", "bearing", "axis").values)
    bent = np.abs(tilt[:, 0, ::-1] * [1.0, -1.0] - slope).max()
    assert np.abs(slope).max() > 5e-5
    assert bent < 1e-3 * np.abs(slope).max()


def test_under_more_load_the_clearances_bound_the_tilt_of_a_shaft_in_films(monkeypatch):
    """Followed anew under 1.6 times all loads, it is tilted half as far off."""
    scene, loads = scene_of(lubricant={"viscosity": 0.08}), loads_of(steps=200)
    found = shaft.bearing_loads(scene, None, {"loads": loads})
    hub = ("hub_force", "hub_moment")
    more = loads.assign({name: 1.6 * loads[name] for name in hub})
    monkeypatch.setattr(reactions, "GRAVITY", 1.6 * reactions.GRAVITY)
    anew = shaft.bearing_loads(scene, None, {"loads": more})
    for name in ("N", "N2"):
        own, known = at_place(scene, found, name), anew["tilt"].sel(bearing=name)
        off, whole = (
            float(np.abs(tilt - known).isel(time=slice(50, None)).max())
            for tilt in (grown(own, 1.6)["tilt"], 1.6 * own["tilt"])
        )
        assert off < 0.5 * whole, name


def test_a_stiff_shaft_tilts_in_its_films_as_far_as_the_clearances_let_it():
    scene = scene_of(modulus=2.1e14)
    own = at_place(scene, shaft.bearing_loads(scene, None, {"loads": loads_of()}), "N")
    seen, twice, most = (
        np.linalg.norm(grown(own, load)["tilt"].transpose("time", "axis"), axis=1).max()
        for load in (1.0, 2.0, 1e3)
    )
    assert seen < twice < 1.5 * seen
    assert twice < most < 2 * 1e-3 / 5.0


def test_a_shaft_on_rigid_bearings_has_no_tilt_in_clearances():
    scene = scene_of([{"radial": 3e9}, {"radial": 3e9}], tilt=False)
    found = shaft.bearing_loads(scene, None, {"loads": loads_of(steps=5)})
    assert "clearance_tilt" not in at_place(scene, found, "N")


LEMON = {"kind": "lobes", "count": 2, "preload": 0.5}
PADS = {"kind": "tilting pads", "count": 5, "arc": 1.0, "preload": 0.3, "angle": np.pi / 5}
FED_PADS = PADS | {"groove_pressure": 1e6}


def scene_in(shape: dict, **film) -> Scene:
    """The same shaft in bores of a shape."""
    bore = {"diameter": 2.0, "width": 1.0, "relative_clearance": 1e-3, "shape": shape}
    return scene_of(geometry=bore, **film)


@pytest.mark.parametrize("shape", [{"kind": "cylindrical"}, LEMON, PADS, FED_PADS])
def test_each_film_alone_goes_the_way_that_shaft_and_films_go_together(moved, shape):
    """Under the loads that the shaft stage tells, around the shaft as it tells it."""
    scene, loads, found = moved
    if shape["kind"] != "cylindrical":
        scene = scene_in(shape)
        found = shaft.bearing_loads(scene, None, {"loads": loads})
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    time, speed = loads["time"].values, loads["speed"].values
    for k, name in enumerate(("N", "N2")):
        options = scene.journal.at(name)
        force = to_film(found["force"].sel(bearing=name).T.values.astype(float))
        tilt = to_film(found["tilt"].sel(bearing=name).T.values.astype(float))
        bend = to_film(found["curvature"].sel(bearing=name).T.values.astype(float))
        alone = options.geometry.orbit(
            time, force, speed, options.film_model, tilt=tilt, bend=bend,
            start=both.position[0, k], control=Control(tolerance=1e-8),
        )  # fmt: skip
        late = slice(5 * STEPS // 6, None)  # the past of one has gone from the other by then
        off = np.abs(alone["eccentricity"].values - both.position[:, k])[late].max()
        assert off < 2e-3 * options.geometry.clearance
        ours = both.paths[k]["minimum_film"].values[late]
        assert np.allclose(alone["minimum_film"].values[late], ours, rtol=5e-3)
        if shape["kind"] == PADS["kind"]:
            tilts = (one["pad_tilt"].values[late] for one in (alone, both.paths[k]))
            np.testing.assert_allclose(*tilts, atol=1e-6)


def path_in(scene: Scene, loads: xr.Dataset) -> SharedPath:
    return films_together(scene, scene.shaft.concepts[0], loads, TILT).path


def test_steps_of_a_shaft_on_pads_are_of_second_order_while_pads_come_and_go():
    """Halving the step takes the error of place and tilts to a quarter."""
    scene, paths = scene_in(PADS, lubricant={"viscosity": 0.1}), []
    for parts in (1, 2, 8):
        steps, step = 160 * parts + 1, 0.1 / parts
        paths.append(path_in(scene, loads_of(swing=1.0, steps=steps, step=step)))
    finest = paths.pop()
    lies = np.stack([one["pad_tilt"].values == 0.0 for one in finest.paths])
    assert (lies[:, 1:] != lies[:, :-1]).sum() >= 4  # pads lost their film, and got it back
    errors = []
    for path, every in zip(paths, (8, 4)):
        off = path.position - finest.position[::every]
        errors.append(float(np.sqrt(np.mean(off**2))))
    assert errors[1] < 0.35 * errors[0] < 0.35 * 1e-2 * 1e-3  # of the clearance


def test_a_mirrored_shaft_on_pads_goes_the_mirrored_way():
    """Loads and rotation seen in the vertical plane through the shaft."""
    scene, loads = scene_in(PADS), loads_of(steps=200)
    seen = {"hub_force": [1.0, -1.0, 1.0], "hub_moment": [-1.0, 1.0, -1.0]}
    mirrored = loads.assign(speed=-loads["speed"])
    for name, signs in seen.items():
        mirrored = mirrored.assign({name: loads[name] * xr.DataArray(signs, dims="axis")})
    ours, theirs = path_in(scene, loads), path_in(scene, mirrored)
    clearance = 1e-3
    np.testing.assert_allclose(theirs.position, ours.position * [1, -1], atol=1e-6 * clearance)
    np.testing.assert_allclose(theirs.tilt, ours.tilt * [-1, 1], atol=1e-6 * clearance)
    for one, other in zip(ours.paths, theirs.paths):
        turned = -other["pad_tilt"].values[:, ::-1]  # the last pad is the first one's image
        np.testing.assert_allclose(turned, one["pad_tilt"], atol=1e-5 * clearance)


def test_forces_and_moments_balance(moved):
    _, loads, found = moved
    first, second = found["position"].values
    rigid = suspended(TwoPoint(span=5.0), loads["hub_force"], loads["hub_moment"], tilt=TILT)
    total = rigid["force"].sum("bearing").values
    assert np.allclose(found["force"].sum("bearing").values[1:], total[1:], rtol=1e-5)
    for data in (found, rigid):
        force, own = data["force"].values, data["moment"].values.sum(axis=0)
        about_y = -first * force[0, 2] - second * force[1, 2] + own[1]
        about_z = first * force[0, 1] + second * force[1, 1] + own[2]
        if data is found:
            ours = about_y, about_z
    assert np.abs(found["moment"].values[:, 1:]).max() > 1e4
    assert np.allclose(ours, (about_y, about_z), atol=1e-5 * np.abs(about_y).max())


@pytest.mark.parametrize("shape", [{"kind": "cylindrical"}, PADS])
def test_under_a_load_that_stays_the_shaft_comes_to_rest_as_with_films_at_rest(shape):
    scene, loads = scene_in(shape), loads_of(swing=0.0)
    found = shaft.bearing_loads(scene, None, {"loads": loads}).isel(time=-1)
    concept, one = scene.shaft.concepts[0], loads.isel(time=[0])
    models = {
        name: film_model(scene.journal.at(name), one["speed"].values, tilting=True)
        for name in concept.bearings
    }
    rest = suspended(concept, one["hub_force"], one["hub_moment"], tilt=TILT, models=models)
    rest = rest.isel(time=0)
    for name, share in (("tilt", 5e-3), ("displacement", 5e-3), ("force", 1e-3)):
        off = np.abs(found[name] - rest[name]).max() / np.abs(rest[name]).max()
        assert off < share, name


def test_films_of_the_run_are_those_that_tilt_the_shaft(moved):
    scene, loads, found = moved
    told = journal.orbit(scene, _Case(), {"loads": loads, "shaft": found})
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    for k, name in enumerate(("N", "N2")):
        ours = told[name]["eccentricity"].values
        assert np.array_equal(ours, both.position[:, k])
        assert np.allclose(told[name]["tilt"].values, both.tilt[:, k])


@pytest.mark.parametrize("shape", [{"kind": "cylindrical"}, LEMON, PADS])
def test_a_shaft_that_would_leave_its_bore_is_held_where_it_touches(shape):
    """A slope beyond the clearance: surfaces touch at an end, the gap stays open."""
    wide = {"diameter": 2.0, "width": 1.9, "relative_clearance": 1e-3, "shape": shape}
    scene = scene_of(geometry=wide, lubricant={"viscosity": 0.03})
    loads = loads_of(swing=2.5)
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    least = min(float(path["minimum_film"].min()) for path in both.paths)
    assert 0.0 < least < scene.journal.contact_film


def test_bores_that_are_turned_turn_the_shaft_in_its_films_as_much_less():
    """At rest under a load that stays, with films in motion as with films at rest."""
    turn, loads = [2e-4, -1e-4], loads_of(swing=0.0)
    scene = scene_of(alignment=turn)
    found = shaft.bearing_loads(scene, None, {"loads": loads}).isel(time=-1)
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    told = to_film(found["tilt"].transpose("bearing", "axis").values)
    assert np.allclose(told - both.tilt[-1], [turn, turn], atol=1e-7)
    concept, one = scene.shaft.concepts[0], loads.isel(time=[0])
    bore = from_film(np.array(turn))
    models = {
        name: film_model(scene.journal.at(name), one["speed"].values, tilting=True, bore=bore)
        for name in concept.bearings
    }
    rest = suspended(concept, one["hub_force"], one["hub_moment"], tilt=TILT, models=models)
    rest = rest.isel(time=0)
    for name in ("tilt", "moment"):
        off = np.abs(found[name] - rest[name]).max() / np.abs(rest[name]).max()
        assert off < 1e-2, name


ROUGH = {
    "friction": 0.15,
    "asperities": {"roughness": 0.56e-6, "contact_modulus": 46.5e9, "factor": 1e-3},
}
GIVES = {"kind": "local", "compliance": 2.06e-12}


@pytest.mark.parametrize("heat", [{}, {"heat": {"oil": "iso-vg-220", "inlet_temperature": 350.0}}])
def test_ends_that_touch_smooth_soft_shells_hold_a_shaft_as_asperities_do(heat):
    """10 µm/MPa, cold and warm: where no film is left at an end, a stop takes its place."""
    given = {"geometry": {"diameter": 2.0, "width": 1.9, "relative_clearance": 1e-3}}
    given |= {"shell": {"kind": "local", "compliance": 1e-11}}
    given |= heat or {"lubricant": {"viscosity": 0.03}}
    loads = loads_of(swing=2.0, steps=300)
    smooth, rough = (path_in(scene_of(**given | more), loads) for more in ({}, {"contact": ROUGH}))
    assert min(float(one["minimum_film"].min()) for one in smooth.paths) < 3.8e-6
    off = np.sqrt(np.mean((smooth.tilt - rough.tilt) ** 2) / np.mean(rough.tilt**2))
    assert off < 0.05  # ends touch for a tenth of the time and more


def test_a_shaft_that_stands_rests_on_asperities_lifts_off_and_comes_to_a_stop():
    """Each film alone, from its own rest around the shaft as it is told, goes the same way."""
    scene, loads = scene_of(contact=ROUGH, shell=GIVES), loads_of(swing=0.1)
    there_and_back = np.clip(2.7 - np.abs(np.linspace(-3.0, 3.0, STEPS)), 0.0, 1.0)
    loads = loads.assign(speed=loads["speed"] * xr.DataArray(there_and_back, dims="time"))
    found = shaft.bearing_loads(scene, None, {"loads": loads})
    assert found["converged"].all()
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    for k, name in enumerate(("N", "N2")):
        share, films = (both.paths[k][each].values for each in ("contact_share", "minimum_film"))
        assert share[0] > 0.9
        assert abs(share[STEPS // 2]) < 1e-6
        assert films[0] < 1e-6 < 10e-6 < films[STEPS // 2]
        options = scene.journal.at(name)
        force, tilt, bend = (
            to_film(found[each].sel(bearing=name).T.values.astype(float))
            for each in ("force", "tilt", "curvature")
        )
        alone = options.geometry.orbit(
            loads["time"].values, force, loads["speed"].values, options.film_model,
            tilt=tilt, bend=bend, control=Control(tolerance=1e-8),
        )  # fmt: skip
        off = np.abs(alone["eccentricity"].values - both.position[:, k]).max(axis=1)
        assert off.max() < 1e-3 * options.geometry.clearance
        assert np.allclose(alone["minimum_film"].values, films, rtol=0.01, atol=5e-7)
    assert not followed_together(scene_of(), scene.shaft.concepts[0], loads["speed"].values)


def test_squeeze_holds_a_shaft_that_comes_to_a_stop():
    scene, loads = scene_of(), loads_of()
    slower = np.clip(1.5 - 1.5 * loads["time"] / loads["time"][-1], 0.0, 1.0)
    loads = loads.assign(speed=loads["speed"] * slower)
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    films = np.stack([path["minimum_film"] for path in both.paths], axis=1)
    assert np.all(films > 0.0)
    assert np.all(films[-1] < films[0])


def test_a_path_that_stops_leaves_the_shaft_on_rigid_bearings(monkeypatch):
    def stops(*given):
        raise SolverError("orbit stops at t = 1 s")

    scene, loads = scene_of(), loads_of()
    monkeypatch.setattr(shaft_in_films_stage, "_followed", stops)
    monkeypatch.setattr(shaft_in_films_stage, "_KEPT", {})
    with pytest.warns(ValidityWarning, match="stops at t = 1 s"):
        found = shaft.bearing_loads(scene, None, {"loads": loads})
    assert not found["converged"].any()
    assert 0.0 < np.abs(found["tilt"]).max() < 1e-4
    assert not found["moment"].any()  # as no film says that it takes one


SOFT = {
    "shaft": {"modulus": 2.1e10},
    "housing": {
        "supports": [{"stiffness": "journal", "takes_moment": True, "housing_tilt": 1e9}] * 2
    },
}


@pytest.mark.parametrize("soft", SOFT)
def test_the_path_of_a_soft_shaft_or_housing_does_not_hang_on_the_step(soft):
    """Moments of the films turn shaft or bores as much as positions do."""
    scene = scene_of(**SOFT[soft])
    found = []
    for step in (0.05, 0.0125):
        loads = loads_of(steps=round(15.0 / step), step=step)
        path = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
        found.append(path.moment[:: round(0.05 / step)][-150:])
    coarse, fine = found
    assert np.abs(coarse - fine).max() < 0.02 * np.abs(fine).max()


def test_samples_between_those_that_films_take_tell_how_far_they_may_be_off(moved):
    _, loads, every = moved
    found = shaft.bearing_loads(scene_of(step=0.2), None, {"loads": loads})
    true, taken = 0.0, slice(None, None, 4)
    for name in ("moment", "displacement", "tilt"):
        known = every[name].transpose("time", ...).isel(time=slice(None, -3))
        between = known.isel(time=taken).interp(time=known["time"])
        true = max(true, float(np.abs(between - known).max() / np.abs(known).max()))
    assert every.attrs["interpolation_error"] == 0.0
    assert true > 0.01
    assert 0.7 * true < found.attrs["interpolation_error"] < 2.0 * true


def test_how_hard_its_steps_were_is_told_of_a_path(moved):
    scene, loads, found = moved
    paths = films_together(scene, scene.shaft.concepts[0], loads, TILT).path.paths
    assert found.attrs["residual"] == max(float(one["residual"].max()) for one in paths)
    assert found.attrs["iterations"] == max(int(one["iterations"].max()) for one in paths) > 1


def test_a_path_is_kept_for_its_bores_and_its_past(moved, monkeypatch):
    scene, loads, _ = moved
    concept = scene.shaft.concepts[0]

    def tilt() -> np.ndarray:
        return films_together(scene, concept, loads, TILT).path.tilt

    straight = tilt()
    with monkeypatch.context() as other:
        other.setattr(shaft_in_films_stage, "past_of", lambda scene, loads: AT_REST)
        at_rest = tilt()
    turned = {name: np.array([0.0, 1e-4, 0.0]) for name in concept.bearings}
    monkeypatch.setattr(shaft_in_films_stage, "bores", lambda scene: turned)
    assert np.abs(at_rest - straight)[0].max() > 1e-6
    assert np.abs(tilt() - straight).max() > 5e-5


def test_films_that_store_heat_cool_down_to_their_balance():
    heat = {"oil": "iso-vg-220", "inlet_temperature": 313.15, "capacity": 2e5}
    heat["start_temperature"] = 323.15
    scene, loads = scene_of(heat=heat), loads_of()
    both = films_together(scene, scene.shaft.concepts[0], loads, TILT).path
    for path in both.paths:
        warm = path["temperature"].values
        assert warm[0] < 323.15
        assert warm[-1] > 313.15
        assert np.all(np.diff(warm) < 0.0)
        assert np.ptp(warm) > 0.1


def followed(scene: Scene, concept: TwoPoint) -> bool:
    return move_together(scene.shaft, scene.journal, concept)


def test_they_move_together_where_both_bearings_are_films_in_motion():
    own, rigid = {"stiffness": "journal", "takes_moment": True}, {"takes_moment": True}
    concept = scene_of().shaft.concepts[0]
    assert followed(scene_of(), concept)
    mixed = scene_of([own, rigid])
    assert not followed(mixed, mixed.shaft.concepts[0])
    assert not followed(scene_of(motion="quasi-static"), concept)
    assert not followed(scene_of(rung="grid"), concept)
    assert not followed(scene_of(), replace(concept, beam=None))


class _Case:
    """A case that runs."""

    dlc, parked, file = "1.1", False, ""
