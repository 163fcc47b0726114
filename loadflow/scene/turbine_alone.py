"""A turbine file given in place of a scene: its loads, in a few short cases."""

from __future__ import annotations

from pathlib import Path
from typing import Any

WINDIO = (".yaml", ".yml")
"""Endings of windIO files, which are no scenes."""


def scene_of(turbine: Path) -> dict[str, Any]:
    """Return a scene, as data, of a turbine alone: three wind speeds, two seeds, 120 s each.

    Nobody knows its bearings yet, so that it asks for loads, at its own main bearings where the
    file places them, and for no film and no life.

    Examples
    --------
    >>> from pathlib import Path
    >>> from loadflow.scene.turbine_alone import scene_of
    >>> scene_of(Path("own/IEA-22-280-RWT.yaml"))["turbine"]
    {'file': 'IEA-22-280-RWT.yaml'}
    """
    return {
        "name": turbine.stem,
        "results": ["loads.statistics", "seeds.equality", "reduction.histogram"],
        "turbine": {"file": turbine.name},
        "loads": {"wind_speeds": [8.0, 12.0, 18.0], "seeds": 2, "duration": 120.0},
    }
