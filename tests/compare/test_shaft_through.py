"""The shaft through the bearings of a design: as wide as they let it be, its tilt a condition."""

from dataclasses import replace

import numpy as np
import pytest
from synthetic import case

from loadflow.scene.scene import Candidate, make_scene
from loadflow.shaft import Beam, ShaftSection, TwoPoint, bearing_loads
from loadflow.stages import shaft
from loadflow.studies.design.point import judge_design
from loadflow.studies.lifetime.load_spectrum import load_spectrum
from loadflow.studies.shaft_through import BentShaft, fitting_shaft, through

STATED = Beam(sections=(ShaftSection(2.4, 1.2, length=2.5), ShaftSection(2.0, 0.9)))
PLACES = ("N", "N2")


def diameters(concept):
    return [(one.outer_diameter, one.inner_diameter) for one in concept.beam.sections]


def test_a_shaft_too_wide_for_a_bearing_is_made_narrower_as_a_whole():
    concept = TwoPoint(beam=STATED)
    assert through(concept, {"N": 2.4, "N2": 2.0}) is concept
    narrow = through(concept, {"N": 2.4, "N2": 1.0})
    np.testing.assert_allclose(diameters(narrow), [(1.2, 0.6), (1.0, 0.45)])


def test_only_a_shaft_whose_sections_nobody_stated_grows_with_its_bearings():
    concept = TwoPoint(beam=STATED)
    wide = {"N": 4.8, "N2": 4.8}
    assert through(concept, wide) is concept
    np.testing.assert_allclose(diameters(through(concept, wide, follows=True))[0], (4.8, 2.4))


def scene_with(beam):
    journals = {place: {"kind": "journal", "lubricant": {"viscosity": 0.2}} for place in PLACES}
    return make_scene({
        "accuracy": "given",
        "results": ["loads.statistics"],
        "shaft": {"two_point": {} if beam is None else {"beam": beam}},
        "candidates": {"wide": journals, "two-spherical": {}, "cylindrical-tapered": {}},
    })  # fmt: skip


def loads_of(scene):
    hub = case(12.0, 1).assign_coords(weight=1.0)
    return hub, shaft.bearing_loads(scene, None, {"loads": hub})


def spectrum_of(scene, places=PLACES):
    return load_spectrum(scene, [("case", *loads_of(scene))], places, 3)


def with_geometry(candidate, **measures):
    geometry = replace(candidate.journal.geometry, **measures)
    journal = candidate.journal.model_copy(update={"geometry": geometry, "further": []})
    return Candidate(journal=journal)


STATED_SECTIONS = {"sections": [{"outer_diameter": 2.0, "inner_diameter": 0.9}]}


def test_the_tilt_of_a_design_is_that_of_the_beam_that_fits_it():
    scene = scene_with(STATED_SECTIONS)
    bent = BentShaft.of(scene, PLACES)
    candidate = with_geometry(scene.candidates["wide"], diameter=1.0)
    samples = spectrum_of(scene)["N"].to_dataset()
    fits = fitting_shaft(scene, candidate).two_point
    assert diameters(fits) == [(1.0, 0.45)]
    found = bent.lying(candidate, "N", samples)
    alone = bearing_loads(
        fits, samples["hub_force"].values.T, samples["hub_moment"].values.T, tilt=bent.gravity
    ).sel(bearing="N")
    for name in ("tilt", "curvature"):
        expected = alone[name].transpose("time", "axis").values
        np.testing.assert_allclose(found[name].values, expected, atol=1e-12)
    assert np.abs(found["tilt"]).max() > 10 * np.abs(samples["tilt"]).max()  # 2⁴ by bending alone


def test_a_slender_shaft_closes_the_film_at_an_end_and_the_design_does_not_hold():
    scene = scene_with(STATED_SECTIONS)
    bent, spectrum = BentShaft.of(scene, PLACES), spectrum_of(scene)
    for diameter in (2.0, 0.8):
        one = with_geometry(
            scene.candidates["wide"], diameter=diameter, width=1.4, relative_clearance=1.1e-3
        )
        aligned = judge_design(one, scene.friction, spectrum)
        point = judge_design(one, scene.friction, spectrum, bent)
        assert point.energy == aligned.energy
        if diameter == 2.0:
            assert point == aligned
        else:
            assert point.lacks.startswith("tilt of the shaft in N")
            assert point.condition < min(1.0, aligned.condition)


def test_films_follow_the_shaft_where_models_are_chosen_by_an_accuracy():
    scene = scene_with(STATED_SECTIONS)
    spectrum, stated = spectrum_of(scene), BentShaft.of(scene, PLACES)
    asked = BentShaft.of(scene.model_copy(update={"accuracy": 0.05}), PLACES)
    assert (stated.in_films, asked.in_films) == (False, True)

    def judged(diameter, bent):
        measures = {"diameter": diameter, "width": 1.4, "relative_clearance": 1.1e-3}
        one = with_geometry(scene.candidates["wide"], **measures)
        return judge_design(one, scene.friction, spectrum, bent)

    losses = []
    for diameter in (2.0, 1.6):
        aligned, bent = judged(diameter, stated), judged(diameter, asked)
        losses.append(bent.numbers["minimum_film"] / aligned.numbers["minimum_film"])
        assert bent.load_factor < aligned.load_factor
    assert losses[1] < 0.9 < losses[0] < 1  # the narrow shaft bends more
    # where it closes the aligned film at an end, the tilt says how far off the design is
    assert judged(0.8, asked) == judged(0.8, stated)


def test_rollers_bear_no_more_tilt_than_they_allow_and_barrels_align_themselves():
    scene = scene_with(STATED_SECTIONS)
    bent, spectrum = BentShaft.of(scene, PLACES), spectrum_of(scene)
    rollers = scene.candidates["cylindrical-tapered"]
    point = judge_design(rollers, scene.friction, spectrum, bent)
    *words, place = point.lacks.split()
    assert words == ["tilt", "of", "the", "shaft", "in"]
    tilt = bent.lying(rollers, place, spectrum[place].to_dataset())["tilt"].values
    allowed = rollers.rolling.geometries[place].allowed_tilt
    assert point.condition == pytest.approx(allowed / np.hypot(tilt[:, 1], tilt[:, 2]).max())
    barrels = judge_design(scene.candidates["two-spherical"], scene.friction, spectrum, bent)
    assert barrels.condition > 1


def test_a_rigid_shaft_limits_no_design():
    scene = scene_with(None)
    assert BentShaft.of(scene, PLACES) is None
    assert fitting_shaft(scene, scene.candidates["wide"]) is scene.shaft
