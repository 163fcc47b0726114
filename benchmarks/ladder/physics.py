"""Which physics matters when: docs/physics.md and its figures.

``sizes`` lets the pilot measure every effect on single wind speeds of three turbines, ``elements``
that of rollers in slices, in a bearing that the scenes of ``sizes`` do not have, ``films`` what
their films do not have, ``lateral`` the coherence of v and w over several seeds, ``rotors`` blades,
tower and the grid of the wind in the same turbulence, ``drawn`` and ``held_out`` rings and rollers
of machines drawn by seed, ``scenes`` asks the plan of ten scenes what it keeps, ``runs`` makes
whole runs of the main job from the coarsest models to all that there is
and holds their answers against the last. What is measured is kept beside the page in
``docs/figures/physics.json``, so that each part may be measured alone; without a part the page is
written anew from there: ``python -m benchmarks.ladder.physics [PART …]``. A part that was killed
goes on where it was: what it has found waits in ``runs/physics``. Beside each finding stands the
state of what it was measured on, so that a test tells which are outdated.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable
from typing import Any

from benchmarks.common import ROOT, arguments, put
from benchmarks.ladder.__main__ import DOC, WHOLE_RUNS
from benchmarks.ladder.physics_drawn import held_out, seen
from benchmarks.ladder.physics_losses import loss_table, losses
from benchmarks.ladder.physics_page import (
    draw_front,
    draw_sizes,
    run_table,
    scene_table,
    size_table,
)
from benchmarks.ladder.physics_scenes import jobs_asked, rests_on, ten_scenes
from benchmarks.ladder.physics_sizes import BESIDE, THOROUGH, Found, joined, sizes
from benchmarks.ladder.whole_runs import runs
from loadflow.planning.pilot import pilot
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import Scene

KEPT = ROOT / "docs" / "figures" / "physics.json"
PAGE = ROOT / "docs" / "physics.md"
BEGUN = ROOT / "runs" / "physics"
"""What parts have found that are not finished."""


def scenes(known: Found) -> Found:
    """What the plan keeps of each of the ten scenes after its pilot, and why."""
    yield from _verdicts(ten_scenes(), known)


def jobs(known: Found) -> Found:
    """The same of the pipelines of `JOBS`."""
    yield from _verdicts(jobs_asked(), known)


def _verdicts(asked: dict[str, Scene], known: Found) -> Found:
    """What a pilot with all questions measures of scenes, and what the plan then keeps."""
    done = {one["scene"] for one in known}
    for name, scene in asked.items():
        if name in done:
            continue
        begun = time.process_time()
        plan = make_plan(scene, [], pilot(scene, effort=THOROUGH))
        print(name, f"{time.process_time() - begun:.0f} s", flush=True)
        yield {
            "scene": name,
            "asked": scene.accuracy,
            "effects": [
                {"name": one.name, "kept": one.kept, "why": one.why, "size": one.size}
                for one in plan.effects
            ],
            "rungs": {step.name: step.rung for step in plan.steps},
            "errors": plan.errors,
            "accurate": plan.accurate,
        }


# --- the page -------------------------------------------------------------------------------------


PARTS: dict[str, Callable[[Found], Found]] = {
    "sizes": sizes,
    **BESIDE,
    "scenes": scenes,
    "jobs": jobs,
    "losses": losses,
    "drawn": seen,
    "held_out": held_out,
    "runs": runs,
}
"""What is measured."""

SIZES = "## Size over wind speed and turbine"
SCENES = """## Scenes, and what the plan keeps of them

Accuracy of 5 % where nothing else is said; DLC 1.1 at 12 m/s, or as named. After each effect that
the pilot measured: what leaving it out changes most. What a scene has no data for, or what moves
nothing by 0.1 %, is not listed. Written by `python -m benchmarks.ladder.physics scenes`."""
LOST = """## Friction of rolling bearings

What rigid rings, and whole rollers, change of the friction of all sized arrangements: the most over
three turbines, each bearing as warm as the housing that comes with it leaves it (60 s of one seed).
Of a slip, itself a share, it is the difference. Less than 1 % is not listed. Written by `python -m
benchmarks.ladder.physics losses`."""
TABLES = (
    ("sizes", SIZES, size_table),
    ("scenes", SCENES, scene_table),
    ("losses", LOST, loss_table),
)
RUNS = """## Whole runs

Time against error of whole runs, pilot and check at the end included: the main job
(`pipelines/dlc_1_1.toml`, README's command) at 4, 8, 12, 16, 20 and 24 m/s with one of its six
seeds, so 6 of its 66 load cases, with series of full length, by ever better models. *Measured* is
the processor time of that, kernels compiled; *main job* that of all 66 load cases, by what is done
once and what each load case took, *one seed* that of 11; *relative* of the main job's. Errors are
differences from the answers of the best run: damage of N's vertical force, mean over the load
cases; thinnest film of the collar and of N and N2; largest ε of both; mean friction; largest force
of a roller; life of M. All have the same winds, on 11 × 144 points as the plan of the main job
takes them, as a seed on another grid is another wind: what a finer grid changes is a row of
[physics.md](physics.md). What seeds scatter comes on top, the more the fewer there are. The machine
had five times as much to do as it has cores; ratios count. Written by
`python -m benchmarks.ladder.physics runs`."""


RESTS_ON = "rests_on"
"""Key of what is kept, under which stands the state of the scenes that it was measured on."""


def outdated(kept: dict[str, Any]) -> list[str]:
    """What is kept of scenes, machines or turbines that have changed since it was measured."""
    names = ("turbine", "speed", "scene", "run")
    return [
        ", ".join([part, *(str(one[name]) for name in names if name in one)])
        for part, found in kept.items()
        for one in found
        if one.get(RESTS_ON) != rests_on(part, one)
    ]


def measured(part: str) -> list[dict[str, Any]]:
    """All that a part finds; what an earlier start of it had found is not measured again."""
    begun = BEGUN / f"{part}.json"
    begun.parent.mkdir(parents=True, exist_ok=True)
    found = json.loads(begun.read_text(encoding="utf-8")) if begun.exists() else []
    begun.write_text(json.dumps(found), encoding="utf-8")
    for one in PARTS[part](tuple(found)):
        found.append(one | {RESTS_ON: rests_on(part, one)})
        begun.write_text(json.dumps(found, indent=1), encoding="utf-8")
    return found


def kept_so_far() -> dict[str, Any]:
    """What was measured, by part."""
    return json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}


def main() -> None:
    """Measure the parts asked for, and write the page."""
    parser = arguments(__doc__)
    parser.add_argument("parts", nargs="*", choices=[[], *PARTS], help="what to measure anew")
    asked = parser.parse_args().parts
    for part in asked:
        found = measured(part)
        KEPT.write_text(json.dumps(kept_so_far() | {part: found}, indent=1), encoding="utf-8")
        (BEGUN / f"{part}.json").unlink()
    kept = kept_so_far()
    kept["sizes"] = joined(kept)
    told = [f"{text}\n\n{table(kept[part])}" for part, text, table in TABLES if part in kept]
    put(PAGE, "<!-- measured -->", "<!-- end of measured -->", "\n\n".join(told))
    if "sizes" in kept:
        draw_sizes(kept["sizes"])
    if "runs" in kept:
        told = [RUNS, run_table(kept["runs"])]
        put(DOC, *WHOLE_RUNS, "\n\n".join(told))
        draw_front(kept["runs"])


if __name__ == "__main__":
    main()
