"""A tilted shaft that rubs at one end: what asperities carry asks for points across the width."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import Contact, Film, GasMixture, JournalBearing, LocalShell, Lubricant
from loadflow.tribology import AsperityContact

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
ROUGH = AsperityContact(roughness=1e-5, contact_modulus=115e9, factor=1e-3)
FILM = Film(
    Lubricant(0.05), GasMixture(0.05e6), edge_pressure=0.5e6, grid=(120, 20), rung="reduced",
    grading="uniform", shell=LocalShell(3e-12), contact=Contact(ROUGH),
)  # fmt: skip
FORCE, SPEED = np.array([6e6, 1.2e6]), 0.127
TILT = 0.1 * BEARING.clearance / BEARING.radius * np.array([0.0, 1.0])


def test_a_path_that_rubs_at_one_end_has_the_friction_of_fine_cells_from_its_first_sample_on():
    """Six points across missed a twentieth of it."""
    time, rows = np.array([0.0, 0.025, 0.05]), (3, 1)
    found = BEARING.orbit(
        time, np.tile(FORCE, rows), np.full(3, SPEED), FILM, tilt=np.tile(TILT, rows)
    )
    fine = replace(FILM, rung="grid", grid=(120, 80))
    rest = BEARING.equilibrium(FORCE, SPEED, fine, tilt=TILT)
    assert found["contact_share"].values[0] > 0.1
    assert found["friction_power"].values == pytest.approx(rest.friction_power, rel=0.015)
    assert found["minimum_film"].values == pytest.approx(rest.minimum_film, rel=0.005)
