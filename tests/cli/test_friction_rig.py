"""The friction rig on the command line: what is measured, what is calculated, what is refused."""

import json

import numpy as np
import pytest

from loadflow.cli import main
from loadflow.errors import InputError
from loadflow.studies.one_bearing.crank_rig import CrankRig
from loadflow.studies.one_bearing.rig import measured_torques, rig_torques

DRIVE = CrankRig().drive
RPM = 954.93  # 100 rad/s
DAMPING = 3.0  # N s/m


def _rig(path, angle, column, sense=1.0, rpm=RPM):
    """A file of a rig whose piston has inertia and a damper."""
    motion = DRIVE.piston(np.radians(angle), rpm * np.pi / 30)
    force = sense * DAMPING * motion.speed - 1.5 * motion.acceleration
    other = angle if column == "angle" else motion.speed
    lines = [f"{rpm}, {x:.9g}, {f:.9g}" for x, f in zip(other, force, strict=True)]
    path.write_text("\n".join(["# a test", f"rpm, {column}, force", *lines]), encoding="utf-8")
    return path


@pytest.mark.parametrize("column", ["angle", "velocity"])
def test_a_damper_on_the_piston_is_measured_whatever_its_inertia(tmp_path, column):
    angle = np.arange(720.0)
    found = measured_torques(_rig(tmp_path / "rig.csv", angle, column), DRIVE)
    omega, r, ratio = RPM * np.pi / 30, DRIVE.radius, DRIVE.ratio
    # mean of (sin φ + λ/2 sin 2φ + …)²: the rod adds λ²/8 and less
    closed = DAMPING * r**2 * omega / 2 * (1 + ratio**2 / 4)
    assert found[RPM] == pytest.approx(closed, rel=2e-3)


def test_each_speed_of_a_file_is_a_series_and_stands_beside_what_is_calculated(tmp_path):
    angle = np.arange(0.0, 360.0, 2.0)
    first = _rig(tmp_path / "first.csv", angle, "angle", rpm=1000.0).read_text("utf-8")
    second = _rig(tmp_path / "second.csv", angle, "angle", rpm=2000.0).read_text("utf-8")
    both = tmp_path / "both.csv"
    both.write_text(first + "\n" + "\n".join(second.splitlines()[2:]), encoding="utf-8")
    rows = rig_torques(CrankRig(), (), "coulomb", both)
    assert [row["rpm"] for row in rows] == [1000.0, 2000.0]
    assert rows[1]["measured"] == pytest.approx(2 * rows[0]["measured"])
    for row in rows:
        parts = {k: v for k, v in row.items() if k not in ("rpm", "torque", "measured", "off")}
        assert sum(parts.values()) == pytest.approx(row["torque"])
        assert row["off"] == pytest.approx(row["torque"] / row["measured"] - 1)


@pytest.mark.parametrize(
    ("angle", "column", "sense", "words"),
    [
        (np.arange(500.0), "angle", 1.0, "turns of the crank; they must be whole"),
        (np.arange(500.0), "velocity", 1.0, "turns must be whole"),
        (np.arange(720.0), "angle", -1.0, "not a loss"),
        (np.arange(720.0)[::-1], "angle", 1.0, "even steps"),
    ],
)
def test_series_that_measure_no_friction_are_refused(tmp_path, angle, column, sense, words):
    file = _rig(tmp_path / "rig.csv", angle, column, sense)
    with pytest.raises(InputError, match=f"rig.csv, 954.93 1/min.*{words}"):
        measured_torques(file, DRIVE)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("rpm, force\n1000, 1", r"no column velocity \(or angle\); there are rpm, force"),
        ("speed, velocity\n1, 2", "no column rpm, force"),
        ("rpm, force, velocity\n1000, 1, 1\n1000, x, -1", "line 2 of the series, force"),
        ("rpm, force, velocity\n-5, 1, 1\n-5, -1, -1", "rpm must be > 0"),
        ("rpm, force, velocity\n", "no samples below the heads"),
        ("", "No columns"),
    ],
)
def test_files_that_are_no_series_of_a_rig_are_refused(tmp_path, text, words):
    file = tmp_path / "rig.csv"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=words):
        measured_torques(file, DRIVE)
    with pytest.raises(InputError, match="No such file"):
        measured_torques(tmp_path / "none.csv", DRIVE)


def test_a_speed_must_be_stated_or_measured(tmp_path):
    with pytest.raises(InputError, match="no speed"):
        rig_torques(CrankRig(), (), "coulomb")
    file = _rig(tmp_path / "rig.csv", np.arange(360.0), "velocity")
    with pytest.raises(InputError, match="no series at 800 1/min; there are 954"):
        rig_torques(CrankRig(), (800.0,), "coulomb", file)
    angles = _rig(tmp_path / "angles.csv", np.arange(360.0), "angle")
    with pytest.raises(InputError, match="a straight shaft has no piston"):
        rig_torques(CrankRig(drive=None), (), "coulomb", angles)


def test_the_command_prints_all_parts_of_a_journal_bearing_on_the_pin(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["friction-rig", "--speed-rpm=1000", "--arrangement=journal", "--json"])
    assert stop.value.code == 0
    row = json.loads(capsys.readouterr().out)["rows"][0]
    assert row["pin film"] == pytest.approx(0.0984, rel=5e-3)  # 0.09840 on 192 × 48 cells
    assert row["torque"] > row["pin film"] + row["seal"]


def test_at_rest_the_asperities_of_a_journal_bearing_rub_under_the_weights(capsys):
    with pytest.raises(SystemExit):
        main(["friction-rig", "--speed-rpm=0", "--arrangement=journal", "--json"])
    row = json.loads(capsys.readouterr().out)["rows"][0]
    drive = CrankRig().drive
    weight = 9.81 * (drive.piston_mass + drive.rod_mass)
    assert row["pin asperities"] == pytest.approx(0.12 * weight * 24e-3, rel=5e-3)
    assert row["torque"] == pytest.approx(row["pin asperities"] + row["seal"], rel=1e-3)


def test_each_part_stands_under_its_own_name_at_rest_and_in_motion(capsys):
    with pytest.raises(SystemExit):
        main(["friction-rig", "--speed-rpm=0", "--speed-rpm=1000", "--arrangement=journal"])
    heads, rest, fast = capsys.readouterr().out.splitlines()[-3:]
    assert "pin asperities" in heads
    assert "pin film" in heads
    assert rest.split()[-1] == "–"  # the last, which only the motion has
    assert fast.split()[-1] != "–"
    with pytest.raises(InputError, match="at rest there are no films"):
        rig_torques(CrankRig(), (0.0,), "film")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--load=3e3"], "--load: no effect here"),
        (["--pin", "0.05", "0.02", "1e-3"], "--pin: no effect here"),
        (["--arrangement=straight", "--thrust-share=0.04"], "--thrust-share: no effect here"),
    ],
)
def test_what_an_arrangement_lacks_is_refused(capsys, arguments, words):
    with pytest.raises(SystemExit) as stop:
        main(["friction-rig", "--speed-rpm=1000", *arguments])
    assert stop.value.code == 2
    assert words in capsys.readouterr().err
