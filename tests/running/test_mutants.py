"""Files that are damaged at random: an answer, or an `InputError`; never anything else."""

import re
from pathlib import Path

import pytest

from benchmarks.robustness import mutants
from loadflow.errors import InputError
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import make_scene
from loadflow.turbines import load_turbine, turbine_names

FILE = Path(load_turbine.__code__.co_filename).parent / "nrel-5mw.toml"


@pytest.mark.parametrize("kind", ["scenes", "turbines"])
def test_of_80_mutants_none_escapes(kind):
    met, escaped = mutants.survey(kind, range(80))
    assert escaped == []
    assert min(met["refused"], met["answered"]) > 3  # neither all good nor all bad


@pytest.mark.slow
@pytest.mark.parametrize("kind", mutants.KINDS)
def test_of_10_000_mutants_none_escapes(kind):
    assert mutants.survey(kind, range(10_000))[1] == []


@pytest.mark.parametrize(
    ("table", "value", "says"),
    [
        ("rolling", {"arrangement": ["moment"]}, "arrangement: must be one of two-spherical"),
        ("rolling", {"arrangement": 3}, "arrangement: must be one of two-spherical"),
        (
            "rolling",
            {"inner_ring": {"section": {"width": 0.1, "height": 1e200}, "radius": 0.9}},
            "height: must be > 0 and at most 1000 m, got 1e\\+200",
        ),
        (
            "rolling",
            {"inner_ring": {"section": {"width": 0.1, "height": 0.1}, "radius": 1e154}},
            "radius",
        ),
        ("loads", {"duration": 1e300}, "loads.duration = 1e\\+300: must be less than or equal"),
        ("loads", {"seeds": 2**80}, "loads.seeds"),
        ("loads", {"first_seed": 2**80}, "loads.first_seed"),
        ("loads", {"wind_speeds": [1e308]}, "loads.wind_speeds"),
        ("loads", {"step": 1e-300}, "loads.step"),
        ("turbine", 1e300, "turbine = 1e\\+300: must be a table"),
        ("journal", {"heat": "warm"}, "journal.heat = 'warm': kind must be one of balance, film"),
        ("journal", {"heat": [1.0]}, "journal.heat = \\[1.0\\]: kind must be one of balance, film"),
        ("journal", {"cavitation": 1e9}, "journal.cavitation: 1000000000.0 is not allowed: a kind"),
        ("journal", {"cavitation": {"kind": [1]}}, "kind = \\[1\\] is not allowed: gas-mixture"),
    ],
)
def test_sizes_and_kinds_are_checked_before_anything_is_planned(table, value, says):
    with pytest.raises(InputError, match=says):
        make_plan(make_scene({"name": "x", table: value}))


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        (
            "integral_gain",
            "[1.0, 2.0]",
            "control.integral_gain = (1.0, 2.0): must be a valid number",
        ),
        ("integral_gain", '"high"', "control.integral_gain = 'high': must be a valid number"),
        (
            "proportional_gain",
            "1" + "0" * 400,
            "control.proportional_gain = inf: must be a finite number",
        ),
        ("rated_power", "inf", "rated_power = inf: must be a finite number"),
    ],
)
def test_turbine_values_of_the_wrong_kind_are_named(tmp_path, old, new, says):
    assert "nrel-5mw" in turbine_names()
    lines = FILE.read_text(encoding="utf-8").splitlines()
    changed = [f"{old} = {new}" if line.split("=")[0].strip() == old else line for line in lines]
    assert changed != lines
    path = tmp_path / "turbine.toml"
    path.write_text("\n".join(changed), encoding="utf-8")
    with pytest.raises(InputError, match=re.escape(says)):
        load_turbine(path)
