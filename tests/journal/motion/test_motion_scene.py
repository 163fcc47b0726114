"""A film in motion lies in the bearing as the beam of the shaft does, with heat and contact."""

import numpy as np
import pytest
import xarray as xr

from loadflow.quantities import percent
from loadflow.scene import make_scene
from loadflow.scene.cases import Case
from loadflow.stages import journal as stage
from loadflow.stages.effects import film, film_tilt
from loadflow.stages.films.of_bearing import aligned, follow
from loadflow.stages.journal import fast_film

TIME = np.arange(0.0, 1.0, 0.05)
FORCE = np.stack([0 * TIME, 2e5 * np.cos(2 * TIME), -2e6 + 2e5 * np.sin(TIME)], axis=-1)
TILT = 5e-5 * np.stack([0 * TIME, np.cos(TIME), np.sin(TIME)], axis=-1)
MOVING = {"motion": "transient", "rung": "reduced"}
ROUGH = {"asperities": {"roughness": 2e-6, "contact_modulus": 1.1e11, "factor": 1e-3}}


def reactions(tilt=TILT):
    values = {"force": FORCE, "moment": 0.01 * FORCE, "tilt": tilt, "curvature": TILT / 5}
    return xr.Dataset({name: (("time", "axis"), rows) for name, rows in values.items()})


def loads(speed=1.2):
    return xr.Dataset({"time": ("time", TIME), "speed": ("time", np.full(TIME.size, speed))})


def in_film(vectors):
    """In the frame of the film: down, then left."""
    return np.stack([-vectors[:, 2], vectors[:, 1]], axis=-1)


def test_tilt_of_the_beam_reaches_the_film_in_motion():
    journal = make_scene({"journal": MOVING | {"tilt": True}}).journal
    path = follow(journal, loads(), reactions())
    np.testing.assert_allclose(path.tilt.values, in_film(TILT), atol=1e-15)
    aligned = follow(journal.model_copy(update={"tilt": False}), loads(), reactions())
    ends = np.hypot(*path.tilt.values.T) * journal.geometry.width / 2
    lost = aligned.minimum_film.values - path.minimum_film.values
    assert np.all(lost < 1.2 * ends)
    assert lost.max() > 0.3 * ends.max()


def test_without_a_beam_the_shaft_tilts_freely_under_its_moment():
    journal = make_scene({"journal": MOVING | {"tilt": True}}).journal
    path = follow(journal, loads(), reactions(tilt=np.nan * TILT))
    np.testing.assert_allclose(path.moment, 0.01 * in_film(FORCE), rtol=1e-3, atol=20.0)


@pytest.mark.parametrize("tilt", [TILT, np.nan * TILT])
def test_a_shaft_that_may_tilt_and_lies_aligned_has_the_film_without_tilt(tilt):
    """So a pilot asks what tilt changes with the loops of one film alone."""
    journal = make_scene({"journal": MOVING | {"tilt": True}}).journal
    journal = journal.model_copy(update={"alignment": (1e-4, -2e-4)})
    still = follow(journal, loads(), aligned(journal, reactions(tilt)))
    without = follow(journal.model_copy(update={"tilt": False}), loads(), reactions(tilt))
    assert np.abs(still.tilt).max() < 1e-12
    for name in ("minimum_film", "maximum_pressure", "friction_power"):
        np.testing.assert_allclose(still[name], without[name], rtol=2e-5)


@pytest.mark.parametrize("rung", ["reduced", "grid"])
def test_motion_tilt_heat_and_contact_are_one_scene(rung):
    heat = {"oil": "mineral-vg-320", "capacity": 1e6, "start_temperature": 313.15}
    words = {"motion": "transient", "rung": rung, "tilt": True, "contact": ROUGH, "heat": heat}
    journal = make_scene({"journal": words}).journal
    assert journal.film_model.heat.capacity == 1e6
    assert fast_film(journal).rung == "reduced"
    if rung == "reduced":
        path = follow(journal, loads(), reactions())
        assert {"temperature", "tilt", "moment", "contact_share"} <= set(path)


def test_a_scene_lets_the_clearance_follow_the_heat_that_is_stored():
    heat = {"oil": "mineral-vg-320", "capacity": 1e4, "start_temperature": 293.15}
    words = {
        "motion": "transient",
        "rung": "reduced",
        "heat": heat | {"growth": {"shell_share": 0.7}},
    }
    path = follow(make_scene({"journal": words}).journal, loads(), reactions())
    assert float(path.temperature[-1]) > 294.0
    assert float(path.clearance[-1]) < float(path.clearance[0])


@pytest.mark.parametrize("rung", ["reduced", "grid"])
def test_a_scene_on_tilting_pads_has_a_film_in_motion(rung):
    pads = {"kind": "tilting pads", "count": 5, "arc": 1.05, "preload": 0.3}
    size = {"diameter": 3.0, "width": 2.25, "relative_clearance": 5e-4, "shape": pads}
    words = {"motion": "transient", "rung": rung, "tilt": True, "geometry": size}
    journal = make_scene({"journal": words}).journal
    assert fast_film(journal).rung == "reduced"
    path = follow(journal, loads(), reactions())
    assert {"tilt", "moment", "pad_tilt"} <= set(path)
    assert float(path.residual.max()) < 1e-6


@pytest.mark.parametrize("grid", [(24, 4), (60, 12)])
def test_a_run_tells_of_paths_that_its_cells_do_not_resolve(grid):
    size = {"diameter": 1.4, "width": 1.3, "relative_clearance": 1e-3}
    words = {"motion": "transient", "rung": "grid", "grid": grid, "geometry": size}
    scene = make_scene({"journal": words | {"bearings": ["N"]}, "shaft": {"two_point": {}}})
    force = np.tile(0.3 * FORCE[0], (TIME.size, 1))
    light = reactions().assign(force=(("time", "axis"), force)).expand_dims(bearing=["N"])
    case = Case(dlc="1.1", wind_speed=8.0, seed=1)
    tree = stage.orbit(scene, case, {"loads": loads(), "shaft": light})
    table = stage.STAGE.summarise({case: tree})
    said = stage.STAGE.warnings(xr.DataTree.from_dict({"/journal": table}))
    share = (table.smallest_film_grid_error / table.smallest_film).item()
    assert share == tree["N"].attrs["minimum_film_grid_error"] / table.smallest_film.item()
    if grid == (60, 12):
        assert share < 0.25
        assert not said
    else:
        assert share >= 0.25
        assert len(said) == 1
        assert "bearing N: the cells do not resolve the film in 1 of 1 load cases" in said[0]
        assert f"is known to {percent(share)}" in said[0]


def test_the_plan_may_have_tilt_and_motion_together():
    scene = make_scene({"journal": MOVING, "shaft": {"two_point": {"beam": {}}}})
    tilted = film_tilt.TILT.switched(scene, True)
    assert tilted is not None
    assert tilted.journal.tilt
    assert tilted.journal.in_motion
    assert film_tilt.TILT.known_by(tilted)
    assert film.MOTION.is_on(tilted)


def test_shells_asperities_and_a_supply_go_together_in_motion():
    thick = {"kind": "thick", "outer_diameter": 3.5, "modulus": 2.1e11}
    assert make_scene({"journal": MOVING | {"shell": thick}}).journal.shell.modulus == 2.1e11
    rubs = MOVING | {"shell": thick, "contact": ROUGH}
    assert make_scene({"journal": rubs}).journal.contact is not None
    fed = {"supply": {"grooves": [{"angle": 0.0, "pressure": 2e5}]}}
    beside = make_scene({"journal": rubs | fed | {"cavitation": "mass-conserving"}})
    assert beside.journal.supply is not None
    local = {"kind": "local", "compliance": 1e-12}
    assert make_scene({"journal": MOVING | {"shell": local}}).journal.shell.compliance == 1e-12
    both = make_scene({"journal": MOVING | {"shell": local, "contact": ROUGH}})
    assert both.journal.contact is not None
