"""The loop of the rotor is compiled in two halves, which two processes can do at once."""

import os
import subprocess
import sys

import pytest

from loadflow.numerics.references import kind_of
from loadflow.rotor import RotorOptions, loop, simulate
from loadflow.turbines import load_turbine
from loadflow.wind import WindOptions

HALVES = """
from loadflow.rotor import _kernels, loop, simulate
{call}
stats = _kernels.respond.stats
print(sum(stats.cache_hits.values()), sum(stats.cache_misses.values()))
"""


@pytest.mark.parametrize("turbine", ["nrel-5mw", "iea-15mw"])
@pytest.mark.parametrize("options", [RotorOptions(), RotorOptions(modes=(), tower_motion=False)])
def test_the_second_half_is_compiled_for_what_the_loop_hands_on(turbine, options, monkeypatch):
    """… whatever the turbine and its options: `compile_response` asks for neither."""
    handed = []
    march = loop.kernels.march
    monkeypatch.setattr(
        loop.kernels, "march", lambda *given: handed.append(given[1:]) or march(*given)
    )
    winds = WindOptions(radii=3, angles=8)
    simulate(turbine, wind_speed=12, duration=0.1, run_in=0.1, options=options, wind_options=winds)
    plant = load_turbine("nrel-5mw")
    m = loop.machine(plant, RotorOptions())
    kinds = loop.response_kinds(m, loop.controller(plant), 0.025)
    for given in handed:
        found = [kind_of(value) for value in given]
        assert tuple(found[:3] + found[4:5]) == kinds[:4]  # machine, control, schedule, time step
        assert found[8] == kinds[7]  # whether it is controlled
        assert tuple(found[9:17] + found[20:]) == kinds[10:]  # state, room and what is written


@pytest.mark.slow
def test_a_process_finds_the_half_that_another_compiled(tmp_path):
    def told(call):
        environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
        run = subprocess.run(
            [sys.executable, "-c", HALVES.format(call=call)],
            env=environment, capture_output=True, text=True, check=True,
        )  # fmt: skip
        return run.stdout.split()

    assert told("loop.compile_response()") == ["0", "1"]
    assert told("simulate(wind_speed=12, duration=0.1, run_in=0.1)") == ["1", "0"]
