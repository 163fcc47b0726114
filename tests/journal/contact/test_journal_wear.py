"""Worn bores: volume, contour and depth against closed forms, and what the film does afterwards."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp

import loadflow as lf
from loadflow.cube.hdf5 import read_variables
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Contact,
    Cycle,
    Film,
    GasMixture,
    Heat,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Reynolds,
    Wear,
    wear_bearing,
)
from loadflow.journal.wear.cycle import followed
from loadflow.journal.wear.worn_surface import Group, Surface
from loadflow.scene.cases import list_cases
from loadflow.scene.lifetime_shares import YEAR
from loadflow.scene.scene import make_scene
from loadflow.stages import wear as stage
from loadflow.tribology import Archard, AsperityContact, Fleischer, RunningIn, ShaftImprint

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
ROUGH = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
OIL, LOAD = Lubricant(0.03), 4e4
LAWS = [(Reynolds(), 0.0), (GasMixture(5e4), 1.5e5), (MassConserving(), 1e5)]


def film(law=None, edge=0.0, rough=ROUGH, **words):
    words = {"grid": (60, 8)} | words
    return Film(OIL, law, edge_pressure=edge, contact=Contact(rough, friction=0.1), **words)


def start(count=1e4, samples=11, load=LOAD, **words):
    time = np.linspace(0.0, 5.0, samples)  # asperities part below 3.5 rad/s
    return Cycle(time, np.tile((load, 0.0), (samples, 1)), time, count, **words)


def creeping(radius, distance, load, **words):
    """Turns so slowly that asperities carry all: the distance is that of the whole life."""
    return Cycle(
        [0.0, 1.0], [(load, 0.0)] * 2, [1e-6, 1e-6], distance / (1e-6 * radius),
        in_motion=False, **words,
    )  # fmt: skip


@pytest.mark.parametrize("relative_clearance", [5e-4, 2e-3])
def test_a_smooth_shaft_wears_its_imprint(relative_clearance):
    """Archard with clearance c: d' = k F/(R B (φ + sin φ cos φ)), cos φ = c/(c + d)."""
    load, radius, width, k, distance = 100e3, 0.2, 0.25, 1e-14, 5e3
    bearing = JournalBearing(2 * radius, width, relative_clearance)
    c = bearing.clearance
    smooth = AsperityContact(roughness=0.004 * c, contact_modulus=115e9, factor=1e-2)
    wear = Wear(Archard(k), step=0.5, renewal=10.0, max_renewals=1000)
    found = wear_bearing(
        bearing, [creeping(radius, distance, load)], film(rough=smooth, grid=(36, 4)), wear
    )

    def sinks(s, depth):
        angle = np.arccos(c / (c + max(depth[0], 1e-10)))
        return k * load / (radius * width * (angle + np.sin(angle) * np.cos(angle)))

    deepest = solve_ivp(sinks, (0.0, distance), [1e-10], rtol=1e-8, atol=1e-13).y[0, -1]
    imprint = ShaftImprint(largest_depth=deepest, clearance=c)
    assert found.depth.max() == pytest.approx(deepest, rel=0.005)
    assert found.depth[:, 0] == pytest.approx(imprint.depth(found.angle), abs=0.01 * deepest)
    assert found.volume == pytest.approx(imprint.volume(radius, width), rel=0.005)


@pytest.mark.parametrize("law", [Archard(1e-16), Fleischer(1e15)], ids=["Archard", "Fleischer"])
def test_volume_is_that_of_the_normal_force(law):
    found = wear_bearing(BEARING, [start()], film(), Wear(law, renewal=2.0))
    assert found.volume == pytest.approx(1e-16 * found.work, rel=1e-10)
    assert found.residual < 1e-9
    assert found.converged
    assert found.history["life"][-1] == 1.0
    again = found.depth.sum() * 2 * np.pi / 720 * BEARING.radius * BEARING.width
    assert found.volume == pytest.approx(again, rel=1e-12)
    # asperities are pressed by more than the load along it, by 4/π at most
    slid = 1e4 * found.history["contact_energy"][:, 0].values / 0.1
    assert slid.min() * 0.99 < found.work < slid.max() * 1.01


def test_two_halves_of_a_life_make_the_whole():
    wear = Wear(Archard(1e-16), step=0.05, renewal=0.5)
    whole = wear_bearing(BEARING, [start(2e3)], film(), wear)
    half = wear_bearing(BEARING, [start(1e3)], film(), wear)
    rest = wear_bearing(BEARING, [start(1e3)], film(), wear, worn=half.depth)
    assert rest.volume == pytest.approx(whole.volume, rel=0.1)
    assert half.volume < 0.9 * whole.volume


@pytest.mark.parametrize(("law", "edge"), LAWS, ids=lambda v: getattr(v, "kind", None))
def test_wear_deeper_than_the_film_leaves_a_film(law, edge):
    """60 µm off where the film has 8 µm: the shaft lies at ε = 1.6, in less contact.

    The imprint of the shaft itself has no wedge, and little film; the starts that follow give it
    one.
    """
    deep = ShaftImprint(largest_depth=60e-6, clearance=BEARING.clearance)
    worn = deep.depth(2 * np.pi / 720 * np.arange(720))[:, None]
    surface, wear = film(law, edge, grid=(90, 6)), Wear(Archard(3e-16), renewal=1.0)
    found = wear_bearing(BEARING, [start(1e4)], surface, wear, worn=worn)
    assert found.depth.max() > 60e-6
    assert found.history.sizes["renewal"] > 2  # films of the bore as it goes on to wear
    speeds = np.array([0.0, 0.1, 10.0])
    after = found.bearing.equilibrium((LOAD, 0.0), speeds, found.film)
    new = BEARING.equilibrium((LOAD, 0.0), speeds, surface)
    assert after.converged.all()
    assert (after.eccentricity_ratio > 1.5).all()
    assert (after.minimum_film > 0).all()
    assert after.contact_share[0] == pytest.approx(1.0, abs=1e-6)
    # it fits its bore: at low speed more of the load floats; at high speed the film is thinner
    assert after.contact_share[1] < 0.5 * new.contact_share[1]
    assert after.minimum_film[2] < new.minimum_film[2]
    assert after.friction_power[1] < new.friction_power[1] < after.friction_power[2]


def test_starts_in_motion_press_less_as_the_bore_wears():
    surface, wear = film(GasMixture(5e4), 1.5e5, grid=(48, 6)), Wear(Archard(1e-16), renewal=4.0)
    found = wear_bearing(BEARING, [start(8e4)], surface, wear)
    history = found.history.isel(cycle=0)
    assert history["contact_pressure"][-1] < 0.6 * history["contact_pressure"][0]
    assert history["minimum_film"][-1] > 1.3 * history["minimum_film"][0]
    assert (np.diff(history["depth"]) > 0).all()
    # where the bore conforms, the wedge of a start is lost: asperities take part for longer
    assert history["contact_energy"].max() > 1.5 * history["contact_energy"][0]


def test_a_start_of_few_samples_rubs_as_one_of_many():
    """One step for each sample has 167 J in place of 244: the film lets the asperities go late."""
    surface = film(GasMixture(5e4), 1.5e5)

    def energy(samples):
        time = np.linspace(0.0, 2.0, samples)
        force = np.stack([np.full(samples, LOAD), 1e4 * time], axis=1)
        cycle = Cycle(time, force, 5.0 * time)
        finer, found = followed(BEARING, cycle, surface)
        return finer.seconds @ found["contact_power"]

    assert energy(21) == pytest.approx(energy(161), rel=0.02)


def test_wear_counts_what_touches_between_two_samples():
    """A stop that rubs after the last sample that turns: the samples alone have an eighth of it."""
    surface = film(GasMixture(5e4), 1.5e5)

    def stop(samples):
        time = np.linspace(0.0, 10.0, samples)
        return Cycle(time, np.tile((LOAD, 0.0), (samples, 1)), 10.0 - time, 10.0)

    fine, few = stop(577), stop(13)
    path = BEARING.orbit(fine.time, force=fine.force, speed=fine.speed, film=surface)
    slid = np.hypot(*path["contact_force"].values.T) * np.abs(fine.speed) * BEARING.radius
    at_samples = np.trapezoid(slid[::48], few.time)
    found = wear_bearing(BEARING, [few], surface, Wear(Archard(1e-17)))
    assert found.work / fine.count == pytest.approx(np.trapezoid(slid, fine.time), rel=0.015)
    assert at_samples < 0.15 * found.work / fine.count
    touching = fine.seconds[(path["contact_share"].values > 1e-3) & (fine.speed > 0)].sum()
    time = found.history["contact_time"].isel(cycle=0, renewal=0)
    assert time == pytest.approx(touching, abs=10.0 / 192)


def test_a_cycle_without_contact_or_without_speed_settles_at_once(monkeypatch):
    asked, orbit = [], JournalBearing.orbit

    def counting(self, time, **given):
        asked.append(time.size)
        return orbit(self, time, **given)

    monkeypatch.setattr(JournalBearing, "orbit", counting)
    afloat = Cycle([0.0, 1.0, 2.0], [(LOAD, 0.0)] * 3, [300.0] * 3)
    still = Cycle([0.0, 1.0, 2.0], [(LOAD, 0.0)] * 3, [0.0] * 3)
    for cycle in (afloat, still):
        finer, found = followed(BEARING, cycle, film(GasMixture(5e4), 1.5e5))
        assert (found["contact_power"] == 0.0).all()
        assert finer.time.size == 5
    assert asked == [3, 5] * 2


def test_a_cycle_that_rubs_evenly_or_hardly_at_all_settles_at_once(recwarn):
    """Asperities without friction wear, too; others that carry next to nothing do not."""
    surface = film(GasMixture(5e4), 1.5e5)
    smooth = replace(surface, contact=Contact(ROUGH, friction=0.0))
    pressed = Cycle([0.0, 1.0, 2.0], [(LOAD, 0.0)] * 3, [0.5] * 3)
    swinging = Cycle(
        np.arange(7.0), [(LOAD * (1 + 0.3 * (-1) ** k), 0.0) for k in range(7)], [5.0] * 7
    )
    steady, found = followed(BEARING, pressed, smooth)
    assert steady.time.size == 5
    assert found["contact_share"].min() > 0.01
    finer, found = followed(BEARING, swinging, surface)
    assert finer.time.size == 13
    assert 0.0 < found["contact_share"].max() < 1e-6
    assert not any("samples that are closer" in str(told.message) for told in recwarn)


def test_a_surface_runs_in_first_fast_then_slowly():
    running_in = RunningIn(
        initial_roughness=0.5e-6, final_roughness=0.2e-6, depth=0.2e-6, excess=5.0
    )
    law, cycles = Archard(2e-17), [start(2e4)]
    steady = wear_bearing(BEARING, cycles, film(), Wear(law, renewal=2.0))
    found = wear_bearing(BEARING, cycles, film(), Wear(law, running_in, renewal=2.0))
    left = found.film.contact.asperities
    assert found.volume > steady.volume
    assert 0.2e-6 < left.roughness < 0.4e-6
    assert left.factor == pytest.approx(ROUGH.factor * (left.roughness / 0.5e-6) ** 0.5)
    # smoother surfaces part at a lower speed
    assert found.history["contact_speed"][-1, 0] < found.history["contact_speed"][0, 0]


def test_a_tilted_shaft_wears_the_edge():
    count = 5
    tilted = Cycle(
        np.linspace(0.0, 1.0, count), np.tile((LOAD, 0.0), (count, 1)), np.full(count, 0.1), 1e4,
        in_motion=False, tilt=np.tile((0.0, 5e-5), (count, 1)),
    )  # fmt: skip
    wear = Wear(Archard(1e-16), across=12, around=360, renewal=4.0)
    found = wear_bearing(BEARING, [tilted], film(), wear)
    across = found.depth.max(axis=0)
    assert across.argmax() == 11  # θ_y > 0 lowers the end z > 0
    assert across[0] < 0.1 * across[-1]
    level = found.bearing.equilibrium((LOAD, 0.0), 0.1, found.film, tilt=(0.0, 5e-5))
    before = BEARING.equilibrium((LOAD, 0.0), 0.1, film(), tilt=(0.0, 5e-5))
    assert level.contact_pressure < before.contact_pressure


@pytest.mark.parametrize("roughness", [1e-7, 0.56e-6])
def test_a_tilted_shaft_finds_the_asperities_that_carry_it_from_far_beside_them(roughness):
    """A main bearing of 2 m: hundreds of roughnesses off."""
    main = JournalBearing(diameter=2.0, width=1.4, relative_clearance=1.1e-3)
    surface, draw = Surface(main, 720, 8), np.random.default_rng(5)
    tips = AsperityContact(roughness=roughness, contact_modulus=46.5e9, factor=1e-3)
    for _ in range(20):
        size, way = 10 ** draw.uniform(-2, 6), draw.normal(scale=0.3, size=2)
        force, place = (np.array([np.cos(angle), np.sin(angle)]) for angle in way)
        line = draw.normal(scale=(2e-4, 2e-4, 1e-4, 1e-4))
        group = Group(size * force, 0.95 * main.clearance * place, 1.0, line)
        pressed, missed, _ = surface.pressed([group], Contact(tips, 0.1), np.zeros((720, 8)))
        across = np.stack([np.cos(surface.angle), np.sin(surface.angle)]) @ pressed.sum(axis=1)
        assert surface.area * across == pytest.approx(size * force, abs=2e-9 * size)
        assert missed < 1e-9


def test_a_shaft_that_is_asked_for_again_lies_where_it_was_found():
    """What makes a life of many small steps short: each begins where the one before ended."""
    main = JournalBearing(diameter=2.0, width=1.4, relative_clearance=1.1e-3)
    surface, depth = Surface(main, 720, 8), np.zeros((720, 8))
    rough = Contact(AsperityContact(roughness=0.56e-6, contact_modulus=46.5e9, factor=1e-3), 0.1)
    far = Group(
        np.array([1e5, 2e4]), 0.95 * main.clearance * np.array([1.0, 0.2]), 1.0, np.zeros(4)
    )
    before, _, [found] = surface.pressed([far], rough, depth)
    assert np.hypot(*(found.place - far.place)) > 1e-6
    after, _, [again] = surface.pressed([found], rough, depth)
    assert np.array_equal(again.place, found.place)
    assert np.array_equal(after, before)


@pytest.mark.parametrize(
    ("tilt", "law", "apart"),
    [
        # on twice the cells "reduced" has 2.7 % less depth and 3.4 % less volume
        pytest.param((0.0, 0.0), Archard(2e-15), (0.05, 0.06, 0.1), marks=pytest.mark.slow),
        ((0.0, 1e-5), Archard(1e-16), (0.025, 0.03, 0.08)),
    ],
    ids=["deep", "tilted"],
)
def test_few_points_across_wear_as_the_grid_does(tilt, law, apart):
    """Deep is ten times the film of a new bore."""
    wear = Wear(law, renewal=2.0, step=0.5, across=9)
    cycles = [start(tilt=np.tile(tilt, (11, 1)))]
    few, fine = (
        wear_bearing(
            BEARING,
            cycles,
            film(GasMixture(5e4), 1.5e5, grid=(96, 16), inlet=None, rung=rung),
            wear,
        )
        for rung in ("reduced", "grid")
    )
    assert few.film.rung == "reduced"
    assert few.depth.max() == pytest.approx(fine.depth.max(), rel=apart[0])
    assert few.volume == pytest.approx(fine.volume, rel=apart[1])
    # that of one renewal follows the cells of a deep contour: 12 % on these, 2 % on twice as many
    energies = (one.history["contact_energy"][:, 0].mean() for one in (few, fine))
    assert np.divide(*energies) == pytest.approx(1.0, abs=apart[2])


def test_no_contact_wears_nothing():
    fast = Cycle([0.0, 1.0], [(LOAD, 0.0)] * 2, [100.0, 100.0], 1e6, in_motion=False)
    found = wear_bearing(BEARING, [fast], film(), Wear(Archard(1e-15)))
    assert not found.depth.any()
    assert found.bearing == BEARING
    assert found.volume == found.work == 0.0


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"film": Film(OIL)}, "contact"),
        ({"film": Film(heat=Heat(), contact=Contact(ROUGH))}, "heat"),
        ({"bearing": JournalBearing(0.2, 0.1, 1e-3, shape=Lobes(2))}, "shape"),
        ({"film": film(shell=LocalShell(1e-14))}, "shell"),
        ({"cycles": []}, "cycles"),
        ({"worn": [[1e-6]]}, "worn"),
        ({"wear": Wear(Archard(1e-16), RunningIn(
            initial_roughness=1e-6, final_roughness=0.5e-6, depth=1e-6))}, "initial_roughness"),
    ],
)  # fmt: skip
def test_what_cannot_wear_is_named(change, named):
    asked = {"bearing": BEARING, "cycles": [start()], "film": film(), "wear": Wear(Archard(1e-16))}
    with pytest.raises(InputError, match=named):
        wear_bearing(**asked | change)


def test_bad_cycles_and_an_endless_life_are_told():
    with pytest.raises(InputError, match="force"):
        Cycle([0.0, 1.0], [1.0, 2.0], [0.0, 0.0])
    with pytest.raises(InputError, match="increasing"):
        Cycle([1.0, 0.0], [(1.0, 2.0)] * 2, [0.0, 0.0])
    with pytest.raises(InputError, match="in_motion"):
        replace(start(in_motion=False), start=(0.0, 0.0))
    at_rest = start(1e6, in_motion=False)
    with pytest.raises(SolverError, match="after 2 films"):
        wear_bearing(BEARING, [at_rest], film(), Wear(Archard(1e-15), max_renewals=2))


def test_a_cycle_that_finds_no_first_place_once_worn_is_named_once(monkeypatch):
    found = [BEARING.equilibrium([(LOAD, 0.0)], [5.0], film())]

    def equilibrium(*given, **words):
        if not found:
            raise SolverError("load 0: none")
        return found.pop()

    monkeypatch.setattr(JournalBearing, "equilibrium", equilibrium)
    with pytest.raises(SolverError, match=r"^cycle: load 0: none$"):
        wear_bearing(BEARING, [start(start=(0.0, 0.0))], film(), Wear(Archard(1e-15)))


# --- in a scene -------------------------------------------------------------------------------

SCENE = {
    "name": "life",
    "results": ["journal.film", "journal.wear"],
    "accuracy": "given",
    "loads": {"dlc": "3.1", "wind_speeds": [16.0], "rung": "tables", "step": 0.1,
              "duration": 75.0},
    "shaft": {"two_point": {}},
    "journal": {
        "bearings": ["N"], "motion": "transient", "rung": "reduced", "grid": [60, 8],
        "contact": {"friction": 0.15, "asperities": {
            "roughness": 0.56e-6, "contact_modulus": 46.5e9, "factor": 1e-3}},
    },
    "wear": {"law": {"coefficient": 1e-16}, "samples": 60, "renewal": 2.0, "events": 1e4},
}  # fmt: skip


def changed(**sections):
    return make_scene(SCENE | {name: SCENE.get(name, {}) | keys for name, keys in sections.items()})


def test_a_scene_wears_its_bearings_over_a_lifetime_of_starts(tmp_path):
    run = lf.run(changed(), out=tmp_path)
    assert run.failures == {}
    assert run.flagged == {}
    worn = run.tree["wear"]["N"].to_dataset().load()
    assert worn["count"].values == pytest.approx([1e4])
    assert 0.1e-6 < worn["depth_of_bore"].max() < 10e-6
    down = np.degrees(worn["angle"].values[worn["depth_of_bore"].values[:, 0].argmax()])
    assert min(down, 360 - down) < 15.0
    assert worn.attrs["volume"] == pytest.approx(1e-16 * worn.attrs["work"], rel=1e-10)
    contact = run.tree["journal"].to_dataset()["contact_time"].values.ravel()
    assert worn["contact_time"].values[0] == pytest.approx(contact, rel=0.25)
    assert "Worn bores after the life" in run.report.read_text(encoding="utf-8")


@pytest.mark.slow
def test_little_wear_of_a_scene_is_that_of_its_film_by_hand(tmp_path):
    """Asperities by a quadrature of their own, at all samples of the start, from its places."""
    file, wear = tmp_path / "life.toml", {"law": {"coefficient": 1e-21}}
    file.write_text(changed(wear=wear).to_toml(), encoding="utf-8")
    scene = lf.read_scene(file)
    run = lf.run(scene, out=tmp_path)
    worn = run.tree["wear"]["N"].to_dataset().load()
    (path,) = (run.report.parent / "journal").glob("*.h5")
    film = read_variables(path, ("time", "speed", "eccentricity"), "N")
    bore = scene.journal.at("N").geometry
    heights, weights = np.polynomial.legendre.leggauss(200)

    def pressure(gap, roughness=0.56e-6, scale=1e-3 * 46.5e9, tail=12.0):
        low = np.minimum(gap / roughness, tail)[..., None]
        tips = low + 0.5 * (tail - low) * (1.0 + heights)
        height = (tips - low) ** 2.5 * np.exp(-0.5 * tips**2) / np.sqrt(2.0 * np.pi)
        return scale * (0.5 * (tail - low)[..., 0]) * (height @ weights)

    angle = 2.0 * np.pi * np.arange(3600) / 3600
    way, slid = np.stack([np.cos(angle), np.sin(angle)]), np.abs(film["speed"].values) * bore.radius
    pressed = np.stack([pressure(bore.clearance - e @ way) for e in film["eccentricity"].values])
    work = np.trapezoid(pressed * slid[:, None], film["time"].values, axis=0)  # N/m of one start
    assert worn["depth_of_bore"].max() == pytest.approx(1e-21 * 1e4 * work.max(), rel=0.01)
    area = 2.0 * np.pi / angle.size * bore.radius * bore.width
    assert worn.attrs["work"] == pytest.approx(1e4 * work.sum() * area, rel=0.01)


@pytest.mark.parametrize(
    ("sections", "named"),
    [
        ({"wear": {"law": None}}, "wear.law"),
        ({"journal": {"contact": None}}, "journal.contact"),
        ({"journal": {"tilt": True, "motion": "quasi-static"}}, "journal.tilt"),
        ({"wear": {"law": {"coefficient": -1.0}}}, "coefficient"),
    ],
)
def test_a_scene_that_cannot_wear_is_refused(sections, named):
    with pytest.raises(InputError, match=named):
        changed(**sections)


def production(rubs, power, step=0.1):
    """Film, loads and shaft of a load case that touches where it `rubs`."""
    count = len(rubs)
    time, ones = step * np.arange(count), np.ones(count)
    film = xr.Dataset(
        {
            "time": ("sample", time),
            "speed": ("sample", 0.5 * ones),
            "contact_share": ("sample", 0.5 * np.array(rubs)),
            "contact_power": ("sample", np.array(power, dtype=float)),
            "eccentricity": (("sample", "component"), np.full((count, 2), np.nan)),
        }
    )
    loads = xr.Dataset({"speed": ("time", 0.5 * ones)}, {"time": time})
    down = np.zeros((1, 3, count))
    down[:, 2] = -2e6
    shaft = {"force": (("bearing", "axis", "time"), down)}
    return film, loads, xr.Dataset(shaft, {"bearing": ["N"], "time": time})


def test_spells_of_contact_that_rub_most_stand_for_all_of_a_load_case():
    scene = changed(wear={"samples": 10})
    rubs = np.isin(np.arange(40), [5, 6, 20, 21, 22, 30])
    power = np.where(rubs, 1.0, 0.0) + 2.0 * (np.arange(40) == 21)
    film, loads, shaft = production(rubs, power)
    for sample, place in ((19, (1e-4, 2e-5)), (4, (2e-4, 1e-5))):
        film["eccentricity"].values[sample] = place
    asked = scene.journal.at("N"), film, loads, shaft.sel(bearing="N")
    first, second = stage.cycles_of("1.2", scene, *asked)
    np.testing.assert_allclose(first.time, 0.1 * np.arange(19, 24))  # the hardest, 5 J
    np.testing.assert_allclose(second.time, 0.1 * np.arange(4, 8))  # 2 J; of 1 J there is no room
    assert first.count == second.count == pytest.approx(8.0 / 7.0)
    assert first.in_motion
    assert first.start.tolist() == [1e-4, 2e-5]  # where the shaft was then
    assert second.start.tolist() == [2e-4, 1e-5]
    (whole,) = stage.cycles_of("3.1", scene, *asked)  # a start is one from first to last
    assert whole.time[0] == pytest.approx(0.4)
    assert whole.time[-1] > 3.0
    assert whole.start.tolist() == [2e-4, 1e-5]
    film["eccentricity"].values[4] = np.nan
    (whole,) = stage.cycles_of("3.1", scene, *asked)
    assert whole.start is None
    still = changed(journal={"motion": "quasi-static"})
    at_rest = still.journal.at("N"), *asked[1:]
    assert stage.cycles_of("1.2", still, *at_rest) == []
    film["eccentricity"].values[4] = 1e-4, 2e-5
    (whole,) = stage.cycles_of("3.1", still, *at_rest)
    assert whole.start is None


def test_a_spell_that_begins_where_its_shaft_was_rubs_as_along_the_whole_path():
    """From rest it touches long before squeeze lets it: 20 times as much."""
    bearing = JournalBearing(diameter=2.0, width=1.5, relative_clearance=1e-3)
    tips = AsperityContact(roughness=2e-6, contact_modulus=46e9, factor=1e-3)
    oil = film(GasMixture(5e4), 1.5e5, grid=(96, 16), inlet=None, rung="reduced")
    oil = replace(oil, lubricant=Lubricant(0.03), contact=Contact(tips))
    time = np.arange(0.0, 20.0, 0.05)
    force = np.zeros((time.size, 2))
    force[:, 0] = 2e6 + 12e6 * np.exp(-(((time - 15.0) / 0.3) ** 2))
    speed = np.full(time.size, 0.2)
    path = bearing.orbit(time, force, speed, oil)
    touches = np.flatnonzero(path["contact_share"].values > 1e-3)
    some = slice(touches[0] - 1, touches[-1] + 2)
    spell = Cycle(time[some], force[some], speed[some])
    place = path["eccentricity"].values[some.start]
    whole = spell.seconds @ path["contact_power"].values[some]

    def energy(cycle, renewal):
        found = wear_bearing(bearing, [cycle], oil, Wear(Archard(1e-17)))
        return float(found.history["contact_energy"][renewal, 0])

    placed = replace(spell, start=place)
    assert energy(placed, 0) == pytest.approx(whole, rel=0.3)  # but for gas on its way
    assert energy(spell, 0) > 5.0 * whole
    worn = replace(placed, count=1e3)
    found = wear_bearing(bearing, [worn], oil, Wear(Archard(1e-17)))
    assert found.depth.max() > 0
    assert 0.1 * whole < float(found.history["contact_energy"][-1, 0]) < 2.0 * whole


@pytest.mark.parametrize("rung", ["reduced", "grid"])
def test_power_production_wears_with_its_share_of_the_lifetime(rung, monkeypatch):
    """On the rung of the film: what touches in 1.2 comes as often as its series fits the life."""
    asked = []
    monkeypatch.setattr(
        stage, "wear_bearing", lambda *given: asked.append(given) or wear_bearing(*given)
    )
    scene = changed(
        loads={"dlc": ["1.2", "3.1"], "wind_speeds": [16.0], "seeds": 1, "duration": 4.0},
        wear={"law": {"coefficient": 1e-19}, "counts": {"3.1": 0.0}},
        journal={"rung": rung},
        lifetime={"per_year": {"3.1": 100.0}, "years": 20.0},
    )
    cases = list_cases(scene)
    rubs = np.isin(np.arange(40), range(5, 9))
    film, loads, shaft = production(rubs, np.where(rubs, 1.0, 0.0))
    film["speed"][:] = loads["speed"][:] = 0.01  # so slow that it does touch
    tree = xr.DataTree.from_dict({"N": film})
    found = stage.wear(
        scene,
        cases,
        {case.name: {"journal": tree, "loads": loads, "shaft": shaft} for case in cases},
    )["N"].to_dataset()
    assert asked[0][2].rung == rung
    assert found["production"].values.tolist() == [True]
    assert found["case"].values.tolist() == [cases[0].name]
    share = 1.0 - 100.0 * 4.0 / YEAR
    operating = float(found["count"].item()) * 4.0 / (20.0 * YEAR * share)
    assert 0.8 < operating < 1.0  # the wind is between cut-in and cut-out
    assert found["depth_of_bore"].max() > 0
