"""Kernels are compiled once, before the load cases: the first run on a machine does not do it in
every process at once.

numba keeps compiled kernels on the disk, but what they are compiled for is known only when they
are called. So the questions of the pilot are asked of a load case in miniature first: one process
simulates the first load case of the run, while another compiles a half of the rotor's loop for it,
takes made-up loads through films, and the first that is free through contacts, through simpler
films, if their loops are others, or through stages that no question is about. The plan's own stages
follow in the same way. What is compiled there, all workers then load. Marks beside numba's files
tell the next run that this is done.
"""

from __future__ import annotations

import hashlib
import logging
import os
import platform
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from itertools import product
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.cube import make_case
from loadflow.numerics.collections import few_collections
from loadflow.planning.effects import switched
from loadflow.planning.pilot import Questions, measure
from loadflow.planning.plan import Plan
from loadflow.running.cases import do_case, is_ready, open_inputs
from loadflow.running.code_stamp import code_stamp
from loadflow.running.compiling import Compiling
from loadflow.running.executor import Executor
from loadflow.running.folder import part_file
from loadflow.running.parts import digest_of, is_sound, save_part
from loadflow.running.telling import Task, times_left
from loadflow.scene.cases import Case
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.probes import PROBES
from loadflow.stages.registry import STAGES

log = logging.getLogger("loadflow.run")

SAMPLES = 160
"""Length of the made-up series: enough for the reduction to keep a few samples."""

DURATION = 1.0
"""Length of a series that questions are asked of, after its run-in, s."""

SWING = 0.7
"""Swing of the weight in that series, over the weight."""

SIMPLER = ", simpler"
"""Ends the name of a job that takes a model without the effects that have kernels of their own."""

SECONDS = {
    "rolling": 29.0,
    "journal": 20.0,
    "loads": 14.0,
    "thrust": 10.0,
    f"journal{SIMPLER}": 10.0,
    "rotor": 8.0,
    "shaft": 1.0,
}
"""Expected processor time of the jobs, s; `QUICK` of the others. Tells which come first, and how
much is left. As the main job takes on an idle core; its films 10, those with asperities thrice."""

QUICK = 5.0

Say = Callable[[str, int, int], None]

WHAT = "making kernels ready, compiled once on this machine"
"""What is said of it, beside how many of its jobs are done."""

AS_CALLED = "compiling kernels as they are called, about a minute, once on this machine"
"""What a process alone says of it."""

ROTOR = "rotor"
"""Job of the half of the rotor's loop that the job of the loads needs when its own is compiled."""

OTHER = "other"
"""Job of the stages after the loads."""

EARLY = ".early-"
"""Begins the name of a folder, in that of the run, of loads simulated before models are decided."""


def compile_for_pilot(
    questions: Questions, expected: Callable[[], Plan], where: Executor, say: Say, folder: Path
) -> None:
    """Compile what the questions of a pilot call, each model in a process of its own.

    The rotor comes first: all that is asked needs its loads, even where no question is about them.
    It is compiled by the loads of a case of the run, which are kept in `folder` for `adopt`, while
    another process compiles half of its loop, see `loadflow.rotor.loop.compile_response`. One
    more job takes the stages that no question is about, by the plan that is `expected` before the
    pilot. What the plan after the pilot calls beside these, `compile_kernels` compiles.

    A model with loops for some of its effects and others without them is two jobs: what both ask
    at last, the shorter one has compiled by then.
    """
    scene, models = questions.scene, questions.models
    rungs = [one.text_of(scene) for name in models for one in STAGES[name].models]
    marks = _marks((rungs, sorted(questions.effects), scene.results))
    if _is_done(marks, where):
        return
    with tempfile.TemporaryDirectory(prefix="loadflow-") as place:
        early = Path(tempfile.mkdtemp(prefix=EARLY, dir=folder))
        folders = {"loads": early, OTHER: Path(place)}
        work = partial(_for_pilot, questions=questions, plan=expected(), folders=folders)
        simulated = ("loads", ROTOR) if scene.loads.source == "simulate" else ()
        simpler = (f"{name}{SIMPLER}" for name in models if without_own_kernels(questions, name))
        _compile(work, {*simulated, *models, *simpler, OTHER}, marks, where, say)


def without_own_kernels(questions: Questions, model: str) -> Questions | None:
    """Questions about a model without the effects that have kernels of their own, if it has any.

    None where one of these is never asked to be out, but to have no size; and where films without
    them have the same loops.
    """
    ours = [one for one in EFFECTS if one.probed == model and one.name in questions.effects]
    if any(one.muted(switched(questions.scene, one, True) or questions.scene) for one in ours):
        return None
    asked = tuple(one.name for one in ours if not one.own_kernels)
    scene = questions.scene
    for effect in ours:
        if effect.own_kernels:
            scene = switched(scene, effect, False) or scene
    same = model == "journal" and _share_loops(questions.scene.journal, scene.journal)
    if not asked or scene is questions.scene or same:
        return None
    return replace(questions, scene=scene, effects=asked)


def _share_loops(full: Journal, bare: Journal) -> bool:
    """Whether films have the same compiled loops with some effects and without.

    On "reduced" those around a tilted shaft do, but for a shell that gives way all over.
    """
    shells = [full.at(name).shell for name in full.bearings if bare.at(name).shell is None]
    all_over = any(shell is not None and not shell.local for shell in shells)
    return bare.rung == "reduced" and bare.tilt and not all_over


@contextmanager
def told_as_called(where: Executor, say: Say) -> Iterator[None]:
    """Say once that kernels are being compiled, where a process alone does so between its work."""
    if where.workers > 1:
        yield
        return
    with Compiling(began=lambda: say(AS_CALLED, 0, 1)) as compiling:
        yield
    if compiling.seconds:
        say(AS_CALLED, 1, 1)


def adopt(folder: Path, plan: Plan) -> None:
    """Take the early parts into the run where its plan has their settings; drop the others."""
    for early in folder.glob(f"{EARLY}*"):
        if early.is_symlink():
            continue
        for step, case in product(plan.of_scope("case"), plan.cases):
            part, target = part_file(early, step.name, case), part_file(folder, step.name, case)
            fits = part.is_file() and digest_of(part) == step.digest and is_sound(part)
            if fits and not target.exists():
                part.replace(target)
        shutil.rmtree(early, ignore_errors=True)


def compile_kernels(plan: Plan, where: Executor, say: Say, folder: Path) -> None:
    """Compile what the stages of a plan need, where that has not been done on this machine.

    The rotor is compiled by the loads of the first case in `folder` that lacks them. A single
    process compiles a kernel when it first calls it, and machines of a cluster have files of their
    own: neither gains by this.
    """
    jobs = {"loads", ROTOR, OTHER} if plan.scene.loads.source == "simulate" else {OTHER}
    needed = [(step.name, step.rung) for step in plan.steps]
    marks = _marks((needed, sorted(plan.left_out)))
    if _is_done(marks, where):
        return
    with tempfile.TemporaryDirectory(prefix="loadflow-") as place:
        folders = {"loads": folder, OTHER: Path(place)}
        work = partial(_of_plan, plan=plan, folders=folders)
        _compile(work, jobs, marks, where, say)


def _is_done(marks: list[Path], where: Executor) -> bool:
    """Whether there is nothing to do: a mark tells it, or the place is none for it.

    A process alone compiles a kernel when it first calls it, see `told_as_called`.
    """
    return where.workers < 2 or not where.shares_disk or any(mark.exists() for mark in marks)


def _compile(
    work: Callable[[str], str], jobs: set[str], marks: list[Path], where: Executor, say: Say
) -> None:
    """Have all jobs done, and mark that they are.

    The loads and the half of the rotor that they need begin, so that a case of the run has its
    loads soon; then the longest job comes first. So contacts are done before the other stages,
    which solve them, too, and compile nothing twice.
    """
    seconds = {job: SECONDS.get(job, QUICK) for job in jobs}

    def rank(job: str) -> tuple[bool, float, str]:
        return job not in ("loads", ROTOR), -seconds[job], job

    in_order = sorted(jobs, key=rank)
    left = times_left([seconds[job] for job in in_order], where.workers)
    log.info("%s: %s", WHAT, ", ".join(in_order))
    begun = time.perf_counter()
    say(Task(WHAT, left[0]), 0, len(jobs))
    for done, (job, told) in enumerate(where.outcomes(work, in_order), 1):
        took = time.perf_counter() - begun
        log.info("compiled: %s after %.0f s%s", job, took, f"; {told}" if told else "")
        say(Task(WHAT, left[done]), done, len(jobs))
    for mark in marks:
        with suppress(OSError):
            mark.parent.mkdir(exist_ok=True)
            mark.touch()
            break


def _for_pilot(job: str, questions: Questions, plan: Plan, folders: dict[str, Path]) -> str:
    """Do one job of `compile_for_pilot`; loads of a case are simulated before they are asked of."""
    told = ""
    if job == ROTOR or job in folders:
        asked = set(questions.models) - {"loads", "shaft"}  # the others need them; soon done
        steps = tuple(step for step in plan.steps if step.name not in asked)
        told = _of_plan(job, replace(plan, steps=steps), folders)
    model = job.removesuffix(SIMPLER)
    mine = without_own_kernels(questions, model) if job != model else questions
    if told or mine is None or model not in mine.models:
        return told
    return _asked_in_miniature(model, mine)


def _asked_in_miniature(model: str, questions: Questions) -> str:
    """Ask those of one model on a case in miniature."""
    given = {}
    try:
        case = questions.cases[0]
        ours = questions.of_model(model, DURATION)
        if PROBES[model].reads:
            given["loads"] = made_up_loads(questions.scene, case)
        with few_collections():
            return "; ".join(measure(ours, case, given).refused.values())
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def _of_plan(job: str, plan: Plan, folders: dict[str, Path]) -> str:
    """Run stages on one case; what fails here is told by the run itself."""
    try:
        with few_collections():
            if job == ROTOR:
                from loadflow.rotor.loop import compile_response

                compile_response()
                return ""
            do = _first_loads if job == "loads" else _in_miniature
            return "; ".join(do(plan, folders[job]).values())
    except Exception as error:
        return f"{type(error).__name__}: {error}"


def _first_loads(plan: Plan, folder: Path) -> dict[str, str]:
    """Simulate the first case whose loads are not in the folder; return failures."""
    first = next(step for step in plan.steps if not step.needs)
    (folder / first.name).mkdir(parents=True, exist_ok=True)
    lacking = (case for case in plan.cases if not part_file(folder, first.name, case).exists())
    case = next(lacking, None)
    return {} if case is None else do_case(case, plan.scene, (first,), folder).failures


def _in_miniature(plan: Plan, folder: Path) -> dict[str, str]:
    """Take made-up loads through the stages of a plan; return failures."""
    scene, case = _short(plan.scene), plan.cases[0]
    small = replace(plan, scene=scene, cases=(case,))
    for step in small.of_scope("case"):
        (folder / step.name).mkdir(parents=True)
    first = next(step for step in small.steps if not step.needs)
    series = made_up_loads(scene, case)
    save_part(series, part_file(folder, first.name, case), first.digest)
    failed = do_case(case, scene, tuple(small.of_scope("case")), folder).failures
    for step in small.of_scope("run"):
        if is_ready(step, case, folder):
            inputs = {case.name: open_inputs(step, case, folder)}
            step.stage.run(scene, [case], inputs)
    return failed


def _short(scene: Scene) -> Scene:
    # made-up loads lie neither between the times of a scene nor in the classes of its cube
    plain = scene.reduction.model_copy(update={"between": None, "grid": "each"})
    scene = scene.model_copy(update={"reduction": plain})
    if scene.loads.source != "simulate":
        return scene
    loads = scene.loads.model_copy(update={"duration": DURATION})
    return scene.model_copy(update={"loads": loads})


def made_up_loads(scene: Scene, case: Case) -> xr.Dataset:
    """Hub loads of about the right size, as the stage of the loads gives.

    They wander far enough that some of them are light: of films that carry no sample for certain,
    other solvers are asked, which load cases do not call.
    """
    from loadflow.turbines import load_turbine

    plant = load_turbine(scene.turbine.name)
    speed = plant.control.rated_speed / plant.drivetrain.gear_ratio
    weight = 9.81 * (plant.rotor_mass + plant.rotor.hub_mass)
    torque = plant.rated_power / speed
    thrust = 0.75 * plant.rated_power / plant.rated_wind_speed
    time = scene.loads.step * np.arange(SAMPLES)
    wave = np.sin(2 * np.pi * np.linspace(0, 3, SAMPLES))
    mean, swing = (
        np.array([thrust, 0.0, -weight]),
        np.array([0.1 * thrust, 0.02 * weight, -SWING * weight]),
    )
    series = make_case(
        time,
        {
            "speed": speed * (1 + 0.02 * wave),
            "pitch": 0.1 + 0.01 * wave,
            "azimuth": np.mod(speed * time, 2 * np.pi),
            "wind": case.wind_speed + wave,
            "hub_force": mean[:, None] + swing[:, None] * wave,
            "hub_moment": torque * np.array([[1.0], [0.2], [0.1]]) * (1 + 0.3 * wave),
        },
        dlc=case.dlc,
        wind_speed=case.wind_speed,
        seed=case.seed,
    )
    return series.assign_coords(weight=case.weight, tripped=np.nan).astype("float32")


def _marks(needed: object) -> list[Path]:
    """Where the mark of these kernels may be, in the order in which numba chooses its folder."""
    machine = (platform.machine(), platform.processor(), sys.version, version("numba"))
    told = hashlib.sha256(repr((code_stamp(), needed, machine)).encode())
    name = f"loadflow-{told.hexdigest()[:24]}.compiled"
    return [folder / name for folder in kernel_folders()]


def kernel_folders() -> list[Path]:
    """Folders beside numba's files, in the order in which it chooses."""
    if chosen := os.environ.get("NUMBA_CACHE_DIR"):
        return [Path(chosen)]
    inside = Path(__file__).parent / "__pycache__"
    # it is missing where Python is told to write no bytecode, as it is in many containers
    place = inside if inside.exists() else inside.parent
    return [inside] if os.access(place, os.W_OK) else []
