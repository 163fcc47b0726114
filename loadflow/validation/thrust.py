"""Thrust pads and conical bearings beside exact series solutions of the Reynolds equation."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from loadflow.validation.check import Check, evidence

if TYPE_CHECKING:
    from loadflow.journal import ConicalResult, ThrustResult

GAP = 1e-4  # m; all films are isoviscous, so that their numbers without dimension are those of any
MIDDLE, FINE = (80, 40), (160, 80)  # cells
# What the grid may be off: twice the largest error of a kind of pad. All fall to a quarter where
# cells are halved, so that a wrong term of first order, or a misprint, does not hide in them.
WITHIN = {"wide": 1e-4, "rectangular": 1.2e-3, "stepped": 3.5e-4, "sector": 3e-4, "cone": 9e-4}
CENTRED = {"wide": 1.6e-5, "rectangular": 1e-4, "sector": 1.6e-5, "cone": 3e-6, "segment": 1e-5}

# Infinitely wide pads [Rayleigh 1918]: inlet over outlet film a, share of the wedge, W h²/(η U L²)
# per width, centre of pressure from the inlet
WIDE = (
    (1.5, 1.0, 0.131163, 0.540420),
    (2.0, 1.0, 0.158883, 0.568688),
    (3.0, 1.0, 0.147918, 0.607410),
    (2.0, 0.75, 0.188636, 0.539637),
    (4.0, 0.75, 0.148850, 0.595519),
    (2.1887, 0.80, 0.192191, 0.557926),
)
# Rectangular pads [Michell 1905]: B/L, a, wedge, W h²/(η U L² B), centre
RECTANGULAR = (
    (0.5, 1.5, 1.0, 0.023031, 0.560062),
    (0.5, 3.0, 1.0, 0.029795, 0.655552),
    (2.0, 2.0, 1.0, 0.110479, 0.573520),
    (0.5, 2.0, 0.75, 0.036517, 0.534140),
    (0.5, 4.0, 0.75, 0.039008, 0.611473),
    (2.0, 3.0, 0.75, 0.131141, 0.574642),
)
# Stepped pads [Archibald 1950]: B/L, a, share before the step, W h²/(η U L² B)
STEPPED = (
    (1.0, 1.7, 0.55, 0.0725793),
    (1.0, 1.866, 0.7182, 0.0665617),
    (0.5, 1.6, 0.5, 0.0269323),
)
# Sector pads with r1/r2 = 0.5 and a film that changes with the angle alone: angle (°), a, wedge,
# W h²/(η ω r2⁴), centre as share of the angle and as radius over r2
SECTORS = (
    (30.0, 2.0, 1.0, 0.0049079, 0.578891, 0.775211),
    (30.0, 2.0, 0.75, 0.0060841, 0.538413, 0.775445),
    (30.0, 3.0, 0.75, 0.0061277, 0.576265, 0.777830),
    (60.0, 2.0, 1.0, 0.0094760, 0.593557, 0.766673),
    (60.0, 2.0, 0.75, 0.0119339, 0.535915, 0.765686),
    (60.0, 3.0, 0.75, 0.0128763, 0.579988, 0.766966),
)
# Whole cones with Gümbel's law: α (°), s2/s1, ε; F_a, F_x, F_y in η ω s1⁴/c² as printed, for the
# film c (1 + ε cos φ); centre s/s1
CONES = (
    (20.0, 1.3, 0.5, 0.00280496, -0.00351859, 0.00538544, 1.152958),
    (20.0, 1.3, 0.8, 0.01480097, -0.03033054, 0.02121812, 1.153677),
    (60.0, 1.5, 0.6, 0.15837604, -0.05284090, 0.05867394, 1.257180),
)
SEGMENT = (0.0069571, 135.9014, 1.209832)  # N in η ω s1⁴/c², φ_c (°), s_c/s1


def wide_pad(a: float, wedge: float, grid: tuple[int, int]) -> ThrustResult:
    """Infinitely wide pad of length 1 m, η U = 1 Pa m."""
    return rectangular_pad(math.inf, a, wedge, grid)


def rectangular_pad(ratio: float, a: float, wedge: float, grid: tuple[int, int]) -> ThrustResult:
    """Pad of length 1 m and width `ratio`, η U = 1 Pa m."""
    from loadflow.journal import Film, Lubricant, RectangularThrustBearing

    pad = RectangularThrustBearing(1, 10.0, 1.0, ratio, taper=(a - 1) * GAP, wedge=wedge)
    return pad.pressure(GAP, 0.1, Film(Lubricant(1.0), grid=grid))


def stepped_pad(ratio: float, a: float, share: float, grid: tuple[int, int]) -> ThrustResult:
    """Stepped pad of length 1 m and width `ratio`, η U = 1 Pa m."""
    from loadflow.journal import Film, Lubricant, RectangularThrustBearing, Step

    step = Step((a - 1) * GAP, share)
    pad = RectangularThrustBearing(1, 10.0, 1.0, ratio, profile=step)
    return pad.pressure(GAP, 0.1, Film(Lubricant(1.0), grid=grid))


def sector_pad(angle: float, a: float, wedge: float, grid: tuple[int, int]) -> ThrustResult:
    """Sector pad of 0.5 and 1 m radius, `angle` in degrees, η ω = 1 Pa."""
    from loadflow.journal import Film, Lubricant, ThrustBearing

    pad = ThrustBearing(1, 0.5, 1.0, math.radians(angle), taper=(a - 1) * GAP, wedge=wedge)
    return pad.pressure(GAP, 1.0, Film(Lubricant(1.0), grid=grid))


def whole_cone(
    angle: float, ratio: float, eps: float, grid: tuple[int, int], toward: float = 0.0
) -> ConicalResult:
    """Whole cone of inner slant 1 m with Gümbel's law, eccentric toward an angle, η ω = 1 Pa."""
    from loadflow.journal import ConicalBearing, Film, Guembel, Lubricant

    cone = ConicalBearing(math.radians(angle), (1.0, ratio), GAP)
    e = eps * GAP / math.cos(math.radians(angle))
    place = (e * math.cos(toward), e * math.sin(toward), 0.0)
    return cone.pressure(place, 1.0, Film(Lubricant(1.0), Guembel(), inlet=None, grid=grid))


def segment(grid: tuple[int, int]) -> ConicalResult:
    """Segment 120 … 150° of a cone of 30°, s 1 … 1.4 m, in a film c (1 + 0.6 cos φ), η ω = 1 Pa."""
    from loadflow.journal import ConicalBearing, Film, Guembel, Lubricant

    angle = math.radians(30.0)
    turn = (math.radians(30.0), math.radians(120.0))
    cone = ConicalBearing(angle, (1.0, 1.4), GAP, pads=1, pad_angle=turn[0], first_pad=turn[1])
    place = (-0.6 * GAP / math.cos(angle), 0.0, 0.0)
    return cone.pressure(place, 1.0, Film(Lubricant(1.0), Guembel(), grid=grid))


@evidence("closed form")
def checks() -> Iterator[Check]:
    """All rows: straight pads at 80 × 40, sectors at 160 × 80, cones at 160 × 40."""
    share = GAP**2
    for a, wedge, load, centre in WIDE:
        pad = wide_pad(a, wedge, FINE)
        name, source = f"wide pad, a = {a:g}, wedge {wedge:g}", "Rayleigh 1918"
        yield Check(f"W*, {name}", source, load, pad.force * share, WITHIN["wide"])
        got, within = float(pad.centre[1]), CENTRED["wide"]
        yield Check(f"x_c/L, {name}", source, centre, got, within, "absolute")
    for ratio, a, wedge, load, centre in RECTANGULAR:
        pad = rectangular_pad(ratio, a, wedge, MIDDLE)
        name, source = f"B/L = {ratio:g}, a = {a:g}, wedge {wedge:g}", "exact series, Michell 1905"
        yield Check(f"W*, {name}", source, load, pad.force * share / ratio, WITHIN["rectangular"])
        got, within = float(pad.centre[1]), CENTRED["rectangular"]
        yield Check(f"x_c/L, {name}", source, centre, got, within, "absolute")
    for ratio, a, step, load in STEPPED:
        pad = stepped_pad(ratio, a, step, MIDDLE)
        name = f"W*, B/L = {ratio:g}, a = {a:g}, step at {step:g}"
        got = pad.force * share / ratio
        yield Check(name, "exact series, Archibald 1950", load, got, WITHIN["stepped"])
    for angle, a, wedge, load, centre, radius in SECTORS:
        pad = sector_pad(angle, a, wedge, FINE)
        name, source = f"sector {angle:g}°, a = {a:g}, wedge {wedge:g}", "exact series"
        yield Check(f"W*, {name}", source, load, pad.force * share, WITHIN["sector"])
        for label, expected, got in zip(("r_c/r2", "θ_c/β"), (radius, centre), pad.centre):
            within = CENTRED["sector"]
            yield Check(f"{label}, {name}", source, expected, float(got), within, "absolute")
    for angle, ratio, eps, axial, x, y, middle in CONES:
        cone = whole_cone(angle, ratio, eps, (160, 40))
        name, source = f"cone {angle:g}°, s2/s1 = {ratio:g}, ε = {eps:g}", "exact series, Gümbel"
        for label, expected, got in zip(("F_x", "F_y", "F_z"), (-x, -y, -axial), cone.force):
            yield Check(f"{label}, {name}", source, expected, got * share, WITHIN["cone"])
        got, within = float(cone.centre[0, 0]), CENTRED["cone"]
        yield Check(f"s_c/s1, {name}", source, middle, got, within, "absolute")
    found = segment((160, 40))
    load, angle, middle = SEGMENT
    source = "exact series"
    got = float(found.normal_force[0]) * share
    yield Check("N, segment of a cone", source, load, got, WITHIN["cone"])
    turned = math.degrees(float(found.centre[0, 1]))
    yield Check("φ_c, segment of a cone", source, angle, turned, 2e-4, "absolute", "°")
    place, within = float(found.centre[0, 0]), CENTRED["segment"]
    yield Check("s_c/s1, segment of a cone", source, middle, place, within, "absolute")
