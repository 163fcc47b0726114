"""Speed of the equilibrium: ratio to batched NumPy, 24,000 steps, flexible rings.

Run with ``python -m benchmarks.peers.rolling [--json]``. One core; ratios come from one run.
"""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np

from benchmarks.common import arguments, show, timed
from loadflow.rolling import FlexibleRings, RollerBearing, SlewingBearing, legs
from loadflow.rolling.rings.condensation import ring_modes
from loadflow.scene.scene import Rolling
from loadflow.validation._slewing_cases import SPECTRUM

PITCH = SlewingBearing(
    balls=147,
    rows=2,
    ball_diameter=0.080,
    pitch_diameter=4.69,
    groove_radius=0.0416,
    contact_angle=math.pi / 4,
    row_spacing=0.1,
)
BLADE = SlewingBearing(
    balls=129,
    rows=2,
    ball_diameter=0.040,
    pitch_diameter=1.9,
    groove_radius=0.0205,
    contact_angle=math.pi / 4,
    row_spacing=0.06,
)
MAIN = RollerBearing(
    rollers=48,
    roller_diameter=0.04,
    roller_length=0.06,
    pitch_diameter=0.8,
    contact_angle=0.35,
    rows=2,
    row_spacing=0.12,
    clearance=-20e-6,
)


def numpy_newton(contacts, loads, tolerance=1e-8, limit=60):
    """Newton over all cases at once with NumPy arrays; the same energy, tangent and step cap."""
    c, s = np.cos(contacts.azimuth), np.sin(contacts.azimuth)
    radius, height, ar, az, free, gap, stiff = (column[:, None] for column in contacts.table.T)
    zero = np.zeros((len(contacts.table), len(c)))
    radial = np.stack([c + zero, s + zero, zero, -height * s, height * c])
    along = np.stack([-s + zero, c + zero, zero, -height * c, -height * s])
    axial = np.stack([zero, zero, zero + 1, radius * s, -radius * c])
    scale = contacts.scale
    basis = (np.stack([radial, along, axial]) * scale[:, None, None]).reshape(3, 5, -1)
    ar, az, free, gap, stiff = ((v + zero).ravel() for v in (ar, az, free, gap, stiff))
    target = loads * scale
    shape = contacts.unit_compliance() / scale[:, None] / scale
    q = target @ shape.T
    q *= 0.1 * contacts.cap / np.abs(q).max(axis=1, keepdims=True)
    todo = np.arange(len(loads))
    reference = np.abs(target).max(axis=1)
    for _ in range(limit):
        u = np.einsum("kac,na->knc", basis, q[todo])
        stretch = 2 * (ar * u[0] + az * u[2]) + (u**2).sum(axis=0) + gap
        vector = np.stack([ar + u[0], u[1], az + u[2]])
        length = np.sqrt((vector**2).sum(axis=0))
        delta = np.maximum(stretch, 0) / (length + free)
        force = stiff * delta**1.5
        normal = vector / length
        pull = np.einsum("kac,knc->na", basis, force * normal)
        across = force / length
        slope = 1.5 * stiff * np.sqrt(delta) - across
        along_normal = np.einsum("kac,knc->nac", basis, normal)
        hessian = np.einsum("nac,nc,nbc->nab", along_normal, slope, along_normal, optimize=True)
        hessian += np.einsum("kac,nc,kbc->nab", basis, across, basis, optimize=True)
        rest = target[todo] - pull
        wrong = np.abs(rest).max(axis=1) / reference[todo] > tolerance
        if not wrong.any():
            break
        todo, hessian, rest = todo[wrong], hessian[wrong], rest[wrong]
        trace = np.trace(hessian, axis1=1, axis2=2)
        hessian += (1e-12 * trace)[:, None, None] * np.eye(5)
        step = np.linalg.solve(hessian, rest[..., None])[..., 0]
        step *= np.minimum(1, contacts.cap / np.abs(step).max(axis=1, keepdims=True))
        q[todo] += step
    return q * scale, len(todo) if wrong.any() else 0


def random_loads(count, size=1e6, seed=1):
    """Loads that put both rows and diagonals to work, (count, 5)."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(count, 5)) * size * np.array([0.5, 0.5, 1.0, 2.0, 2.0])


def series(count=24_000, step=0.025):
    """A smooth hub-load series of 600 s, (count, 5)."""
    t = np.arange(count) * step
    return np.stack(
        [
            3e5 + 5e4 * np.sin(1.2 * t),
            1e5 * np.cos(0.7 * t),
            2e5 + 1e4 * np.sin(3 * t),
            1e6 * np.sin(0.3 * t) + 2e4 * np.sin(5 * t),
            1e6 * np.cos(0.5 * t),
        ],
        axis=1,
    )


def measure() -> list[dict]:
    """All figures, each with what it was measured on."""
    rows = []
    loads = random_loads(400)
    contacts = PITCH.contacts()
    PITCH.equilibrium(loads[:2, :3], loads[:2, 3:])
    (reference, failed), plain = timed(lambda: numpy_newton(contacts, loads), 3)
    result, ours = timed(
        lambda: PITCH.equilibrium(loads[:, :3], loads[:, 3:], chunk=1, tolerance=1e-8), 3
    )
    error = np.abs((result.displacement - reference) / contacts.scale).max()
    rows.append(
        {
            "what": "588 contacts, cold, random loads, tolerance 1e-8",
            "numpy_cases_per_s": len(loads) / plain,
            "cases_per_s": len(loads) / ours,
            "ratio": plain / ours,
            "numpy_failed": failed,
            "largest_difference_m": error,
            "largest_residual": float(result.residual.max()),
        }
    )
    for name, bearing in (("2 x 129 four-point", BLADE), ("tapered pair 2 x 48 x 30", MAIN)):
        loads = series() if bearing is BLADE else series(2400) * 0.2
        bearing.equilibrium(loads[:2, :3], loads[:2, 3:])
        result, seconds = timed(lambda b=bearing, x=loads: b.equilibrium(x[:, :3], x[:, 3:]), 3)
        _, post = timed(lambda r=result: (r.maximum_pressure, r.equivalent_load))
        rows.append(
            {
                "what": f"{name}, series of {len(loads)} steps, warm, tolerance 1e-10",
                "cases_per_s": len(loads) / seconds,
                "seconds": seconds,
                "seconds_for_pressure_and_life": post,
                "mean_iterations": float(result.iterations.mean()),
                "largest_residual": float(result.residual.max()),
            }
        )
    return rows + scene_rings() + flexible()


def scene_rings(count=2000) -> list[dict]:
    """The default bearing of a scene: flexible rings beside rigid ones, in turn, of CPU time."""
    scene = Rolling(rings="flexible")
    bearing, t = scene.geometry, 0.05 * np.arange(count)
    walk = np.random.default_rng(0).normal(size=count).cumsum()
    force = np.stack(
        [
            2e5 + 5e4 * np.sin(2 * t) + 600 * walk,
            -8e5 + 1e5 * np.cos(1.3 * t),
            6e5 + 1e5 * np.sin(0.7 * t),
        ],
        axis=1,
    )
    moment = np.stack([5e5 * np.sin(t), 8e5 * np.cos(0.9 * t)], axis=1)
    best, found = dict.fromkeys(("rigid", "flexible"), math.inf), {}
    for repeat in range(4):  # the first compiles
        for name, rings in (("rigid", "rigid"), ("flexible", scene.ring_model)):
            start = time.process_time()
            found[name] = bearing.equilibrium(force, moment, rings=rings)
            if repeat:
                best[name] = min(best[name], time.process_time() - start)
    flexible_rings = found["flexible"]
    start = time.process_time()
    _ = flexible_rings.stiffness
    return [
        {
            "what": f"default bearing of a scene, {count} steps of 0.05 s, 1e-10, CPU time",
            "cases_per_s": count / best["flexible"],
            "cases_per_s_rigid": count / best["rigid"],
            "rigid_over_flexible": best["flexible"] / best["rigid"],
            "unknowns": flexible_rings.elements.modes.size,  # type: ignore[attr-defined]
            "mean_iterations": float(flexible_rings.iterations.mean()),
            "mean_iterations_rigid": float(found["rigid"].iterations.mean()),
            "largest_residual": float(flexible_rings.residual.max()),
            "seconds_for_stiffness": time.process_time() - start,
        }
    ]


def flexible() -> list[dict]:
    """Both rings of the blade bearing as beams on walls, and its outer ring on four legs."""
    default = Rolling()
    inner, outer = default.inner_ring, default.outer_ring
    wall = replace(outer.supports[0], sectors=legs(4, 0.8))
    loads = series(1200)
    rows = []
    for name, rings in (
        ("both rings on walls", FlexibleRings(inner=inner, outer=outer)),
        (
            "outer ring on four legs",
            FlexibleRings(inner=inner, outer=replace(outer, supports=(wall,))),
        ),
    ):
        _, first = timed(lambda r=rings: BLADE.equilibrium(loads[:2, :3], loads[:2, 3:], rings=r))
        result, seconds = timed(
            lambda r=rings: BLADE.equilibrium(loads[:, :3], loads[:, 3:], rings=r, tolerance=1e-8),
            2,
        )
        rows.append(
            {
                "what": f"2 x 129 four-point, flexible: {name}, {len(loads)} steps, 1e-8",
                "cases_per_s": len(loads) / seconds,
                "modes": ring_modes(BLADE.ring_coupling(), rings).size - 5,
                "mean_iterations": float(result.iterations.mean()),
                "largest_residual": float(result.residual.max()),
                "seconds_to_condense": first,
            }
        )
        radial, axial, tilt = SPECTRUM[:, :3].T
        zero = np.zeros_like(radial)
        force, moment = np.stack([radial, zero, axial], 1), np.stack([zero, -tilt], 1)
        result, seconds = timed(
            lambda r=rings, f=force, m=moment: BLADE.equilibrium(f, m, rings=r, strict=False), 3
        )
        rows.append(
            {
                "what": f"spectrum of six cases, {name}",
                "seconds": seconds,
                "converged": int(result.converged.sum()),
                "largest_residual": float(result.residual.max()),
                "largest_force": float(result.maximum_force.max()),
                "largest_force_rigid": float(
                    BLADE.equilibrium(result.force, result.moment).maximum_force.max()
                ),
            }
        )
    return rows


def main() -> None:
    """Print the figures."""
    parser = arguments(__doc__)
    parser.add_argument("--json", action="store_true", help="print JSON")
    as_json = parser.parse_args().json
    show(measure(), as_json)


if __name__ == "__main__":
    main()
