"""The page on turbine files explains every key, and none that is not there."""

import re
from dataclasses import fields
from pathlib import Path

from loadflow.turbines import Control, Drivetrain, RotorGeometry, Supervision
from loadflow.turbines.description import (
    AirfoilTable,
    BendingTable,
    BladeTable,
    TowerTable,
    TurbineFile,
)

PAGE = Path(__file__).parents[2] / "docs" / "turbine-files.md"
TABLES = {"rotor", "tower", "drivetrain", "control", "supervision", "blade", "airfoils", "bending"}


def keys():
    """All keys of a turbine's file."""
    models = (TurbineFile, TowerTable, BendingTable, BladeTable, AirfoilTable)
    found = {name for model in models for name in model.model_fields}
    parts = (RotorGeometry, Drivetrain, Control, Supervision)
    return (found | {field.name for part in parts for field in fields(part)}) - TABLES


def test_every_key_of_a_turbine_file_is_explained():
    rows = PAGE.read_text(encoding="utf-8").split("## Keys")[1]
    firsts = [line.split("|")[1] for line in rows.splitlines() if line.startswith("| ")]
    told = {name for cell in firsts for name in re.findall(r"`(\w+)`", cell)}
    assert keys() - told == set()
    assert told - keys() == set()
