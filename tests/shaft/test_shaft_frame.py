"""Housings and frames given by a matrix: closed forms, coupled supports, what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from synthetic import case as synthetic_case

from loadflow.errors import InputError
from loadflow.scene.scene import make_scene, read_scene
from loadflow.scene.schema import json_schema
from loadflow.shaft import (
    Beam,
    BearingSupport,
    CoupledBearing,
    FrameMatrix,
    MomentBearing,
    ShaftSection,
    TwoPoint,
    bearing_loads,
    coupled_loads,
    scaled_suspension,
)
from loadflow.stages.films.of_bearing import equilibria
from loadflow.stages.journal import film
from loadflow.stages.reduction import reduced_loads
from loadflow.stages.shaft import bearing_loads as shaft_stage

SOLID = ShaftSection(1.0, 0.4)
EI = 2.1e11 * SOLID.inertia
FRAME_EI = 4e10
PLACES, ROOT = (2.0, 5.0), 8.0  # m from the hub: both bearings, and where the frame is held
SUPPORTS = (
    BearingSupport(radial=3e9),
    BearingSupport(radial=2e9, takes_moment=True, tilt=8e8),
)
ALONG = ("force", "moment", "displacement", "tilt", "bore_tilt")


@pytest.fixture
def given(tmp_path):
    """Make a frame of a matrix, by way of its file."""

    def make(matrix, form="compliance", name="frame.npy"):
        path = tmp_path / name
        if path.suffix == ".npy":
            np.save(path, matrix)
        else:
            np.savetxt(path, matrix, fmt="%.17g", delimiter="," if path.suffix == ".csv" else " ")
        return FrameMatrix(str(path), form)

    return make


def two_point(supports=SUPPORTS, frame=None, **beam):
    beam = Beam((SOLID,), supports, shear=False, frame=frame, **beam)
    return TwoPoint(PLACES[0], PLACES[1] - PLACES[0], 1.0, gearbox_mass=0.0, beam=beam)


def cantilever():
    """Compliance (12, 12) at the bearings of a beam held at `ROOT`, as textbooks have it."""
    arm = [ROOT - place for place in PLACES]
    matrix = np.zeros((12, 12))
    for i, a in enumerate(arm):
        for j, b in enumerate(arm):
            short, long = min(a, b), max(a, b)
            shift = short**2 * (3 * long - short) / 6 / FRAME_EI
            # slope at j under a force at i; the free end goes with the force, the slope against it
            slope = -(a**2 - max(a - b, 0.0) ** 2) / 2 / FRAME_EI
            turn = short / FRAME_EI
            at = 6 * i, 6 * j
            for axis in (1, 2):
                matrix[at[0] + axis, at[1] + axis] = shift
                matrix[at[0] + 3 + axis, at[1] + 3 + axis] = turn
            matrix[at[1] + 5, at[0] + 1] = matrix[at[0] + 1, at[1] + 5] = slope
            matrix[at[1] + 4, at[0] + 2] = matrix[at[0] + 2, at[1] + 4] = -slope
            matrix[at[0], at[1]] = short / 5e10
            matrix[at[0] + 3, at[1] + 3] = short / 2e10
    return matrix


def element(stiff, length):
    """Stiffness of a beam element for (v, v′) of both ends."""
    l = length  # noqa: E741
    return (
        stiff
        / l**3
        * np.array(
            [
                [12, 6 * l, -12, 6 * l],
                [6 * l, 4 * l**2, -6 * l, 2 * l**2],
                [-12, -6 * l, 12, -6 * l],
                [6 * l, 2 * l**2, -6 * l, 4 * l**2],
            ]
        )
    )


def by_hand(push, turn):
    """Shaft, bearings and frame as one system of beam elements: forces, moments, motions, tilts.

    Nodes with (v, v′): the shaft at hub, N and N2, the frame at N, N2 and its root.
    """
    stiffness, load = np.zeros((12, 12)), np.zeros(12)
    for first, stiff, length in (
        (0, EI, 2.0),
        (2, EI, 3.0),
        (6, FRAME_EI, 3.0),
        (8, FRAME_EI, 3.0),
    ):
        rows = slice(first, first + 4)
        stiffness[rows, rows] += element(stiff, length)
    springs = ((2, 6, 3e9), (4, 8, 2e9), (5, 9, 8e8))
    for shaft, bore, spring in springs:
        both = np.ix_([shaft, bore], [shaft, bore])
        stiffness[both] += spring * np.array([[1, -1], [-1, 1]])
    load[:2] = push, turn
    moved = np.linalg.solve(stiffness[:10, :10], load[:10])
    radial = [spring * (moved[s] - moved[b]) for s, b, spring in springs[:2]]
    moment = 8e8 * (moved[5] - moved[9])
    return radial, [0.0, moment], moved[[2, 4]], moved[[3, 5]], moved[[7, 9]]


@pytest.mark.parametrize("form", ["compliance", "stiffness"])
@pytest.mark.parametrize("name", ["frame.npy", "frame.csv", "frame.txt"])
def test_a_frame_that_couples_its_supports_is_the_same_beam_by_hand(given, form, name):
    matrix = cantilever() if form == "compliance" else np.linalg.inv(cantilever())
    concept = two_point(frame=given(matrix, form, name))
    found = bearing_loads(concept, [0.0, 1e6, -7e5], [0.0, 4e5, 3e5]).isel(time=0)
    # in the other plane a moment about y is one against the slope along z
    for axis, other, sign, expected in (
        ("y", "z", 1.0, by_hand(1e6, 3e5)),
        ("z", "y", -1.0, by_hand(-7e5, -4e5)),
    ):
        turns = {"force": 1.0, "moment": sign, "displacement": 1.0, "tilt": sign, "bore_tilt": sign}
        for (quantity, turn), values in zip(turns.items(), expected, strict=True):
            along = axis if quantity in ("force", "displacement") else other
            ours = found[quantity].sel(axis=along).values
            size = np.abs(values).max()
            np.testing.assert_allclose(turn * ours, values, rtol=1e-8, atol=1e-9 * size)
    rigid = bearing_loads(two_point(), [0.0, 1e6, -7e5], [0.0, 4e5, 3e5]).isel(time=0)
    assert float(abs(found["moment"] - rigid["moment"]).max()) > 0.1 * float(
        abs(rigid["moment"]).max()
    ), "the frame counts here"


def test_one_housing_is_a_spring_in_closed_form(given):
    """A bearing on a post: thrust tilts it by F h²/2EI, a moment shifts it as far."""
    height, stiff = 1.5, 3e9
    post = np.diag([height**3 / 3, 0.0, 0.0, 0.0, height, 0.0]) / stiff
    post[0, 4] = post[4, 0] = height**2 / 2 / stiff
    support = BearingSupport(takes_moment=True, housing=given(post))
    beam = Beam((SOLID,), (support,), youngs_modulus=1e20)
    concept = MomentBearing(2.0, beam=beam)
    found = bearing_loads(concept, [4e5, 0.0, 0.0], [0.0, 7e5, 0.0]).isel(time=0, bearing=0)
    expected = [0.0, (4e5 * height**2 / 2 + 7e5 * height) / stiff, 0.0]
    for name in ("tilt", "bore_tilt"):
        np.testing.assert_allclose(found[name].values, expected, rtol=1e-9, atol=1e-14)


def test_a_diagonal_housing_is_that_of_its_numbers(given):
    numbers = replace(SUPPORTS[1], housing_lateral=4e9, housing_vertical=6e9, housing_tilt=1e9)
    matrix = np.diag([1e9, 4e9, 6e9, 1e9, 1e9, 1e9])
    housed = replace(SUPPORTS[1], housing=given(matrix, "stiffness"))
    loads = [5e5, 1e6, -7e5], [0.0, 4e5, 3e5]
    ours, theirs = (
        bearing_loads(two_point((SUPPORTS[0], support)), *loads) for support in (housed, numbers)
    )
    for name in ALONG:
        size = float(abs(theirs[name]).max())
        assert float(abs(ours[name] - theirs[name]).max()) < 1e-11 * size


@pytest.mark.parametrize(("scale", "form"), [(0.0, "compliance"), (1e24, "stiffness")])
def test_a_rigid_matrix_gives_the_rigid_answer(given, scale, form):
    loads = [5e5, 1e6, -7e5], [0.0, 4e5, 3e5]
    ours = bearing_loads(two_point(frame=given(scale * np.eye(12), form)), *loads)
    theirs = bearing_loads(two_point(), *loads)
    for name in ("force", "moment", "displacement", "tilt"):
        size = float(abs(theirs[name]).max())
        assert float(abs(ours[name] - theirs[name]).max()) < 1e-11 * size
    assert float(abs(ours["bore_tilt"]).max()) < 1e-15


def test_a_determinate_suspension_feels_a_frame_in_its_tilt_alone(given):
    free = (BearingSupport(), BearingSupport())
    loads = [5e5, 1e6, -7e5], [0.0, 4e5, 3e5]
    ours = bearing_loads(two_point(free, given(cantilever())), *loads)
    theirs = bearing_loads(two_point(free), *loads)
    for name in ("force", "moment"):
        assert float(abs(ours[name] - theirs[name]).max()) < 1e-6
    assert float(abs(ours["tilt"] - theirs["tilt"]).max()) > 1e-6
    # nothing takes a moment, but the forces turn the bores
    assert float(abs(ours["bore_tilt"]).max()) > 1e-6


@pytest.mark.parametrize("cheap", [True, False])
def test_bearings_with_models_stand_on_the_frame_as_their_numbers_do(given, cheap):
    def spring(force, moment):
        stiffness = np.broadcast_to(np.diag([2e9, 2e9, 8e8, 8e8]), (len(force), 4, 4))
        return np.concatenate([force[:, 1:] / 2e9, moment[:, 1:] / 8e8], axis=1), stiffness

    n = 160
    rng = np.random.default_rng(5)
    force, moment = 1e6 * rng.standard_normal((2, 3, n))
    frame, own = given(cantilever()), BearingSupport(stiffness="rolling", takes_moment=True)
    bearing = CoupledBearing(lambda rows: spring, np.zeros(n), np.zeros(n, dtype=bool), cheap)
    found = coupled_loads(two_point((SUPPORTS[0], own), frame), force, moment, {"N2": bearing})
    numbers = bearing_loads(two_point(frame=frame), force, moment)
    for name in ALONG:
        size = float(abs(numbers[name]).max())
        assert float(abs(found[name] - numbers[name]).max()) < 1e-8 * size
    assert found["converged"].all()


def changed(row, column, value):
    matrix = cantilever()
    matrix[row, column] = value
    return matrix


@pytest.mark.parametrize(
    ("matrix", "form", "message"),
    [
        (np.eye(5), "stiffness", r"6 rows and columns for each support, got \(5, 5\)"),
        (np.ones((6, 12)), "stiffness", r"got \(6, 12\)"),
        (changed(2, 7, np.nan), "compliance", r"got nan in row 3 \(Fz of support 1\), column 8"),
        (changed(0, 0, -1e-9), "compliance", r"got -1e-09 in row 1 \(Fx of support 1\)"),
        (
            changed(10, 2, 0.0),
            "compliance",
            r"symmetric, got .* in row 3 \(Fz of support 1\), column 11 \(My of support 2\) and 0",
        ),
        (changed(1, 1, 0.0), "compliance", r"zero in a whole row .* row 2 \(Fy of support 1\)"),
        (
            np.eye(6) + 2 * np.eye(6)[::-1],
            "compliance",
            r"semidefinite, but a motion of which \d \(",
        ),
        (np.diag([1e9, 1e9, 1e9, 1e9, 0.0, 1e9]), "stiffness", r"5 \(My of support 1\) moves it"),
        (np.kron([[1.0, -1.0], [-1.0, 1.0]], np.eye(6)), "stiffness", "hold it at the tower"),
        (np.eye(6), "mass", "form"),
    ],
)
def test_a_matrix_that_is_none_of_a_structure_is_refused_by_entry(given, matrix, form, message):
    with pytest.raises(InputError, match=message) as told:
        given(matrix, form)
    assert form == "mass" or "frame.npy" in str(told.value)


def test_what_is_symmetric_but_for_printing_is_taken(given):
    matrix = cantilever()
    matrix[1, 5] *= 1 + 5e-7
    frame = given(matrix)
    np.testing.assert_array_equal(frame.compliance, frame.compliance.T)


def test_matrices_that_do_not_fit_their_place_are_refused(given):
    two, one = given(cantilever()), given(1e-10 * np.eye(6), name="one.npy")
    with pytest.raises(InputError, match=r"\(12, 12\) is needed for 2 bearings, got \(6, 6\)"):
        two_point(frame=one)
    with pytest.raises(InputError, match=r"\(6, 6\) is needed for one support, got \(12, 12\)"):
        BearingSupport(housing=two)
    with pytest.raises(InputError, match=r"housing_vertical = 4000000000.0 N/m.*leave them out"):
        BearingSupport(housing=one, housing_vertical=4e9)
    for scaled in (two_point(frame=two), two_point((BearingSupport(housing=one), SUPPORTS[1]))):
        with pytest.raises(InputError, match="does not scale"):
            scaled_suspension(scaled, 2.0)


STEEL = {"sections": [{"outer_diameter": 2.0, "inner_diameter": 1.6}]}
SCENE = """
name = "on-a-frame"
results = ["journal.film"]
[shaft.two_point.beam]
sections = [{ outer_diameter = 2.0, inner_diameter = 1.6 }]
[shaft.two_point.beam.frame]
file = "parts/frame.csv"
form = "compliance"
[bearings.N]
kind = "journal"
tilt = true
grid = [36, 8]
[bearings.N2]
like = "N"
[reduction]
size = 0.05
"""


class _Case:
    name, file = "dlc1.1_v12_s1", ""


def stages(scene):
    """Loads, shaft, reduction and film of one small case."""
    found = {"loads": synthetic_case(12.0, 1, steps=120)}
    found["shaft"] = shaft_stage(scene, _Case, found)
    found["reduction"] = reduced_loads(scene, _Case, found)
    return found | {"journal": film(scene, _Case, found)}


def written(tmp_path):
    """A scene whose frame is in a file beside it."""
    (tmp_path / "parts").mkdir()
    np.savetxt(tmp_path / "parts" / "frame.csv", cantilever(), delimiter=",")
    (tmp_path / "scene.toml").write_text(SCENE, encoding="utf-8")
    return tmp_path / "scene.toml"


def test_the_film_of_a_scene_sees_the_shaft_tilt_against_its_bore(tmp_path):
    scene = read_scene(written(tmp_path))
    plain = scene.model_copy(
        update={
            "shaft": scene.shaft.model_copy(
                update={
                    "two_point": replace(
                        scene.shaft.two_point, beam=replace(scene.shaft.two_point.beam, frame=None)
                    )
                }
            )
        }
    )
    ours, theirs = stages(scene), stages(plain)
    hub = [ours["loads"][name].transpose("axis", "time").values.astype(float)
           for name in ("hub_force", "hub_moment")]  # fmt: skip
    room = bearing_loads(scene.shaft.two_point, *hub, tilt=np.radians(5.0))
    turned = room["tilt"] - room["bore_tilt"]
    np.testing.assert_allclose(ours["shaft"]["tilt"].sel(bearing=["N", "N2"]), turned, rtol=1e-5,
                               atol=1e-9)  # fmt: skip
    for bearing in ("N", "N2"):
        films = [one["journal"][bearing].to_dataset() for one in (ours, theirs)]
        assert all(bool(one["converged"].all()) for one in films)
        given_ = ours["reduction"][bearing]["tilt"].values
        # the film's axes: down, then left
        np.testing.assert_allclose(
            films[0]["tilt"], np.stack([-given_[:, 2], given_[:, 1]], axis=1)
        )
        assert abs(films[0]["minimum_film"].values - films[1]["minimum_film"].values).max() > 1e-7
        force = {"rtol": 1e-5, "atol": 1.0}  # determinate: the same loads
        np.testing.assert_allclose(
            *(one["shaft"]["force"].sel(bearing=bearing) for one in (ours, theirs)), **force
        )


def test_a_resolved_scene_knows_the_file_of_its_frame(tmp_path):
    path = written(tmp_path)
    scene = read_scene(path)
    told = scene.model_dump(mode="json", exclude_none=True)
    frame = told["shaft"]["two_point"]["beam"]["frame"]
    assert len(frame["sha256"]) == 64
    assert frame["file"] == str(tmp_path / "parts" / "frame.csv")
    assert make_scene(told).shaft == scene.shaft
    np.savetxt(tmp_path / "parts" / "frame.csv", 2 * cantilever(), delimiter=",")
    with pytest.raises(InputError, match="has changed since"):
        make_scene(told)
    assert "FrameMatrix" in json_schema()["$defs"]


def test_a_housing_of_a_support_is_found_beside_the_scene(tmp_path):
    np.save(tmp_path / "foot.npy", 1e10 * np.eye(6))
    stated = 'supports = [{ housing = { file = "foot.npy" } }, {}]\n[shaft.two_point.beam.frame]'
    path = written(tmp_path)
    path.write_text(SCENE.replace("[shaft.two_point.beam.frame]", stated), encoding="utf-8")
    support = read_scene(path).shaft.two_point.beam.supports[0]
    assert support.housing.file == str(tmp_path / "foot.npy")
    np.testing.assert_allclose(support.housing_compliance, 1e-10 * np.eye(6))


def test_films_under_the_shaft_stand_on_the_frame(tmp_path):
    """A film that takes the moment tilts under it by the shaft's slope less that of its bore."""
    np.save(tmp_path / "frame.npy", cantilever())
    beam = STEEL | {
        "frame": {"file": str(tmp_path / "frame.npy"), "form": "compliance"},
        "supports": [{"radial": 5e9}, {"stiffness": "journal", "takes_moment": True}],
    }
    scene = make_scene(
        {"name": "x", "results": ["journal.film"], "shaft": {"two_point": {"beam": beam}},
         "journal": {"tilt": True, "grid": [24, 8], "bearings": ["N2"]}}
    )  # fmt: skip
    series = {"loads": synthetic_case(12.0, 1, steps=6)}
    found = shaft_stage(scene, _Case, series).sel(bearing="N2")
    assert found["converged"].all()
    force, moment = (found[name].values.T.astype(float) for name in ("force", "moment"))
    speed = series["loads"]["speed"].values.astype(float)
    answer = equilibria(
        scene.journal.model_copy(update={"tilt": False}), force, speed, moment=moment
    )
    # the film's axes: down, then left
    ours = np.stack([-found["tilt"].sel(axis="z"), found["tilt"].sel(axis="y")], axis=1)
    np.testing.assert_allclose(answer.tilt, ours, rtol=1e-3, atol=1e-8)


def test_rotor_dynamics_refuse_a_frame_by_name(tmp_path):
    path = written(tmp_path)
    path.write_text(SCENE.replace("journal.film", "journal.dynamics"), encoding="utf-8")
    with pytest.raises(InputError, match=r"shaft\.two_point\.beam\.frame: rotor dynamics"):
        read_scene(path)
