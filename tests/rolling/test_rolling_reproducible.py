"""Compiled anew or read from the cache, a bearing gives the same numbers to the last bit."""

import os
import subprocess
import sys

import pytest

SCRIPT = """
import hashlib
import numpy as np
from loadflow.rolling import FlexibleRings, RingBeam, RingSection, RollerBearing, SlewingBearing

ball = SlewingBearing(
    balls=45, rows=1, ball_diameter=0.04, pitch_diameter=1.0, groove_radius=0.0205,
    contact_angle=0.8)
roller = RollerBearing(
    rollers=40, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.8, contact_angle=0.35,
    rows=2, row_spacing=0.12)
section = RingSection(area=4e-3, inertia_axial=3e-6, inertia_radial=2e-6, torsion=2e-6)
rings = FlexibleRings(outer=RingBeam(section=section, radius=0.55))
rng = np.random.default_rng(0)
force, moment = rng.normal(0, 1e5, (40, 3)), rng.normal(0, 3e4, (40, 2))
found = [
    ball.equilibrium(force=force, moment=moment),
    ball.equilibrium(force=force, moment=moment, rings=rings),
    roller.equilibrium(force=np.abs(force), moment=0.1 * moment),
]
for answer in found:
    print(hashlib.sha256(np.ascontiguousarray(answer.displacement).tobytes()).hexdigest())
    print(hashlib.sha256(np.ascontiguousarray(answer.stiffness).tobytes()).hexdigest())
"""


def numbers(cache):
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT],
        env=os.environ | {"NUMBA_CACHE_DIR": str(cache)},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.split()


@pytest.mark.slow
def test_cold_and_warm_cache_give_the_same_numbers(tmp_path):
    cold = numbers(tmp_path)
    assert len(set(cold)) == 6
    assert numbers(tmp_path) == cold
    for pattern in ("*solve_series*", "*_newton*", "*evaluate*"):
        for part in list(tmp_path.rglob(pattern)):
            part.unlink()
        assert numbers(tmp_path) == cold
