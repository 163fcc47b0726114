"""Housing around a bearing of which only the rolling elements are known."""

import math

import pytest

from loadflow.rolling import BallBearing, RollerBearing
from loadflow.rolling.housing import housing_area

# rings of half an element, 1.4 elements of housing around them
SIZE, PITCH = 0.04, 0.8
HEIGHT = PITCH + (1 + 2 * 0.5 + 2 * 1.4) * SIZE
ROLLERS = {
    "rollers": 48, "roller_diameter": SIZE, "roller_length": 0.06, "pitch_diameter": PITCH,
    "contact_angle": 0.35,
}  # fmt: skip
BALLS = {"balls": 48, "ball_diameter": SIZE, "pitch_diameter": PITCH, "groove_radius": 0.021}


@pytest.mark.parametrize(("kind", "given"), [(RollerBearing, ROLLERS), (BallBearing, BALLS)])
def test_a_housing_is_as_much_wider_as_its_rows_stand_apart(kind, given):
    one = housing_area(kind(**given))
    for rows, apart in ((2, 0.12), (2, 0.2), (3, 0.12)):
        several = housing_area(kind(**given, rows=rows, row_spacing=apart))
        assert several - one == pytest.approx(math.pi * HEIGHT * (rows - 1) * apart, rel=1e-9)
