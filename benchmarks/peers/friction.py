"""Motion of rollers: error against time of integrators, and a 600 s series of a main bearing.

``python -m benchmarks.peers.friction``; one core, all rollers of a row, two turns of the cage. The
 error is the largest deviation of the spin from a tight reference, over the ideal spin.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numba import njit

from benchmarks.common import arguments, head, row, seconds_of, timed
from benchmarks.peers.roller_moment import roller_moment
from loadflow.rolling import FrictionOptions, RollerBearing, roller_friction
from loadflow.rolling import friction as parts
from loadflow.rolling.motion import _coulomb_kernels, _motion_kernels
from loadflow.rolling.motion.rollers import (
    coulomb_motion,
    film_arguments,
    film_motion,
    film_numbers,
)
from loadflow.rolling.motion.skidding import roller_slip
from loadflow.tribology import lubricant
from loadflow.validation._friction_motion import ROW, static_load
from loadflow.validation.friction import MAIN

MU, SLIDE = 0.12, 0.04
COULOMB_DRAG = parts.coulomb_drag_constants(MAIN, 26.3e-3, 9 / 22, MU, SLIDE, variant="thesis")
FILM = FrictionOptions(
    oil=lubricant("crankshaft-5w-30"),
    temperature=333.15,
    roller_drag=parts.drag_constants(MAIN, 26.3e-3, 9 / 22).spin,
)
PAIR = RollerBearing(
    rollers=48,
    roller_diameter=0.04,
    roller_length=0.06,
    pitch_diameter=0.8,
    contact_angle=0.35,
    rows=2,
    row_spacing=0.12,
    clearance=50e-6,
    slices=10,
)


@njit(cache=True, error_model="numpy")
def euler_film(film, times, surface, turning, swing, load, outward, tangential, start, parts):
    """Explicit steps of the source's stage 2: `parts` to a sample, held between 0 and 0.999."""
    n, count = load.shape
    spin = np.empty((n, count))
    for j in range(count):
        w = start[j]
        spin[0, j] = w
        for i in range(n - 1):
            h = (times[i + 1] - times[i]) / parts
            for k in range(parts):
                a = _motion_kernels._between(
                    surface, turning, swing, load, outward, tangential, i, j, k / parts
                )
                w += h / film.inertia * roller_moment(film, *a, w)  # type: ignore[call-arg]
                w = min(max(w, 0.0), 0.999 * a[0] / film.radius)
            spin[i + 1, j] = w
    return spin


@njit(cache=True, error_model="numpy")
def euler_coulomb(times, ideal, grip, push, damping, inertia, start, parts):
    """Explicit steps of the source's stage 1: never beyond the ideal spin."""
    n, count = grip.shape
    spin = np.empty((n, count))
    for j in range(count):
        w = start[j]
        spin[0, j] = w
        for i in range(n - 1):
            h = (times[i + 1] - times[i]) / parts
            for k in range(parts):
                s = k / parts
                a = (1 - s) * (grip[i, j] + push[i, j]) + s * (grip[i + 1, j] + push[i + 1, j])
                w = min(w + h / inertia * (a - damping * w), ideal[i])
            spin[i + 1, j] = w
    return spin


def show_integrators(title, rows):
    """Print (name, seconds, error, work) rows as a table."""
    print(f"\n{title}\n\n{head('integrator', 'time, ms', 'error', 'contact pairs', numbers=True)}")
    for name, seconds, error, work in rows:
        print(row(name, f"{seconds * 1e3:.1f}", f"{error:.2e}", work))


def coulomb_table():
    """Stage 1 at 1000/min, 2 kN."""
    from loadflow.rolling.friction import coulomb

    history = static_load(1000, 2e3)
    ideal, n = history.ideal_spin, history.load.size
    exact = coulomb_motion(history, COULOMB_DRAG)
    size = np.abs(history.outward)
    grip = coulomb.driving_moment(history.load, size, 0.0, 0.0, ROW.radius, MU, SLIDE)
    push = np.zeros_like(grip) - COULOMB_DRAG.orbit * history.inner_speed[:, None]
    start = np.full(ROW.rollers, ideal[0])
    args = (history.time, ideal, grip, push, COULOMB_DRAG.spin, ROW.inertia, start)
    rows = []
    for parts_ in (1, 10, 100):
        spin, seconds = timed(lambda p=parts_: euler_coulomb(*args, p), 3, warm=True)
        error = np.abs(spin - exact.spin).max() / ideal[0]
        rows.append((f"Euler, {1 / parts_:g}°", seconds, error, n * parts_))
    exactly = (*args[:4], 0 * grip, *args[4:])
    seconds = seconds_of(lambda: _coulomb_kernels.coulomb_spins(*exactly), 3)
    rows.append(("exact, samples every 1°", seconds, 0.0, n))
    show_integrators("Stage 1, NU2208, 1000/min, 2 kN", rows)


def film_table(rpm, force):
    """Stage 2."""
    from scipy.integrate import solve_ivp

    history = static_load(rpm, force)
    numbers, given, ideal = film_numbers(ROW, FILM), film_arguments(history), history.ideal_spin[0]
    reference = film_motion(history, FILM, tolerance=1e-6).spin
    start = np.full(ROW.rollers, ideal)
    rows = []
    for parts_ in (10, 100):
        followed = partial(euler_film, numbers, *given, start, parts_)  # type: ignore[call-arg]
        spin, seconds = timed(followed, 2, warm=True)
        error = np.abs(spin - reference).max() / ideal
        name = f"Euler, {1 / parts_:g}°, clamped"
        rows.append((name, seconds, error, history.load.size * parts_))
    for tolerance in (3e-2, 3e-3, 3e-4):
        motion, seconds = timed(
            lambda t=tolerance: film_motion(history, FILM, tolerance=t), 3, warm=True
        )
        error = np.abs(motion.spin - reference).max() / ideal
        rows.append(
            (f"implicit, tolerance {tolerance:g}", seconds, error, motion.convergence.iterations)
        )
    rate = lsoda_rate(numbers, given)
    for rtol in (1e-4, 1e-6):
        spent, evaluations, worst = 0.0, 0, 0.0
        for j in (0, 4):  # two rollers stand for all
            path, seconds = timed(
                lambda j=j, rtol=rtol: solve_ivp(
                    rate, given[0][[0, -1]], [ideal], "LSODA", given[0], args=(j,),
                    rtol=rtol, atol=rtol * ideal, max_step=5 * given[0][1],
                )
            )  # fmt: skip
            spent += seconds
            evaluations += path.nfev * ROW.rollers // 2
            worst = max(worst, float(np.abs(path.y[0] - reference[:, j]).max()) / ideal)
        rows.append((f"LSODA, rtol {rtol:g}", spent * ROW.rollers / 2, worst, evaluations))
    show_integrators(f"Stage 2, NU2208, {rpm}/min, {force / 1e3:g} kN", rows)


def lsoda_rate(numbers, given):
    """Rate of one roller's spin, compiled but for the call."""

    @njit
    def rate(t, w, j, times, surface, turning, swing, load, outward, tangential):
        i = min(max(int(t / times[-1] * (times.size - 1)), 0), times.size - 2)
        share = (t - times[i]) / (times[i + 1] - times[i])
        a = _motion_kernels._between(
            surface, turning, swing, load, outward, tangential, i, j, share
        )
        return roller_moment(numbers, *a, w) / numbers.inertia  # type: ignore[call-arg]

    rate(0.0, 1.0, 0, *given)
    return lambda t, w, j: [rate(t, w[0], j, *given)]


def main_bearing():
    """600 s at 20 Hz of a tapered pair, one row of which is unloaded by thrust most of the time."""
    n = 12_001
    t = np.arange(n) / 20
    speed = 1.5 + 0.1 * np.sin(0.1 * t)
    thrust = 2e5 + 8e4 * np.sin(0.3 * t) + 3e4 * np.sin(4.5 * t)
    force = np.stack([2e4 * np.sin(0.7 * t), -2.5e5 + 2e4 * np.sin(0.5 * t), thrust], axis=-1)
    result, balance_time = timed(lambda: PAIR.equilibrium(force=force), warm=True)
    options = FrictionOptions(
        oil=lubricant("lgwm-2"), temperature=313.15, starvation=0.7, roller_drag=1e-5
    )
    ideal_time = seconds_of(lambda: roller_friction(result, speed, options).power)
    print(f"\nMain bearing, 600 s at 20 Hz, 2 × 48 rollers; equilibrium {balance_time:.1f} s\n")
    names = ("largest slip", "mean slip loss, W", "slip loss off by", "spin off by")
    print(head("rung", "time, s", *names, numbers=True))
    print(row("ideal rolling (`roller_friction`)", f"{ideal_time:.1f}", 0, 0, "", ""))
    best = roller_slip(result, t, speed, options, tolerance=3e-5)
    for name, keys in (
        ("Coulomb", {"model": "coulomb"}),
        ("film, tolerance 3e-2", {"tolerance": 3e-2}),
        ("film, tolerance 3e-4", {"tolerance": 3e-4}),
        ("film, tolerance 3e-5 (reference)", {"tolerance": 3e-5}),
    ):
        found, seconds = timed(
            lambda k=keys: roller_slip(result, t, speed, options, **k), warm=True
        )
        loss, most = found.friction.losses["slip"].mean(), best.friction.losses["slip"].mean()
        spin = np.abs(found.slip - best.slip)
        largest = max(m.maximum_slip for m in found.motions)
        print(
            row(
                name,
                f"{seconds:.1f}",
                f"{largest:.2f}",
                f"{loss:.3f}",
                f"{loss / most - 1:+.1%}",
                f"{spin.mean():.1e} mean, {spin.max():.1e} largest",
            )
        )


if __name__ == "__main__":
    arguments(__doc__).parse_args()
    coulomb_table()
    film_table(1000, 2e3)
    film_table(3000, 2e3)
    main_bearing()
