"""Speed of the journal bearing beside a plain, readable scipy.sparse Newton of the same step.

The reference below solves the same transient gas-mixture step on the same 60 × 20 cells, full
width, film and shaft in one sparse system. Run ``python -m benchmarks.peers.journal [steps]``;
the numbers are for one thread, in processor time, so that other programs on
the machine do not count.
"""

from __future__ import annotations

import json
import time as clock

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

from benchmarks.common import arguments, seconds_of, timed
from loadflow.validation.journal import PERIODIC_LOADS, reference_bearing, sines

OMEGA = 12.1 * np.pi / 30
STEP = 0.05


class SparseFilm:
    """Gas-mixture film of the reference bearing, written to be read."""

    radius, width, psi, eta, mixing, edge = 1.5, 2.25, 0.5e-3, 0.05, 0.05e6, 0.5e6

    def __init__(self, nx: int = 60, nz: int = 20) -> None:
        theta = (np.arange(nx) + 0.5) * 2 * np.pi / nx
        face = theta + np.pi / nx
        self.dx, self.dz = 2 * np.pi / nx, self.width / self.radius / nz
        self.cos, self.sin = np.repeat(np.cos(theta), nz), np.repeat(np.sin(theta), nz)
        self.cos_face, self.sin_face = np.repeat(np.cos(face), nz), np.repeat(np.sin(face), nz)
        one = sp.eye(nz)
        forward = sp.diags([np.ones(nx - 1), [1.0]], [1, -(nx - 1)])
        self.ahead = sp.kron(forward - sp.eye(nx), one).tocsr()  # p[i+1] − p[i]
        self.across = sp.diags(
            [-np.ones(nz - 1), 2 * np.ones(nz), -np.ones(nz - 1)], [-1, 0, 1]
        ).tolil()
        self.across[0, 0] = self.across[-1, -1] = 3.0  # half a cell to the rim
        rim = np.zeros(nz)
        rim[[0, -1]] = 2.0
        self.rim = np.tile(rim, nx)
        self.across = sp.kron(sp.eye(nx), self.across).tocsr()
        self.wedge = 6 * self.eta * OMEGA / self.psi**2
        self.squeeze = 12 * self.eta / self.psi**2 * self.dx * self.dz
        self.area = self.radius**2 * self.dx * self.dz

    def fill(self, p: np.ndarray) -> np.ndarray:
        return p / (p + self.mixing)

    def gap(self, e: np.ndarray) -> np.ndarray:
        return 1 - e[0] * self.cos - e[1] * self.sin

    def residual(self, p, e, force, rate, old):
        gap, face = self.gap(e), 1 - e[0] * self.cos_face - e[1] * self.sin_face
        flux = self.dz * (self.wedge * face * self.fill(p) - face**3 / self.dx * (self.ahead @ p))
        cells = self.ahead.T @ -flux
        cells += self.dx / self.dz * gap**3 * (self.across @ p - self.rim * self.edge)
        cells += self.squeeze * rate * self.fill(p) * gap - old
        load = self.area * np.array([p @ self.cos, p @ self.sin]) - force
        return np.append(cells, load)

    def jacobian(self, p, e, rate):
        gap, face = self.gap(e), 1 - e[0] * self.cos_face - e[1] * self.sin_face
        slope = self.mixing / (p + self.mixing) ** 2
        flux = sp.diags(self.dz * self.wedge * face * slope)
        flux = flux - sp.diags(self.dz / self.dx * face**3) @ self.ahead
        cells = -self.ahead.T @ flux + sp.diags(self.dx / self.dz * gap**3) @ self.across
        cells = cells + sp.diags(self.squeeze * rate * slope * gap)
        columns = []
        drop = self.across @ p - self.rim * self.edge
        for at_cell, at_face in ((self.cos, self.cos_face), (self.sin, self.sin_face)):
            change = -at_face * self.dz
            moved = change * (self.wedge * self.fill(p) - 3 * face**2 / self.dx * (self.ahead @ p))
            column = self.ahead.T @ -moved - at_cell * self.dx / self.dz * 3 * gap**2 * drop
            columns.append(column - at_cell * self.squeeze * rate * self.fill(p))
        load = self.area * np.stack([self.cos, self.sin])
        return sp.bmat([[cells, sp.csr_matrix(np.array(columns).T)], [sp.csr_matrix(load), None]])

    def solve(self, p, e, force, rate, old):
        for _ in range(30):
            step = spsolve(
                self.jacobian(p, e, rate).tocsc(), -self.residual(p, e, force, rate, old)
            )
            p = np.maximum(p + step[:-2], 0.1 * p)
            e = e + step[-2:]
            if np.abs(step[:-2]).max() < 1e-7 * self.wedge and np.abs(step[-2:]).max() < 1e-7:
                return p, e
        raise RuntimeError("the reference did not converge")

    def orbit(self, force, position):
        """BDF2 with fixed step from static equilibrium; returns positions and the time it took."""
        p, e = self.solve(np.full(self.cos.size, self.edge), position, force[0], 0.0, 0.0)
        path, stored = [e], [self.squeeze * self.fill(p) * self.gap(e)]
        begin = clock.process_time()
        for n in range(1, len(force)):
            if n == 1:
                rate, old = 1 / STEP, stored[-1] / STEP
            else:
                rate, old = 1.5 / STEP, (2 * stored[-1] - 0.5 * stored[-2]) / STEP
            p, e = self.solve(p, e, force[n], rate, old)
            path.append(e)
            stored.append(self.squeeze * self.fill(p) * self.gap(e))
        return np.array(path), clock.process_time() - begin


def main(steps: int) -> None:
    bearing, film = reference_bearing()
    time = np.arange(steps + 1) * STEP
    force = np.stack([sines(x, time) for x in PERIODIC_LOADS[0][:2]], axis=-1)
    grid, ours = timed(lambda: bearing.orbit(time, force, OMEGA, **film), 2, warm=True)
    reduced = film | {"rung": "reduced"}
    few, fast = timed(lambda: bearing.orbit(time, force, OMEGA, **reduced), 5, warm=True)
    fine = bearing.orbit(time, force, OMEGA, **film | {"grid": (60, 80)})
    start = grid.eccentricity.values[0] / bearing.clearance
    path, plain = SparseFilm().orbit(force, start)
    static, still = timed(lambda: bearing.equilibrium(force, OMEGA, **film), 2, warm=True)
    still_few = seconds_of(lambda: bearing.equilibrium(force, OMEGA, **reduced), 5)
    ratio = grid.eccentricity_ratio.values

    def off(orbit, reference) -> float:
        """Relative error of E_max."""
        largest = float(reference.eccentricity_ratio.max())
        return abs(float(orbit.eccentricity_ratio.max()) / largest - 1)

    result = {
        "steps": steps,
        "sparse_ms_per_step": 1e3 * plain / steps,
        "grid_ms_per_step": 1e3 * ours / steps,
        "reduced_ms_per_step": 1e3 * fast / steps,
        "grid_speed_over_sparse": plain / ours,
        "reduced_speed_over_sparse": plain / fast,
        "grid_error_against_sparse": float(np.abs(np.hypot(*path.T) - ratio).max()),
        "reduced_error_of_e_max_against_grid": off(few, grid),
        "grid_error_of_e_max_against_60x80": off(grid, fine),
        "reduced_error_of_e_max_against_60x80": off(few, fine),
        "static_grid_ms_per_load": 1e3 * still / len(force),
        "static_reduced_ms_per_load": 1e3 * still_few / len(force),
        "static_grid_newton_steps": float(static.iterations.mean()),
    }
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("steps", type=int, nargs="?", default=100)
    main(parser.parse_args().steps)
