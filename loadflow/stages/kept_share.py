"""How much of a series the reduction leaves: what the stages after it expect to solve."""

from __future__ import annotations

from loadflow.scene.scene import Scene
from loadflow.stages.stage import Measured


def kept_share(scene: Scene, measured: Measured) -> float:
    """Share of the series that is left; classes that keep one sample at least make it larger."""
    known = measured(scene, "reduction") or {}
    return min(1.0, scene.reduction.size * known.get("samples_over_wanted", 1.0))
