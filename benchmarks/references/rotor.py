"""Rotor: time per case of each rung, what each switch changes, and the whole set of DLC 1.1.

Run: python -m benchmarks.references.rotor [rungs | switches | set] …
"""

import resource
import time
from dataclasses import replace

import numpy as np

from benchmarks.common import arguments, timed
from loadflow.reduction.fatigue import damage_equivalent_load
from loadflow.rotor import RUNGS, RotorOptions, simulate
from loadflow.turbines import load_turbine

TURBINE = load_turbine("nrel-5mw")
WARM_UP = {"wind_speed": 10.0, "duration": 1.0, "run_in": 1.0}


def measure(wind_speed, duration=600.0, turbine=TURBINE, **keys):
    """Core time per 600 s of result; mean, std and DEL (m = 4) of tilt and yaw moment, kN m, and of
    the thrust, kN.
    """
    simulate(turbine, **WARM_UP, **keys)  # compile and fill tables outside the measurement
    series, spent = timed(
        lambda: simulate(turbine, wind_speed=wind_speed, seed=1, duration=duration, **keys)
    )
    loads = np.stack([*series["hub_moment"].values[1:], series["hub_force"].values[0]]) / 1e3
    equivalent = [float(damage_equivalent_load(x, 4.0, duration)) for x in loads]
    return spent * 600.0 / duration, loads.mean(axis=1), loads.std(axis=1), np.array(equivalent)


def rungs(wind_speeds=(8.0, 12.0, 20.0)):
    print("wind  rung    s per 600 s  x real time  tilt mean, std   yaw mean, std   std error")
    for wind_speed in wind_speeds:
        results = {rung: measure(wind_speed, rung=rung) for rung in RUNGS}
        top = results[RUNGS[-1]][2]
        for rung, (spent, mean, std, _) in results.items():
            error = np.abs(std / top - 1)
            print(
                f"{wind_speed:4.0f}  {rung:7s} {spent:8.2f} {600 / spent:10.0f}    "
                f"{mean[0]:7.0f} {std[0]:6.0f}   {mean[1]:7.0f} {std[1]:6.0f}   "
                f"{error[0]:6.1%} {error[1]:6.1%}",
                flush=True,
            )


def variants():
    """Everything on but one, or one more."""
    modes = TURBINE.blade.modes

    def without(name):
        kept = tuple(mode for mode in modes if mode.name != name)
        return replace(TURBINE, blade=replace(TURBINE.blade, modes=kept))

    yield "default (rung tower)", {}
    yield "without tower", {"options": RotorOptions(tower_motion=False)}
    yield "without drivetrain torsion", {"options": RotorOptions(drivetrain_torsion=False)}
    yield "rigid blades, tower and drivetrain", {"rung": "tables"}
    yield "without flap 2", {"turbine": without("flap2")}
    yield "without edge 1", {"turbine": without("edge1")}
    for name, change in (
        ("polars at once", {"shed_wake": False}),
        ("no turn of sections bent both ways", {"bend_twist": 0.0}),
        ("no skewed wake", {"skew_factor": 0.0}),
        ("no tower dam", {"tower_dam": False}),
        ("dynamic inflow", {"dynamic_inflow": True}),
        ("dynamic stall", {"dynamic_stall": True}),
        ("0.5° pitch imbalance", {"pitch_imbalance": np.radians(0.5)}),
    ):
        yield name, {"options": RotorOptions(**change)}


def switches(wind_speeds=(8.0, 12.0, 20.0)):
    print("change against the default, tilt / yaw / thrust: mean kN m, kN, std, DEL (m = 4), cost")
    for wind_speed in wind_speeds:
        base = None
        for name, change in variants():
            spent, mean, std, equivalent = measure(wind_speed, **change)
            if base is None:
                base = spent, mean, std, equivalent
                print(
                    f"{wind_speed:.0f} m/s {name}: {mean.round()} {std.round()} "
                    f"{equivalent.round()} {spent:.2f} s"
                )
                continue
            shift, wide, worn = mean - base[1], std / base[2] - 1, equivalent / base[3] - 1
            print(
                f"{wind_speed:.0f} m/s | {name} | {' / '.join(f'{x:+.0f}' for x in shift)} | "
                f"{' / '.join(f'{x:+.1%}' for x in wide)} | "
                f"{' / '.join(f'{x:+.1%}' for x in worn)} | "
                f"{spent / base[0] - 1:+.0%}",
                flush=True,
            )


def whole_set():
    """66 cases of 600 s on one core, from nothing to series in memory."""
    simulate(**WARM_UP)
    start, kept = time.process_time(), []
    for wind_speed in range(4, 26, 2):
        for seed in range(1, 7):
            series = simulate(wind_speed=wind_speed, seed=seed)
            kept.append(series[["speed", "hub_force", "hub_moment"]])
    spent = time.process_time() - start
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    print(f"DLC 1.1: {len(kept)} cases in {spent:.0f} core-s ({spent / len(kept):.2f} each), "
          f"{spent / 120:.1f} min on two cores; peak memory {memory:.0f} MB")  # fmt: skip


if __name__ == "__main__":
    parts = {"rungs": rungs, "switches": switches, "set": whole_set}
    parser = arguments(__doc__)
    parser.add_argument("parts", nargs="*", metavar="PART", help=", ".join(parts))
    for part in parser.parse_args().parts or parts:
        if part not in parts:
            parser.error(f"{part}: must be one of {', '.join(parts)}")
        parts[part]()
