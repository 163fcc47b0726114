"""Results that show themselves: figures, tables for notebooks, rooms, the accessor of cubes."""

import inspect
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pint
import pytest
import xarray as xr
from scipy.integrate import trapezoid
from synthetic import case

import loadflow as lf
from loadflow import plots
from loadflow.cube import make_cube
from loadflow.errors import InputError
from loadflow.journal import (
    ConicalBearing,
    ConicalPair,
    Contact,
    Cycle,
    DoubleThrustBearing,
    FilmHeat,
    Heat,
    JournalBearing,
    LocalShell,
    Lubricant,
    MassConserving,
    PadHeat,
    Reynolds,
    ThrustBearing,
    Wear,
    wear_bearing,
)
from loadflow.journal.film_model import Film
from loadflow.numerics.shown import Shown
from loadflow.quantities import FILM, ROLLING
from loadflow.reduction import damage_equivalent_load
from loadflow.report import figures
from loadflow.rolling import (
    BallBearing,
    FlexibleRings,
    FrictionOptions,
    RingBeam,
    RingSection,
    RingSections,
    RollerBearing,
    SlewingBearing,
    Transient,
    axial_expansion,
    edge_contact,
)
from loadflow.rolling.friction import balanced_temperature
from loadflow.studies.statistics import statistic_records
from loadflow.tribology import Archard, AsperityContact, hertz_line, hertz_point, lubricant

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
OIL = Lubricant(0.05)
ROLLERS = RollerBearing(
    rollers=14, roller_diameter=11e-3, roller_length=11e-3, pitch_diameter=60.5e-3
)
BALLS = BallBearing(balls=9, ball_diameter=11e-3, pitch_diameter=46e-3, groove_radius=0.52 * 11e-3)
GREASED = FrictionOptions(oil=lubricant("lgwm-2"), temperature=313.15)
RING = SlewingBearing(
    balls=40, rows=2, ball_diameter=0.04, pitch_diameter=1.0, groove_radius=0.0208,
    contact_angle=0.785,
)  # fmt: skip


@pytest.fixture(scope="module")
def field():
    return BEARING.pressure((7e-5, 3e-5), 50.0, OIL, grid=(36, 8))


@pytest.fixture(scope="module")
def speeds():
    return BEARING.equilibrium((5e3, 0.0), [40.0, 60.0, 90.0], OIL, grid=(36, 8))


# --- figures --------------------------------------------------------------------------------------


def test_the_gap_of_a_cylinder_is_the_closed_form(field):
    closed = BEARING.clearance - 7e-5 * np.cos(field.angle) - 3e-5 * np.sin(field.angle)
    # within a cell of up to 20°, where the gap is wide, it is curved
    assert np.allclose(field.gap, closed[:, None], rtol=1e-2)
    assert field.to_dataset()["gap"].attrs == FILM["gap"].attributes


def test_a_field_draws_pressure_and_gap_as_they_are(field):
    drawing = field.plot()
    unwrapped, around, gap = (axis for axis in drawing.axes if axis.get_label() != "<colorbar>")
    mesh = unwrapped.collections[0]
    assert mesh.get_array().max() == pytest.approx(field.pressure.max() / 1e6)
    middle = np.argmin(np.abs(field.z))
    drawn = around.lines[0].get_ydata()
    assert drawn.max() == pytest.approx(field.pressure[:, middle].max() / 1e6)
    assert gap.lines[0].get_ydata().min() == pytest.approx(field.gap[:, middle].min() * 1e6)


def test_equilibria_draw_their_coefficients_over_speed(speeds):
    left, right = speeds.plot().axes
    names = [line.get_label() for line in left.lines]
    assert names == ["Kxx", "Kxy", "Kyx", "Kyy"]
    assert np.allclose(left.lines[0].get_ydata(), speeds.stiffness[:, 0, 0] / 1e9)
    assert np.allclose(right.lines[3].get_ydata(), speeds.damping[:, 1, 1] / 1e9)


def test_loads_draw_their_places_in_the_clearance_circle():
    state = BEARING.equilibrium([[5e3, 0.0], [8e3, 0.0]], 50.0, OIL, grid=(36, 8))
    axis = state.plot().axes[0]
    places = axis.collections[0].get_offsets()
    assert np.allclose(np.hypot(*places.T), state.eccentricity_ratio)


def test_an_orbit_lies_in_the_circle_of_its_clearance():
    time = np.linspace(0, 0.05, 20)
    path = BEARING.orbit(time, [[5e3, 0.0]] * 20, 100.0, Film(OIL, rung="reduced", inlet=None))
    places = plots.orbit(path).axes[0].collections[0].get_offsets()
    assert np.allclose(np.hypot(*places.T), path["eccentricity_ratio"])


def test_a_stribeck_curve_is_drawn_with_its_minimum():
    about = {"units": "1", "long_name": "x"}
    curve = xr.Dataset(
        {"friction_coefficient": ("speed", [0.1, 0.01, 0.02], about),
         "contact_share": ("speed", [0.9, 0.1, 0.0], about), "minimum_speed": 1.0},
        {"speed": [0.1, 1.0, 10.0]},
    )  # fmt: skip
    axis, share = plots.stribeck(curve).axes
    assert axis.lines[1].get_xdata()[0] == 1.0
    assert share.lines[0].get_ydata()[0] == 0.9


def test_two_speeds_at_least():
    with pytest.raises(InputError, match="two speeds"):
        plots.coefficients([1.0], np.ones((1, 2, 2)), np.ones((1, 2, 2)))


@pytest.mark.parametrize("bearing", [ROLLERS, BALLS, RING])
def test_forces_on_elements_are_drawn_at_their_azimuth(bearing):
    force = (2e3, 1e3, 0.0) if bearing is not RING else (2e4, 1e4, 5e4)
    state = bearing.equilibrium(force=[force, force])
    axis = state.plot(1).axes[0]
    theta, drawn = axis.lines[0].get_data()
    groups = state.element_forces[1].reshape(-1, theta.size - 1)
    assert np.allclose(drawn[:-1], groups[0] / 1e3)
    hardest = theta[np.argmax(drawn)]
    if bearing is not RING:
        apart = np.angle(np.exp(1j * (hardest - np.arctan2(1e3, 2e3))))
        assert abs(apart) <= np.pi / (theta.size - 1) + 1e-9


@pytest.mark.parametrize("bearing", [ROLLERS, BALLS])
def test_pressures_of_elements_are_those_of_hertz(bearing):
    state = bearing.equilibrium(force=(2e3, 0.0, 0.0))
    assert state.element_pressure.max() == pytest.approx(float(state.maximum_pressure))
    exponent = {3: 1 / 3, 2: 1 / 2}[bearing.static_exponent]
    force = state.contact_forces.max(axis=0)
    k, other = np.argsort(force)[-1], np.argsort(force)[-3]
    ratio = state.element_pressure[other] / state.element_pressure[k]
    assert ratio == pytest.approx((force[other] / force[k]) ** exponent)
    drawn = state.plot(what="pressure").axes[0].lines[0].get_ydata()
    assert np.allclose(drawn[:-1], state.element_pressure / 1e6)


def test_bent_rings_are_drawn_by_ring_and_row_in_micrometres():
    bearing = RollerBearing(
        rollers=24, roller_diameter=0.04, roller_length=0.05, pitch_diameter=0.5, clearance=5e-5
    )
    ring = RingBeam(section=RingSection.rectangle(0.06, 0.03), radius=0.29)
    bent = bearing.equilibrium((2e5, 0, 0), rings=FlexibleRings(outer=ring))
    axis = bent.plot(what="rings").axes[0]
    line = axis.lines[0]
    assert line.get_label() == "outer ring, row 1"
    outward = bent.ring_displacement("outer")[0, :, 0]
    assert line.get_ydata()[:-1] == pytest.approx(1e6 * outward)
    assert outward[0] > 0 > outward[6]  # an oval: out under the load, in beside it
    assert axis.get_ylim()[0] < 1e6 * outward.min()
    with pytest.raises(InputError, match="both rings are rigid"):
        bearing.equilibrium((2e5, 0, 0)).plot(what="rings")


def test_the_report_draws_with_the_public_figures():
    forces = np.arange(16.0).reshape(2, 2, 4) * 1e3
    worst = xr.Dataset(
        {"ball_forces": (("row", "diagonal", "ball"), forces, {"units": "N"})},
        {"ball_angle": ("ball", np.arange(4) * np.pi / 2)},
    )
    left, right = figures.ball_ring(worst).axes
    assert [line.get_label() for line in left.lines] == ["diagonal 1", "diagonal 2"]
    assert np.allclose(right.lines[1].get_ydata()[:-1], forces[1, 1] / 1e3)


# --- tables for notebooks -------------------------------------------------------------------------


def test_a_result_shows_its_quantities_with_units(speeds, field):
    text = speeds._repr_html_()
    for name in ("minimum_film", "friction_power", "stiffness"):
        assert FILM[name].meaning in text
    assert ">µm<" in text
    assert ">l/min<" in text
    assert f"{float(speeds.friction_power[1]) / 1e3:.4g}" in text
    assert FILM["temperature"].meaning not in text  # a film without heat has none
    assert "<table" in field._repr_html_()


def test_rolling_bearings_and_pads_show_themselves_as_well():
    text = ROLLERS.equilibrium(force=(2e3, 0.0, 0.0))._repr_html_()
    assert ROLLING["maximum_pressure"].meaning in text
    assert ">MPa<" in text
    pads = ThrustBearing(
        pads=6, inner_radius=0.5, outer_radius=1.0, pad_angle=0.785, taper=1e-4, wedge=0.75
    )
    shown = pads.pressure(gap=1e-4, speed=10.0, film=Film(lubricant=OIL))._repr_html_()
    assert "minimum film thickness" in shown


def results():
    """One of each public class of results, by its name."""
    cone = ConicalBearing(half_angle=0.5, slant=(1.0, 1.3), clearance=2e-4)
    pair = ConicalPair(cone, cone, distance=1.0, clearance=2e-4)
    lands = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    collar = DoubleThrustBearing(lands, lands, play=4e-4)
    pads, thick = Film(OIL, grid=(20, 10)), Film(Lubricant(0.1), inlet=None, grid=(40, 10))
    warm = Film(None, heat=Heat(oil="iso-vg-68", inlet_temperature=313.15), grid=(36, 8))
    hot = Film(
        None,
        MassConserving(),
        edge_pressure=1e4,
        heat=FilmHeat("iso-vg-68", inlet_temperature=313.15),
        grid=(36, 8),
    )
    rings = RingSections(
        outer_outside=1.3, outer_inside=1.05, inner_outside=0.95, inner_inside=0.7, height=0.2
    )
    found = [
        BEARING.equilibrium((5e3, 0.0), [40.0, 60.0], OIL, grid=(36, 8)),
        BEARING.equilibrium((5e3, 0.0), 40.0, warm),
        BEARING.equilibrium((5e3, 0.0), 40.0, hot),
        BEARING.pressure((7e-5, 3e-5), 50.0, OIL, grid=(36, 8)),
        BEARING.pressure((7e-5, 3e-5), 50.0, hot),
        lands.equilibrium(1e6, 10.0, pads),
        lands.equilibrium(1e6, 10.0, Film(None, heat=PadHeat("iso-vg-68"), grid=(20, 10))),
        collar.equilibrium(1e6, 10.0, pads),
        cone.pressure((5e-5, 0.0, 0.0), 10.0, thick),
        pair.equilibrium((1e5, 0.0, 5e4), (0.0, 0.0), 1.0, thick),
        ROLLERS.equilibrium(force=(2e3, 0.0, 0.0)),
        ROLLERS.equilibrium(force=(2e3, 0.0, 0.0)).friction([5.0, 10.0, 20.0], GREASED),
        axial_expansion(RING, [5e4, 1e5], rings),
        edge_contact(ROLLERS, 2e3, cells=(24, 16), tolerance=1e-4),
        Transient(np.array([0.0, 0.1]), np.full((2, 5), 1e-5), np.array([0.0, 3e3]), 1e-9),
        hertz_point(50.0, 50.0, 25.0, [25.0, 30.0], force=100.0),
        hertz_line(100.0, 0.0, length=0.03, force=2e4),
        balanced_temperature(
            ROLLERS.equilibrium((2e3, 0.0, 0.0)), 20.0, GREASED, conductance=1.0, ambient=293.15
        ),
        worn_bore(),
    ]
    return {type(one).__name__: one for one in found}


def worn_bore():
    """A bore worn by starts under one load."""
    rough = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
    film = Film(Lubricant(0.03), Reynolds(), grid=(60, 8), contact=Contact(rough))
    turn = Cycle([0.0, 1.0], [(4e4, 0.0)] * 2, [0.5, 0.5], 1e3, in_motion=False)
    return wear_bearing(JournalBearing(0.2, 0.1, 1e-3), [turn], film, Wear(Archard(1e-17)))


def test_a_contact_is_drawn_over_its_ellipse_and_a_worn_bore_where_it_is_worn():
    contact = hertz_point(50.0, 50.0, 25.0, [25.0, 30.0], force=[100.0, 400.0])
    major, minor = contact.plot().axes[0].lines
    assert major.get_xdata().max() == pytest.approx(1e3 * contact.semi_axes[0][1])
    assert minor.get_ydata().max() == pytest.approx(contact.pressure[1] / 1e6)
    area = trapezoid(major.get_ydata(), major.get_xdata())  # of a half ellipse
    assert area == pytest.approx(np.pi / 2 * 1e3 * contact.semi_axes[0][1] * contact.pressure[1]
                                 / 1e6, rel=1e-3)  # fmt: skip
    worn = worn_bore()
    contour, way = worn.plot().axes[:2]
    assert contour.lines[0].get_ydata().max() == pytest.approx(1e6 * worn.deepest)
    deeper = np.column_stack([worn.depth, 2 * worn.depth])  # on one end
    wide = replace(worn, z=np.array([-0.02, 0.02]), depth=deeper).plot().axes[0].collections[0]
    assert wide.get_array().max() == pytest.approx(2e6 * worn.deepest)
    assert wide.get_array().shape == (2, worn.angle.size)
    assert way.lines[0].get_ydata()[-1] == pytest.approx(1e6 * worn.deepest, rel=1e-6)
    data = worn.to_dataset()
    assert float(data["depth_of_bore"].max()) == worn.deepest > 0


def classes_of_results():
    """Public classes that are named as results are, or show themselves, of all rooms."""
    rooms = [getattr(lf, name) for name in dir(lf) if inspect.ismodule(getattr(lf, name))]
    rooms.append(lf.rolling.friction)
    public = {one for room in rooms for one in vars_of(room) if inspect.isclass(one)}
    named = ("Result", "Equilibrium", "Field")
    return {
        one.__name__ for one in public
        if one.__module__.startswith("loadflow.") and not inspect.isabstract(one)
        and (issubclass(one, Shown) or one.__name__.endswith(named))
    }  # fmt: skip


def vars_of(room):
    return [getattr(room, name) for name in dir(room) if not name.startswith("_")]


BASES = {"PadResult"}  # what all bearings of pads answer; none answers it alone
WINDS = {"Field"}  # a field of wind, no result of a solver


def test_every_public_result_shows_draws_and_labels_itself():
    known = results()
    assert classes_of_results() - BASES - WINDS == {*known}
    for name, one in known.items():
        first = repr(one).splitlines()[0]
        assert name in first
        assert " object at 0x" not in repr(one)
        assert one._repr_html_().count("<tr>") > 3, name
        drawing = one.plot()
        assert any(axis.has_data() for axis in drawing.axes), name
        assert plots.to_svg(drawing).startswith("<svg"), name
        data = one.to_dataset()
        assert data.data_vars, name
        for variable, values in data.data_vars.items():
            assert {"units", "long_name"} <= {*values.attrs}, (name, variable)


def test_a_contact_along_a_roller_is_drawn_as_it_was_solved():
    found = edge_contact(ROLLERS, 2e3, cells=(24, 16), tolerance=1e-4)
    data = found.to_dataset()
    cell = np.diff(found.along)[0] * np.diff(found.across)[0]
    assert float(data["pressure"].sum()) * cell == pytest.approx(2e3, rel=1e-3)
    area, along = found.plot().axes[:2]
    assert area.collections[0].get_array().max() == pytest.approx(found.maximum_pressure / 1e6)
    assert along.lines[0].get_ydata().max() == pytest.approx(found.maximum_pressure / 1e6)


def test_the_friction_of_a_bearing_is_drawn_over_speed_as_its_dataset_has_it():
    found = ROLLERS.equilibrium(force=(2e3, 0.0, 0.0)).friction([20.0, 0.0, 10.0], GREASED)
    data = found.to_dataset()
    assert np.allclose(data["torques"].sum("component"), found.torque)
    assert np.allclose(data["film_parameter"].min(("row", "element", "ring")), [
        found.film_parameter[k].min() for k in range(3)
    ])  # fmt: skip
    left, right = found.plot().axes
    together = next(line for line in left.lines if line.get_label() == "all together")
    assert np.allclose(together.get_xdata(), np.array([0.0, 10.0, 20.0]) * 30 / np.pi)
    assert np.allclose(together.get_ydata(), found.torque[[1, 2, 0]])
    assert np.allclose(right.lines[0].get_ydata(), found.least_film_parameter[[1, 2, 0]])
    one = ROLLERS.equilibrium(force=(2e3, 0.0, 0.0)).friction(20.0, GREASED)
    assert "case" not in one.to_dataset().dims
    assert one.plot().axes[0].lines


# --- rooms ----------------------------------------------------------------------------------------


def test_rooms_are_there_after_one_import():
    code = (
        "import sys, loadflow as lf;"
        "rooms = {'journal', 'rolling', 'wind', 'seeds', 'plots', 'cube'};"
        "print(rooms <= set(dir(lf)), 'numba' in sys.modules, lf.journal.JournalBearing.__name__)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "False", "JournalBearing"]


@pytest.mark.parametrize("order", ["import loadflow, xarray", "import xarray, loadflow"])
def test_datasets_have_the_accessor_whoever_comes_first(order):
    code = f"{order}; print(xarray.Dataset.lf.__name__, 'numba' in __import__('sys').modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split()[0] == "LoadflowAccessor"


# --- accessor -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def cube():
    return make_cube([case(8.0, 1), case(12.0, 1)])


def test_statistics_of_the_accessor_are_those_of_the_command(cube):
    found = cube.lf.statistics()
    for record in statistic_records(cube):
        own = found.sel(case=record["case"], channel=record["component"])
        for name in ("mean", "std", "max"):
            assert own.sel(statistic=name).item() == record[name]
        assert own["units"].item() == record["units"]
    fatigue = found.sel(statistic="del", drop=True)
    loads = fatigue["units"].isin(["N", "N m"])
    assert fatigue["channel"][~loads].values.tolist() == ["speed"]
    assert np.isnan(fatigue[:, ~loads]).all()  # nothing that damages
    expected = cube.lf.del_(m=4.0).squeeze("m")
    np.testing.assert_allclose(fatigue[:, loads], expected[:, loads], rtol=1e-12)


def test_equivalent_loads_are_those_of_the_series(cube):
    found = cube.lf.del_("hub_moment.y", m=[4.0, 10.0])
    assert found.dims == ("case", "channel", "m")
    series = cube["hub_moment"].sel(axis="y").isel(case=1).values
    length = (series.size - 1) * 0.25
    expected = damage_equivalent_load(series, [4.0, 10.0], length)
    assert np.allclose(found.isel(case=1, channel=0), expected)
    assert np.allclose(cube.lf.del_("hub_moment.y").squeeze("m"), found.sel(m=4.0))
    assert found.attrs["units"] == "N m"
    with pytest.raises(InputError, match="m=4"):
        cube.lf.del_(4)


def test_a_spectrum_holds_the_variance_of_the_series(cube):
    found = cube.lf.spectrum("hub_moment")
    assert found["frequency"].attrs["units"] == "Hz"
    assert set(found["units"].values) == {found.attrs["units"]}
    assert "units" not in cube.lf.statistics("hub_moment.y").attrs  # no unit that pint could read
    assert pint.Quantity(1.0, found.attrs["units"]).to("N^2 m^2 s").magnitude == 1.0
    for several in (cube.lf.spectrum(), cube.lf.del_()):
        assert "units" not in several.attrs
        named = [*several["units"].values]
        assert len({*named}) > 1
        for unit, name in zip(named, several["channel"].values):
            own = cube[name.split(".")[0]].attrs["units"]
            wanted = f"({own})^2/Hz" if several.name == "power_spectral_density" else own
            assert pint.Quantity(1.0, unit) == pint.Quantity(1.0, wanted)
    for axis in ("y", "z"):
        series = cube["hub_moment"].sel(axis=axis).isel(case=0)
        density = found.sel(channel=f"hub_moment.{axis}").isel(case=0)
        power = trapezoid(density, density["frequency"])
        assert power == pytest.approx(float(series.var()), rel=0.25)  # windows of a short series


def test_the_left_of_one_who_looks_downwind_is_the_left_of_the_page():
    drawing = plots.clearance_circle([[0.1, 0.5]], [10.0])  # down, to the left
    axis = drawing.axes[0]
    middle = axis.transData.transform((0.0, 0.0))
    assert np.all(axis.transData.transform(axis.collections[0].get_offsets()[0]) < middle)


def test_a_cube_draws_its_channels(cube):
    drawing = cube.lf.plot("speed", "hub_moment.y")
    assert [axis.get_ylabel() for axis in drawing.axes] == ["speed,\n1/min", "hub_moment.y,\nMN m"]


def test_a_channel_that_is_not_there_is_named(cube):
    with pytest.raises(InputError, match="hub_torque"):
        cube.lf.statistics("hub_torque")


def test_the_accessor_is_that_of_the_package(cube):
    assert type(cube.lf).__module__ == "loadflow.studies.accessor"
    assert lf.cube.open_cube is lf.open_cube


@pytest.mark.parametrize(
    "keys",
    [
        {"grading": "uniform"},
        {"grid": (24, 6), "rung": "grid", "inlet": None},
        {"contact": Contact(AsperityContact(roughness=5e-7, contact_modulus=1e11, factor=1e-3))},
        {
            "heat": FilmHeat("iso-vg-68", inlet_temperature=313.15),
            "cavitation": MassConserving(),
            "edge_pressure": 1e4,
        },
        {"shell": LocalShell(1e-12)},
    ],
    ids=["uniform", "coarse", "rough", "warm", "elastic"],
)
def test_every_film_knows_its_gap(keys):
    film = Film(**({"grid": (36, 8)} | ({} if "heat" in keys else {"lubricant": OIL}) | keys))
    found = BEARING.pressure((7e-5, 3e-5), 50.0, film)
    closed = BEARING.clearance - 7e-5 * np.cos(found.angle) - 3e-5 * np.sin(found.angle)
    grown = closed[:, None] + found.deformation
    assert np.allclose(found.gap, grown, rtol=0.02)


def test_a_figure_is_a_picture_in_a_notebook_without_pyplot():
    drawing, _ = plots.figure()
    assert drawing._repr_png_().startswith(b"\x89PNG")


def test_temperatures_are_drawn_in_degrees_and_their_differences_in_kelvin():
    warm = xr.DataArray([314.65, 348.15], name="largest_temperature", attrs={"units": "K"})
    values, unit = plots.readable(warm)
    assert unit == "°C"
    np.testing.assert_allclose(values, [41.5, 75.0])
    assert plots.readable(warm.rename("oil_rise"))[1] == "K"


def test_values_are_shown_in_the_unit_that_is_asked_for_or_refused():
    moment = xr.DataArray([2.5e6], name="moment", attrs={"units": "N m"})
    assert plots.readable(moment, "kN m")[0].tolist() == [2500.0]
    assert plots.readable(moment, "N m")[0].tolist() == [2.5e6]
    with pytest.raises(InputError, match=r"units: 'µm' .* in N m; there are N m, MN m, kN m"):
        plots.readable(moment, "µm")


def test_viscosities_are_shown_in_the_unit_of_oil_data():
    heat = Heat("mineral-vg-320", inlet_temperature=313.15)
    table = BEARING.equilibrium((1e3, 0.0), 50.0, heat=heat)._repr_html_()
    found = re.search(r"viscosity at the effective temperature (\S+) (\S+ s) ", _words_of(table))
    assert found is not None
    assert (float(found[1]) > 1.0, found[2]) == (True, "mPa s")  # not 0.035 Pa s


def _words_of(table):
    return " ".join(re.sub("<[^>]*>", " ", table).split())
