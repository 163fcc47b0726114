"""Speed and error of the turbulence generator: python -m benchmarks.peers.wind [--peers] [--angles]

All figures of one run come from one core, so their ratios hold on any machine. ``--peers`` also
times PyConTurb, in an environment of its own that is made for it and skipped where that fails, and
hipersim where it is installed (neither is a dependency). ``--angles`` measures what loads lose on
polar grids of fewer angles (two minutes).
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.common import arguments, environment, timed
from loadflow.wind import CoherenceFactors, PointGrid, PolarGrid, kaimal, kaimal_box, polar_angles
from loadflow.wind.coherence import ExactFactors
from loadflow.wind.spectra import coherence, kaimal_spectrum

V, SIGMA, HUB, LENGTH = 15.0, 2.696, 90.0, 42.0
Row = tuple[str, str]


def polar(angles: int, radii: int = 11, dt: float = 0.025) -> Iterator[Row]:
    radius = np.linspace(0.0, 63.0, radii)
    grid = PolarGrid(radius, polar_angles(angles))
    keys: dict[str, Any] = {
        "radius": radius, "angles": grid.angle, "hub_height": HUB, "duration": 600.0, "dt": dt,
        "seed": 1,
    }  # fmt: skip
    factors, once = timed(lambda: CoherenceFactors(grid, LENGTH), 3)
    fast, fast_s = timed(lambda: kaimal(V, SIGMA, factors=factors, **keys), 3)
    exact, exact_s = timed(lambda: kaimal(V, SIGMA, method="exact", **keys))
    name = f"polar {radii} × {angles} × {len(fast.time)}, u v w"
    yield f"{name}: factors, once", f"{once:.3f} s"
    yield f"{name}: fast, per seed", f"{fast_s:.2f} s"
    yield f"{name}: exact, per seed", f"{exact_s:.2f} s ({exact_s / fast_s:.1f} × fast)"
    error = (fast.u - exact.u).astype(float)
    yield (
        f"{name}: rms error of fast",
        f"{error.std() / SIGMA:.1e} σ1 (max {abs(error).max():.1e} m/s)",
    )


def box_arguments(size: int = 20, dt: float = 0.05) -> tuple[PointGrid, dict[str, Any]]:
    lines = np.linspace(-66.5, 66.5, size)
    y, z = (p.ravel() for p in np.meshgrid(lines, lines + HUB, indexing="ij"))
    keys: dict[str, Any] = {
        "y": lines, "z": lines + HUB, "hub_height": HUB, "duration": 600.0 - dt, "dt": dt,
        "seed": 1,
    }  # fmt: skip
    return PointGrid(y, z), keys


def box(exact_too: bool) -> Iterator[Row]:
    grid, keys = box_arguments()
    factors, once = timed(lambda: CoherenceFactors(grid, LENGTH))
    yield "box 20 × 20 × 12000: factors, once", f"{once:.2f} s, {factors.table.nbytes / 1e6:.0f} MB"
    for components in ("u", "uvw"):
        made, seconds = timed(
            lambda c=components: kaimal_box(V, SIGMA, factors=factors, components=c, **keys), 3
        )
        yield f"box 20 × 20 × 12000: fast {components}, per further seed", f"{seconds:.2f} s"
    if exact_too:
        exact, seconds = timed(lambda: kaimal_box(V, SIGMA, method="exact", components="u", **keys))
        rms = (made.u - exact.u).std(dtype=float) / SIGMA
        yield "box 20 × 20 × 12000: exact u", f"{seconds:.1f} s (fast differs by {rms:.1e} σ1 rms)"


def knots() -> Iterator[Row]:
    """Worst error of the coherence between any two points, over the number of knots."""
    grid = PolarGrid(np.linspace(0.0, 63.0, 11), polar_angles(48))
    decay = np.geomspace(0.0043, 3.0, 300)
    exact = ExactFactors(grid, LENGTH).grid.factors(decay)
    for count in (24, 48, 96, 192):
        factors = CoherenceFactors(grid, LENGTH, count)
        place = np.interp(np.log(decay), np.log(factors.decay), np.arange(count))
        low = np.minimum(place.astype(int), count - 2)
        share = (place - low)[:, None, None, None]
        lower = factors.table[low] * (1 - share) + factors.table[low + 1] * share
        error = lower @ lower.swapaxes(-1, -2) - exact @ exact.swapaxes(-1, -2)
        worst = abs(np.fft.ifft(error, axis=1)).max()
        yield f"{count} knots: largest error of the coherence", f"{worst:.1e}"


def angles_needed() -> Iterator[Row]:
    """What linear interpolation between the angles loses at three quarters of the radius."""
    frequency = np.geomspace(1e-3, 20.0, 4000)
    density = kaimal_spectrum(frequency, 12.0, 1.0, LENGTH)
    for count in (16, 24, 36, 48, 72):
        gap = 2 * 0.75 * 63.0 * np.sin(np.pi / count)
        kept = (2 + coherence(frequency, gap, 12.0, LENGTH)) / 3
        total = np.trapezoid(density * kept, frequency) / np.trapezoid(density, frequency)
        third = np.sinc(3 / count) ** 2
        yield (
            f"{count} angles: variance kept between grid points, amplitude of azimuthal order 3",
            f"{total:.3f}, {third:.3f}",
        )


def peers() -> Iterator[Row]:
    """Other generators on the same box, beside ours in the same run."""
    grid, keys = box_arguments()
    factors = CoherenceFactors(grid, LENGTH)
    ours = {
        c: timed(lambda c=c: kaimal_box(V, SIGMA, factors=factors, components=c, **keys), 3)[1]
        for c in ("u", "uvw")
    }
    try:
        from hipersim import MannTurbulenceField
    except ImportError:
        yield "hipersim", "not installed"
    else:
        _, seconds = timed(
            lambda: MannTurbulenceField.generate(
                alphaepsilon=1, L=33.6, Gamma=3.9, Nxyz=(12000, 20, 20), dxyz=(0.75, 7, 7), seed=2
            )
        )
        yield "hipersim (Mann) u v w", f"{seconds:.1f} s = {seconds / ours['uvw']:.0f} × ours"
    # its cost is one factorisation per frequency: 1/20 of the length has 1/20 of them
    seconds = pyconturb_seconds()
    if seconds is None:
        yield "PyConTurb", "cannot be had here: skipped"
        return
    ratio = 20 * seconds / ours["u"]
    yield (
        "PyConTurb u (1/20 of the frequencies, × 20)",
        f"{20 * seconds:.0f} s = {ratio:.0f} × ours, aim 15: {'ok' if ratio >= 15 else 'missed'}",
    )


PYCONTURB = """
import time
import numpy as np
from pyconturb import gen_spat_grid, gen_turb

lines = np.linspace(-66.5, 66.5, 20)
points = gen_spat_grid(lines, lines + 90.0, comps=[0])
start = time.process_time()
gen_turb(points, T=30, nt=600, u_ref=15.0, turb_class="A", z_ref=90.0, seed=1)
print(time.process_time() - start)
"""


def pyconturb_seconds() -> float | None:
    """Time of PyConTurb in an environment of its own; None where that cannot be made."""
    try:
        # it imports pkg_resources, which newer setuptools have no more
        with environment("pyconturb", "setuptools<80", seconds=300) as python:
            done = subprocess.run(
                [python, "-c", PYCONTURB], check=True, capture_output=True, text=True, timeout=300
            )
    except (OSError, subprocess.SubprocessError):
        return None
    return float(done.stdout.split()[-1])


def angles_in_loads() -> Iterator[Row]:
    """Hub moments in the same fields on fewer of 144 angles."""
    from scipy.signal import welch

    from loadflow.rotor import simulate

    radius, most, power = np.linspace(0.0, 63.0, 11), 144, {}
    for seed in (1, 2, 3):
        full = kaimal(
            12.0, 2.0, radius=radius, angles=polar_angles(most), hub_height=HUB, duration=400.0,
            dt=0.05, seed=seed,
        )  # fmt: skip
        for count in (24, 36, 48, 72, most):
            some = np.s_[:, :, :: most // count]
            parts = {c: np.ascontiguousarray(getattr(full, c)[some]) for c in "uvw"}
            field = replace(full, angle=polar_angles(count), **parts)
            series = simulate(wind_speed=12.0, duration=300.0, dt=0.05, rung="tables", field=field)
            moments = series["hub_moment"].sel(axis=["y", "z"]).values
            frequency, density = welch(moments, 20.0, nperseg=2048)
            power[count] = power.get(count, 0.0) + density.sum(axis=0)
    blades = 3 * float(series["speed"].mean()) / (2 * np.pi)
    bands = {"3p": (0.9, 1.1), "6p": (1.8, 2.2), "all": (0.0, np.inf)}
    for count, density in power.items():
        kept = {
            name: np.sqrt(density[inside].sum() / power[most][inside].sum())
            for name, (low, high) in bands.items()
            if (inside := (frequency >= low * blades) & (frequency < high * blades)).any()
        }
        yield (
            f"{count} angles: amplitude of the hub moments kept",
            ", ".join(f"{name} {value:.4f}" for name, value in kept.items()),
        )


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--peers", action="store_true", help="also PyConTurb and hipersim")
    parser.add_argument("--exact-box", action="store_true", help="also the exact box (15 s)")
    parser.add_argument("--angles", action="store_true", help="what loads lose on few angles")
    options = parser.parse_args()
    tables = [polar(16), polar(48), box(options.exact_box), knots(), angles_needed()]
    if options.peers:
        tables.append(peers())
    if options.angles:
        tables.append(angles_in_loads())
    for table in tables:
        for name, value in table:
            print(f"{name:<84}{value}")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
