"""How near the indicators of effects come to what pilots measured; a table of docs/physics.md.

python -m benchmarks.ladder.indicators [--all]

Measurements are those that ``docs/figures/physics.json`` keeps (`benchmarks.ladder.physics`): of
three turbines at four wind speeds, of ten scenes, and of the pipelines of `JOBS`. Indicators are
computed anew, in a few seconds, so that a change of one shows at once. ``--all`` prints each pair.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from benchmarks.common import arguments, head, row
from benchmarks.ladder import physics_sizes as parts
from loadflow.planning.effects import estimates
from loadflow.planning.plan import needed_stages
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import Scene
from loadflow.stages.effects.effect import Sizes
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.effects.shaft import STIFFNESS
from loadflow.stages.registry import STAGES

COUNTS = 0.01
"""Share of an answer below which nothing hangs on what an indicator says of it."""

PER_PLACE = {
    "sizes": parts.at_work,
    "elements": parts.on_rollers,
    "films": parts.touching,
    "oil": parts.grooved,
    "lateral": parts.realised,
}
"""Scene of a part of the measurements, of a turbine and a wind speed."""


@dataclass(frozen=True)
class Pair:
    """What an indicator says of an answer of a scene, and what was measured."""

    effect: str
    quantity: str
    place: str
    indicated: float
    measured: float

    @property
    def factor(self) -> float:
        """Indicated over measured; of what counts in neither, 1."""
        least = COUNTS / 10.0  # below it neither is told apart from nothing
        return max(self.indicated, least) / max(self.measured, least)

    @property
    def counts(self) -> bool:
        """Whether one of both is worth a decision."""
        return max(self.indicated, self.measured) >= COUNTS


def indicated(scene: Scene) -> dict[str, Sizes]:
    """What the indicators say of a scene, by effect."""
    needed = needed_stages(scene)
    stages = [name for name in STAGES if name in needed]
    return dict(estimates(scene, stages, tuple(list_cases(scene))).indicators)


def pairs(kept: dict[str, Any], scenes: dict[str, Scene]) -> Iterator[Pair]:
    """All that was measured, beside what is indicated.

    Parameters
    ----------
    kept : dict
        Measurements by part.
    scenes : dict
        Scenes and jobs by their names.
    """
    for part, scene_at in PER_PLACE.items():
        for one in kept.get(part, []):
            place = f"{part}, {one['turbine']}, {one['speed']:g} m/s"
            said = indicated(scene_at(one["turbine"], one["speed"]))
            yield from _beside(place, said, one["sizes"])
    for one in kept.get("fed_back", []):
        for seat, sizes in one["sizes"].items():
            scene = parts.on_seat(one["turbine"], one["speed"], parts.SEATS[seat])
            said = indicated(scene)[STIFFNESS.name]
            loads = {name: size for name, size in sizes.items() if name in said}
            yield from _beside(
                f"{seat}, {one['turbine']}", {STIFFNESS.name: said}, {STIFFNESS.name: loads}
            )
    for one in [*kept.get("scenes", []), *kept.get("jobs", [])]:
        found = {effect["name"]: effect["size"] or {} for effect in one["effects"]}
        yield from _beside(one["scene"], indicated(scenes[one["scene"]]), found)


def _beside(place: str, said: dict[str, Sizes], measured: dict[str, Sizes]) -> Iterator[Pair]:
    for effect, sizes in measured.items():
        for quantity, size in sizes.items():
            if effect in said:
                yield Pair(effect, quantity, place, said[effect].get(quantity, 0.0), size)


def indicator_table(found: Iterable[Pair]) -> str:
    """A row for each effect and answer: how often it counts, and the factors."""
    every = list(found)
    lines = [
        head(
            "effect",
            "answer",
            "pairs",
            "smallest",
            "largest",
            "where largest measured over indicated",
            numbers=False,
        )
    ]
    for effect in (one.name for one in EFFECTS):
        ours = [one for one in every if one.effect == effect and one.counts]
        for quantity in dict.fromkeys(one.quantity for one in ours):
            rows = sorted((one for one in ours if one.quantity == quantity), key=lambda p: p.factor)
            low, high = rows[0], rows[-1]
            lines.append(
                row(
                    effect,
                    quantity,
                    len(rows),
                    f"{low.factor:.2g}",
                    f"{high.factor:.2g}",
                    f"{low.place}: {low.indicated:.2g}/{low.measured:.2g}; {high.place}: {high.indicated:.2g}/{high.measured:.2g}",
                )
            )
    return "\n".join(lines)


def main() -> None:
    from benchmarks.ladder.physics import jobs_asked, kept_so_far, ten_scenes

    parser = arguments(__doc__)
    parser.add_argument("--all", action="store_true", help="each pair")
    asked = parser.parse_args()
    found = list(pairs(kept_so_far(), ten_scenes() | jobs_asked()))
    if asked.all:
        for one in found:
            print(one)
    print(indicator_table(found))


if __name__ == "__main__":
    main()
