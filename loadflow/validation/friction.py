"""Films, friction, stiffness and damping against von Hollen 2013 and Kruk.

Rows whose source ends in "rebuilt" are not printed but recomputed from the printed inputs by an
independent calculation. Not comparable, because the text gives no numbers: every friction torque
over speed (what parameters move of it is in `friction_rig`), masses of the crank drive, hysteresis
factor, any result of Kruk. Misprints of the source are put right; the switches that bring them back
are named in the modules.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from loadflow.rolling import RollerBearing
from loadflow.rolling import friction as parts
from loadflow.rolling.friction import roller_drag as drag
from loadflow.rolling.kinematics import common_period, contact_speeds, ideal_speeds
from loadflow.rolling.motion.crank import CrankDrive
from loadflow.rolling.motion.radial_load import LineLaw, behw_law, radial_distribution
from loadflow.rolling.stiffness.contact_films import richter_plate
from loadflow.tribology import contact_film as film
from loadflow.tribology import lubricant, traction
from loadflow.tribology import lubricant_laws as laws
from loadflow.tribology.asperities import combined_roughness, film_parameter, greenwood_tripp
from loadflow.tribology.film import butenschoen, butenschoen_squeeze
from loadflow.tribology.hertz import effective_modulus, hertz_line
from loadflow.validation import _friction_motion, _lim_singh
from loadflow.validation.check import Check, evidence

RPM = math.pi / 30
MODULUS = 2 * float(effective_modulus())

# Table 8.2, NU2208; pocket angle and cage height are not given: half the cage's radial height
MAIN = parts.RollerGaps(
    radius=5.5e-3,
    length=11e-3,
    end_gaps=(0.4e-3, 0.4e-3),
    rib_gaps=(0.06e-3, 0.06e-3),
    pocket_gaps=(0.39e-3, 0.39e-3),
    rib_height=1.6e-3,
    cage_half_height=2.75e-3,
    pocket_angle=math.radians(30),
    roughness=3.84e-6,
    pitch_diameter=60.5e-3,
)
MAIN_RACES, PIN_RACES = (49.5e-3, 71.5e-3), (48e-3, 63e-3)
MAIN_BEARING = RollerBearing(
    rollers=14,
    roller_diameter=11e-3,
    roller_length=11e-3,
    pitch_diameter=60.5e-3,
    clearance=8e-6,
    slices=1,
    profile="straight",
)


def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _kinematics()
    yield from _crank()
    yield from _cage_and_seal()
    yield from _cage_film()
    yield from _traction()
    yield from _drag_integrals()
    yield from _rolling_torque()
    yield from _distribution()
    yield from _lubricant()
    yield from _contact()
    yield from _asperities()
    yield from _harris_film()
    yield from _film_dynamics()
    yield from _lim_singh.checks()
    yield from _friction_motion.checks(MAIN)


@evidence("closed form")
def _kinematics() -> Iterator[Check]:
    """Ratios of speeds, case A1."""
    cage, spin = ideal_speeds(1.0, 0.0, *MAIN_RACES)
    turns, cages = common_period(*MAIN_RACES)
    rows = [
        ("cage, main bearing", 9 / 22, cage),
        ("roller, main bearing", 2.25, spin - cage),
        ("roller to cage, main bearing", 2.659091, spin),
        ("period, shaft turns", 22, turns),
        ("period, cage turns", 9, cages),
    ]
    cage, spin = ideal_speeds(0.0, 1.0, *PIN_RACES)
    turns, cages = common_period(PIN_RACES[1], PIN_RACES[0])
    rows += [
        ("cage, pin bearing", 21 / 37, cage),
        ("roller, pin bearing", 4.2, -(spin - cage)),
        ("roller to cage, pin bearing", 3.632432, -spin),
        ("period, crank turns", 37, turns),
        ("period, cage turns, pin", 21, cages),
    ]
    for name, expected, got in rows:
        yield Check(name, "(4.50)–(4.60), Table 8.1, 8.2, rebuilt", expected, float(got), 5e-7)


@evidence("closed form")
def _crank() -> Iterator[Check]:
    """Inertia of rollers on the crank pin and loads in three frames, cases A2 and A3."""
    drive = CrankDrive(
        radius=42.5e-3, rod_length=143.5e-3, piston_mass=0.4, rod_mass=0.6, rod_centre=43e-3
    )
    for angle, radial, tangential in ((0.3, -3.183036, -0.585376), (1.7, -1.735308, -2.463459)):
        found = drive.roller_inertia(angle, 1000 * RPM, 6.67e-3, *PIN_RACES)
        source = f"(4.69), (4.70), φ = {angle}, 1000/min, rebuilt"
        yield Check("N", source, radial, float(found.radial), 1e-6, unit="N")
        yield Check("U", source, tangential, float(found.tangential), 1e-6, unit="N")
        loads = drive.pin_loads(angle, 3000 * RPM, 5e3)
        sizes = [float(np.hypot(*frame)) for frame in loads]
        for frame, size in zip(("crank", "space"), sizes[1:]):
            name = f"pin load, {frame} against rod"
            source = "(5.1)–(5.6), a force in three frames"
            yield Check(name, source, sizes[0], size, 1e-12, unit="N", evidence="consistency")


@evidence("closed form")
def _cage_and_seal() -> Iterator[Check]:
    """Film of the cage against roughness, and the shaft seal: cases A4, A5."""
    sigma = combined_roughness(0.31, 0.533)
    yield Check("σ of cage and bore", "(8.2), rebuilt", 0.61659, float(sigma), 1e-5, unit="μm")
    for gap, expected in ((3.8, 6.16), (5.2, 8.43), (1.5, 2.43), (2.1, 3.41)):
        got = float(film_parameter(gap, sigma))
        name = f"Λ at {gap} μm"
        yield Check(
            name, "(8.2), ch. 8.3.3", expected, got, 0.01, "absolute",
            evidence="print of the source",
        )  # fmt: skip
    seal = (17.5e-3, 11.5, 0.3)
    dry = float(parts.seal_torque(0.0, *seal))
    yield Check("seal, dry", "(8.1)", 0.060375, dry, 1e-12, unit="N m")
    for eta, n in ((10.6e-3, 3000), (26.3e-3, 1000)):
        got = float(parts.seal_torque(n * RPM, *seal, viscosity=eta, width_ratio=122)) - dry
        name = f"seal, viscous, {eta * 1e3} mPa s, {n}/min"
        yield Check(name, "(8.1), rebuilt", 4.3021e-4 * eta * n, got, 1e-4, unit="N m")


# Holland's film of a cage with b/d = 4/63: ε, So_D, β (°), So_V
CAGE_FILM = (
    (0.30, 0.00250328, 67.2959, 0.0269374),
    (0.60, 0.0108586, 46.7062, 0.110749),
    (0.80, 0.0485126, 28.0044, 0.631617),
    (0.90, 0.200013, 19.7768, 3.566),
    (0.95, 0.792091, 14.9451, 19.8921),
    (0.98, 4.5913, 10.1259, 187.155),
)


@evidence("closed form")
def _cage_film() -> Iterator[Check]:
    """Closed forms of rotation and squeeze, (4.26)–(4.29) with the exponent put right."""
    width = 4 / 63
    for ratio, number, turn, squeeze in CAGE_FILM:
        so, attitude = butenschoen(ratio, width)
        name, source = f"b/d = 4/63, ε = {ratio:g}", "(4.26)–(4.29), rebuilt"
        yield Check(f"So_D, {name}", source, number, float(so), 5e-6)
        got = math.degrees(float(attitude))
        yield Check(f"β, {name}", source, turn, got, 6e-5, "absolute", "°")
        got = float(butenschoen_squeeze(ratio, width))
        yield Check(f"So_V, {name}", source, squeeze, got, 5e-6)


@evidence("closed form")
def _traction() -> Iterator[Check]:
    """Limiting shear stress, case A6, and other pressures of Table 5.1."""
    oil = lubricant("crankshaft-5w-30")
    for pressure, expected in ((100, 4), (502, 4), (573.37, 8.9959), (1000, 38.86)):
        got = traction.limiting_stress(
            pressure * 1e6, oil.critical_stress, oil.critical_pressure, oil.limiting_slope
        )
        name = f"τ_lim at {pressure} MPa"
        yield Check(name, "(5.54), Table 5.1", expected, float(got) / 1e6, 1e-6, unit="MPa")


@evidence("closed form")
def _drag_integrals() -> Iterator[Check]:
    """Areas of the roller's end, case A7, and the constants fitted to Table 8.5."""
    rows = (
        ("𝒜", 677.2424, drag.strip_moment(5.5, 2.75)),
        ("ℬ", 410.2441, drag.segment_polar(5.5, 1.6)),
        ("½{…}", 178.3865, drag.segment_square(5.5, 1.6)),
        ("½{…} as printed", -49.09, drag.segment_square(5.5, 1.6, "printed")),
        ("∫ y dA", 38.88486, drag.segment_area_moment(5.5, 1.6)),
    )
    for name, expected, got in rows:
        tolerance = 1e-4 if "printed" in name else 1e-6
        yield Check(name, "(4.78), (4.79), rebuilt", expected, got, tolerance, unit="mm⁴")
    constants = parts.coulomb_drag_constants(MAIN, 37.06e-3, 9 / 22, 0.12, 0.04, variant="thesis")
    source = "(5.26), (5.27), η = 37.06 mPa s, rebuilt"
    yield Check("C₁'", source, 7.84e-6, constants.spin, 2e-3, unit="N m s")
    yield Check("C₃₂'", source, -6.52e-7, constants.orbit, 2e-3, unit="N m s")
    ring = float(parts.cage_side_torque(1.0, (0.27e-3, 0.27e-3), 1.0, 31.425e-3, 26.3e-3))
    yield Check("cage side, M/(η ω)", "(5.44), rebuilt", 5.7803e-3, ring, 1e-4, unit="m³")


@evidence("closed form")
def _rolling_torque() -> Iterator[Check]:
    """Levers of the rolling forces, case A8."""
    for name, races, expected in (("main", MAIN_RACES, 29.25), ("pin", PIN_RACES, 27.2432)):
        for ring, forces in (("inner", (1.0, 0.0)), ("outer", (0.0, 1.0))):
            got = float(parts.hydrodynamic_torque(*forces, *races)) * 1e3
            yield Check(f"lever, {ring}, {name}", "(4.49), rebuilt", expected, got, 2e-6, unit="mm")
        printed = float(parts.hydrodynamic_torque(1.0, 0.0, *races, variant="printed")) * 1e3
        if name == "main":
            yield Check("lever, inner, printed sign", "(4.49)", 20.25, printed, 1e-9, unit="mm")


@evidence("closed form")
def _distribution() -> Iterator[Check]:
    """Load factor without clearance, case A9, and ISO loads of the main bearing, case B6."""
    many = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    for exponent, expected in ((1.08, 4.0614), (10 / 9, 4.0850), (1.0, 4.0)):
        found = radial_distribution(1e4, many, 0.0, LineLaw(1e9, exponent))
        factor = float(found.loads.max()) * many.size / 1e4
        name = f"z R_max/F, exponent {exponent:.4g}"
        yield Check(name, "(5.13), rebuilt", expected, factor, 0.002, "absolute")
    yield from _printed_law()
    loaded = MAIN_BEARING.equilibrium(force=(2000.0, 0.0, 0.0))
    source = "(5.13) with ISO 16281, rebuilt"
    shift = float(loaded.displacement[0]) * 1e6
    yield Check("δ₀, F = 2 kN", source, 8.412, shift, 1e-4, unit="μm")
    yield Check("R_max, F = 2 kN", source, 731.6, float(loaded.maximum_force), 1e-4, unit="N")


def _printed_law() -> Iterator[Check]:
    """Loads of single rollers with the law of the source, case B6."""
    angles, law = 2 * np.pi * np.arange(14) / 14, behw_law(11e-3)
    source = "(5.13)–(5.16), Table 8.2, rebuilt"
    table = (
        (2000.0, 8.6408, 62.42, (718.29, 576.37, 194.97, 0.0), 691.72),
        (13_800.0, 27.8536, 81.74, (4208.63, 3685.55, 2251.54, 320.46), 4055.14),
    )
    for force, shift, zone, rollers, straddling in table:
        found = radial_distribution(force, angles, 8e-6, law)
        name = f"F = {force / 1e3:g} kN"
        delta = float(found.displacement)
        yield Check(f"δ₀, {name}", source, shift, delta * 1e6, 1e-5, unit="μm")
        half = math.degrees(math.acos(4e-6 / delta))
        yield Check(f"half load zone, {name}", source, zone, half, 0.005, "absolute", "°")
        for i, expected in enumerate(rollers):
            got = float(found.loads[i])
            yield Check(f"R_{i}, {name}", source, expected, got, 0.005, "absolute", "N")
        between = radial_distribution(force, angles + np.pi / 14, 8e-6, law)
        largest = float(between.loads.max())
        yield Check(f"R_max, straddling, {name}", source, straddling, largest, 1e-5, unit="N")
    pin = 2 * np.pi * np.arange(18) / 18
    for gap, shift, largest, count in (
        (25, 17.194, 1143.9, 5), (13, 10.509, 964.7, 5), (0, 2.888, 677.0, 9),
    ):  # fmt: skip
        found = radial_distribution(3000.0, pin, gap * 1e-6, behw_law(18e-3))
        name, source = f"pin, e = {gap} μm", "(5.13)–(5.16), Table 8.1, 3 kN, rebuilt"
        delta = float(found.displacement) * 1e6
        yield Check(f"δ₀, {name}", source, shift, delta, 5e-4, "absolute", "μm")
        yield Check(f"R_max, {name}", source, largest, float(found.loads.max()), 1e-4, unit="N")
        loaded = int((found.loads > 1e-6).sum())
        yield Check(f"rollers loaded, {name}", source, count, loaded, 0)


@evidence("closed form")
def _lubricant() -> Iterator[Check]:
    """Viscosity through two points, case A15; slope and level at 90 °C, case B7."""
    points = (26.3e-6, 10.6e-6)
    ends = (333.15, 363.15)
    # between its points: lg lg of ν in mm²/s + 0.8 is straight over lg T
    got = float(laws.walther(348.15, points, ends)) * 1e6
    yield Check("ν at 348.15 K", "(5.58), rebuilt", 16.05099, got, 1e-6, unit="mm²/s")
    steep = float(laws.andrade_steepness(363.15, points, ends))
    yield Check("β_th, 90 °C", "(5.94), rebuilt", 0.027789, steep, 5e-5, unit="1/K")
    oil = lubricant("crankshaft-5w-30")
    for t, eta in ((333.15, 26.3), (363.15, 10.6)):
        got = float(oil.viscosity(t)) * 1e3
        yield Check(
            f"η at {t:g} K", "ch. 8.1", eta, got, 6e-3, unit="mPa s",
            evidence="print of the source",
        )  # fmt: skip


@evidence("closed form")
def _contact() -> Iterator[Check]:
    """Contact of the main bearing at 1000/min, cases A14 and B7."""
    cage, spin = ideal_speeds(1000 * RPM, 0.0, *MAIN_RACES)
    speeds = contact_speeds(1000 * RPM, 0.0, cage, spin, *MAIN_RACES)
    u, load, eta, alpha, length, radius = 1.531526, 718.29, 10.6e-3, 2e-8, 11e-3, 4.5e-3
    line = hertz_line(1 / 5.5e-3, 1 / 24.75e-3, length=length, force=load)
    groups = (
        alpha * MODULUS,
        eta * u / (MODULUS * radius),
        load / (MODULUS * length * radius),
    )
    micro = radius * 1e6
    half = float(line.semi_width)
    rows = [
        ("u, inner", 1.531526, speeds.mean_inner, 1e-6, "m/s"),
        ("u, outer", 1.531526, speeds.mean_outer, 1e-6, "m/s"),
        ("half width", 56.943, half * 1e6, 1e-5, "μm"),
        ("p₀", 730.04, line.pressure / 1e6, 1e-5, "MPa"),
        ("h, Hamrock", 0.11503, film.film_ratio("hamrock", *groups) * micro, 1e-4, "μm"),
        ("h, exponent as printed", 0.55153, film.film_ratio("hamrock-printed", *groups) * micro,
         1e-4, "μm"),
        ("h, Dowson–Higginson", 0.10911, film.film_ratio("dowson-higginson", *groups) * micro,
         1e-4, "μm"),
        ("F_HyRo", 0.15759, parts.elastic_force(load, length, radius, u, eta, alpha, MODULUS),
         1e-4, "N"),
        ("M_Verf/α", 8.6796e-3, parts.hysteresis_moment(load, half, 1.0), 1e-4, "N m"),
    ]  # fmt: skip
    for name, expected, got, tolerance, unit in rows:
        source = "Table 8.2, 718.29 N, 1000/min, rebuilt"
        yield Check(name, source, expected, float(got), tolerance, unit=unit)
    # a roller of 11 g that nothing but its own inertia presses on the outer ring
    mass, ring = 11e-3, 0.5 * float(np.mean(MAIN_RACES))
    free = float(mass * ring * cage**2)
    outer = hertz_line(1 / 5.5e-3, -1 / 35.75e-3, length=length, force=free)
    width = 2 * float(outer.semi_width)
    source = "Table 8.2, free roller, 1000/min, rebuilt"
    yield Check("N of a free roller", source, 0.61, free, 0.005, "absolute", "N")
    mean = free / (width * length) / 1e6
    yield Check("mean pressure under it", source, 14.0, mean, 0.5, "absolute", "MPa")
    yield from _main_bearing_film()
    loading = film.thermal_loading(eta, 0.027789, u, 0.1386)
    heated = float(film.thermal_factor(loading))
    yield Check("C_th", "(5.92), rebuilt", 0.977, heated, 3e-3)
    # a circle, k = 1: what stands before G^0.53 U^0.67 W^-0.067
    circle = float(film.hamrock_dowson_central(1.0, 1.0, 1.0, 1.0))
    yield Check(
        "Hamrock/Dowson, circle", "Table 5.2", 1.90, circle, 1e-3, "absolute",
        evidence="print of the source",
    )  # fmt: skip


def _main_bearing_film() -> Iterator[Check]:
    """Film of a slow main bearing, 10 1/min, and how the rolling force grows with the speed."""
    radius, race, load, length, alpha = 37e-3, 0.46, 2e5, 0.15, 2.2e-8
    races = 2 * race, 2 * race + 4 / (1 / radius - 1 / race)
    cage, spin = ideal_speeds(10 * RPM, 0.0, *races)
    u = float(contact_speeds(10 * RPM, 0.0, cage, spin, *races).mean_inner)
    for eta, expected in ((0.3, 0.59), (0.1, 0.28)):
        groups = alpha * MODULUS, eta * u / (MODULUS * radius), load / (MODULUS * length * radius)
        got = float(film.film_ratio("hamrock", *groups)) * radius * 1e6
        name = f"h, R_eff = 37 mm, 200 kN, {eta:g} Pa s"
        # two digits of inputs with two digits
        yield Check(name, "(5.90), rebuilt", expected, got, 0.006, "absolute", "μm")
    # G = 3745, W = 2e-4: the table has 0.0623 … 1.129 N for U = 1e-11 … 1e-9; the slow one by hand,
    # so that a factor that is off does not cancel
    slow = 29.2 / 3745 * (3745 * 1e-11) ** 0.648 * 2e-4**0.246
    fast = float(parts.elastic_force(2e-4, 1.0, 1.0, 1e-9, 1.0, 3745.0, 1.0))
    yield Check(
        "F_HyRo at U = 1e-9 over 1e-11", "Zhou and Hoeprich 1991, Table 1", 1.129 / 0.0623,
        fast / slow, 0.12, evidence="another code",
    )  # fmt: skip


@evidence("closed form")
def _asperities() -> Iterator[Check]:
    """Integrals of Gaussian heights against an independent quadrature."""
    table = {
        2.5: (0.61663421900, 0.080562335571, 5.4237051975e-3, 1.7087299621e-4, 2.3533810526e-6),
        2.0: (0.5, 0.075339783344, 5.7687267145e-3, 2.0343508049e-4, 3.0902081035e-6),
    }
    for order, values in table.items():
        for u, expected in enumerate(values):
            got = float(greenwood_tripp(order, float(u)))
            yield Check(f"F_{order}({u})", "Greenwood and Tripp 1970", expected, got, 1e-10)


@evidence("closed form")
def _harris_film() -> Iterator[Check]:
    """Film of the inner contact of a 209 ball bearing at 400 rad/s."""
    groups = (5227.0, 2.154e-10, 7.63e-4, 9.285)  # with E₀, k = a/b exact
    for name, law, expected in (
        ("h_min", film.hamrock_dowson_minimum, 0.554),
        ("h_c", film.hamrock_dowson_central, 0.693),
    ):
        got = float(law(*groups)) * 5.1093e3
        yield Check(f"{name}, 209", "Harris, rebuilt", expected, got, 1e-3, unit="μm")


@evidence("closed form")
def _film_dynamics() -> Iterator[Check]:
    """Richter's plate, case A12: the complex form against numbers of the printed real form."""
    for eta, omega, stiffness, damping in (
        (30.0, 100.0, 7.045323e8, 1.838292e7), (0.03, 6283.0, 3.199633e6, 2.110757e4),
    ):  # fmt: skip
        args = (1.5e9, 11e-3, 100e-6, 0.5e-6, eta, omega)
        plate = complex(richter_plate(*args))
        source = f"Kruk (2.5)–(2.10), η = {eta:g} Pa s"
        for name, expected, got, unit in (
            ("k_pl", stiffness, plate.real, "N/m"),
            ("d_pl", damping, plate.imag / omega, "N s/m"),
        ):
            yield Check(name, f"{source}, rebuilt", expected, got, 1e-6, unit=unit)
