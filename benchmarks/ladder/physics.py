"""Which physics matters when: docs/physics.md and its figures.

``sizes`` lets the pilot measure every effect on single wind speeds of three turbines, ``elements``
that of rollers in slices, in a bearing that the scenes of ``sizes`` do not have, ``films`` what
their films do not have, ``lateral`` the coherence of v and w over several seeds, ``rotors`` blades,
tower and the grid of the wind in the same turbulence, ``scenes`` asks the plan of ten scenes what
it keeps, ``runs`` makes whole runs of the main job from the coarsest models to all that there is
and holds their answers against the last. What is measured is kept beside the page in
``docs/figures/physics.json``, so that each part may be measured alone; without a part the page is
written anew from there: ``python -m benchmarks.ladder.physics [PART …]``. A part that was killed
goes on where it was: what it has found waits in ``runs/physics``.
"""

from __future__ import annotations

import json
import time
import tomllib
from collections.abc import Callable
from typing import Any

from benchmarks.common import ROOT, arguments, put
from benchmarks.ladder.__main__ import DOC, WHOLE_RUNS
from benchmarks.ladder.physics_page import (
    draw_front,
    draw_sizes,
    run_table,
    scene_table,
    size_table,
)
from benchmarks.ladder.physics_sizes import (
    BESIDE,
    SHORT,
    STOP,
    THOROUGH,
    TURBINES,
    Found,
    joined,
    scene_of,
    sizes,
)
from benchmarks.ladder.whole_runs import runs
from loadflow.planning.pilot import pilot
from loadflow.planning.plan import make_plan
from loadflow.scene.scene import Scene, read_scene

KEPT = ROOT / "docs" / "figures" / "physics.json"
PAGE = ROOT / "docs" / "physics.md"
BEGUN = ROOT / "runs" / "physics"
"""What parts have found that are not finished."""


def ten_scenes() -> dict[str, Scene]:
    """Power production, start, stop, parked; small and large turbine; stiff and soft housing.

    Shells align themselves, as those of the main job and the sized ones are built to. In shells
    that stay, wide bearings near each other would touch at their ends.
    """
    production = {"wind_speeds": [12.0]} | SHORT
    small, usual, large = TURBINES
    built = {"self_aligning": True}
    running = {"loads": production, "film": built}
    still = {"results": ["loads.statistics", "rolling.loads"], "film": built}
    parked = {"dlc": "6.1"} | SHORT
    stop = tomllib.loads(STOP.read_text(encoding="utf-8"))["bearings"]["N"]
    touching = {key: stop[key] for key in ("contact", "shell")}
    events = {"results": ["journal.film"], "film": built | touching}
    soft = built | {"shell": {"kind": "local", "compliance": 1e-11}}
    return {
        "power production, 1.5 MW": scene_of(small, **running),
        "power production, 5 MW": scene_of(usual, **running),
        "power production, 15 MW": scene_of(large, **running),
        "20 % asked for, 5 MW": scene_of(usual, accuracy=0.2, **running),
        "stiff housing, sized bearings, 5 MW": scene_of(usual, sized=True, **running),
        "soft housing (10 µm/MPa), 5 MW": scene_of(usual, loads=production, film=soft),
        "start, 5 MW": scene_of(usual, loads={"dlc": "3.1", "wind_speeds": [4.0]}, **events),
        "stop, 5 MW": scene_of(usual, loads={"dlc": "4.1", "wind_speeds": [24.0]}, **events),
        "parked, 5 MW": scene_of(usual, loads=parked, **still),
        "parked, 15 MW": scene_of(large, loads=parked, **still),
    }


JOBS = ("quick_look", "dlc_1_1", "dlc_3_1_startup", "dlc_4_2_shutdown", "dlc_6_4_idling")
"""Pipelines whose pilots are measured beside the ten scenes, with all their effects."""


def jobs_asked() -> dict[str, Scene]:
    """The pipelines of `JOBS`, as they are."""
    return {name: read_scene(ROOT / "pipelines" / f"{name}.toml") for name in JOBS}


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
    "runs": runs,
}
"""What is measured."""

SIZES = "## Size over wind speed and turbine"
SCENES = """## Scenes, and what the plan keeps of them

Accuracy of 5 % where nothing else is said; DLC 1.1 at 12 m/s, or as named. After each effect that
the pilot measured: what leaving it out changes most. What a scene has no data for, or what moves
nothing by 0.1 %, is not listed. Written by `python -m benchmarks.ladder.physics scenes`."""
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
had six times as much to do as it has cores, and took half as long again as README says; ratios
count. Written by `python -m benchmarks.ladder.physics runs`."""


def measured(part: str) -> list[dict[str, Any]]:
    """All that a part finds; what an earlier start of it had found is not measured again."""
    begun = BEGUN / f"{part}.json"
    begun.parent.mkdir(parents=True, exist_ok=True)
    found = json.loads(begun.read_text(encoding="utf-8")) if begun.exists() else []
    begun.write_text(json.dumps(found), encoding="utf-8")
    for one in PARTS[part](tuple(found)):
        found.append(one)
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
    told = [
        f"{text}\n\n{table(kept[part])}"
        for part, text, table in (("sizes", SIZES, size_table), ("scenes", SCENES, scene_table))
        if part in kept
    ]
    put(PAGE, "<!-- measured -->", "<!-- end of measured -->", "\n\n".join(told))
    if "sizes" in kept:
        draw_sizes(kept["sizes"])
    if "runs" in kept:
        told = [RUNS, run_table(kept["runs"])]
        put(DOC, *WHOLE_RUNS, "\n\n".join(told))
        draw_front(kept["runs"])


if __name__ == "__main__":
    main()
