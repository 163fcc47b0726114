"""A step of the rotor beside CCBlade (wisdem): time, and power and thrust of the same blade.

CCBlade runs in an environment of its own, as wisdem brings OpenMDAO and compiled solvers. It
solves three blades in a sheared wind, ours three in turbulence at every section; both with 17
sections of the NREL 5 MW turbine.
Run: python -m benchmarks.peers.ccblade [PYTHON that has wisdem]
"""

import json
import subprocess

import numpy as np

from benchmarks.common import arguments, environment, timed
from loadflow.rotor import RotorOptions
from loadflow.rotor import slots as k
from loadflow.rotor.inflow import steady_inflow
from loadflow.rotor.loop import run, turning_state
from loadflow.rotor.rungs import prepare
from loadflow.turbines import load_turbine
from loadflow.wind import kaimal

TURBINE = load_turbine("nrel-5mw")
WIND, SPEED = 8.0, 9.155 * np.pi / 30  # m/s, rad/s
STEP, STEPS = 0.025, 8000

CCBLADE = """
import json, sys, time
import numpy as np
from wisdem.ccblade.ccblade import CCAirfoil, CCBlade

given = json.load(sys.stdin)
foils = [CCAirfoil(f["angle"], [1e6], f["lift"], f["drag"]) for f in given.pop("foils")]
rotor = CCBlade(given["r"], given["chord"], given["theta"], foils, given["Rhub"], given["Rtip"],
                B=3, rho=1.225, precone=given["cone"], tilt=given["tilt"], shearExp=0.2, hubHt=90.0,
                nSector=8)
wind, rpm = given["wind"], given["rpm"]
total, _ = rotor.evaluate([wind], [rpm], [0.0])
start, steps = time.process_time(), 60
for step in range(steps):
    for blade in range(3):
        rotor.distributedAeroLoads(wind, rpm, 0.0, 10.0 * step + 120.0 * blade)
spent = (time.process_time() - start) / steps
print(json.dumps({"seconds": spent, "power": float(total["P"][0]), "thrust": float(total["T"][0])}))
"""


def description():
    """The blade as CCBlade takes it, degrees."""
    blade, rotor = TURBINE.blade, TURBINE.rotor
    foils = [TURBINE.airfoils[name] for name in blade.airfoil]
    return {
        "r": blade.radius.tolist(),
        "chord": blade.chord.tolist(),
        "theta": np.degrees(blade.twist).tolist(),
        "foils": [
            {
                "angle": np.degrees(f.angle).tolist(),
                "lift": f.lift.tolist(),
                "drag": f.drag.tolist(),
            }
            for f in foils
        ],
        "Rhub": rotor.hub_radius,
        "Rtip": rotor.radius,
        "cone": float(np.degrees(rotor.cone)),
        "tilt": float(np.degrees(rotor.tilt)),
        "wind": WIND,
        "rpm": SPEED * 30 / np.pi,
    }


def ccblade(python):
    done = subprocess.run(
        [python, "-c", CCBLADE],
        input=json.dumps(description()),
        check=True,
        capture_output=True,
        text=True,
    )
    return json.loads(done.stdout.splitlines()[-1])


def ours(rung):
    """Time of a step in turbulence, and power and thrust in the sheared wind."""
    rigid = RotorOptions(tower_dam=False, drag_in_induction=True)
    m, c = prepare(TURBINE, rung, rigid)
    state = turning_state(m, c, WIND, SPEED, 0.0)
    settled = steady_inflow(WIND, 4000, 0.2)  # the tower sways at first
    calm = run(m, c, settled, state, STEP, steps=4000, controlled=False)
    box = kaimal(
        WIND, 1.5, radius=np.linspace(0, 63, 11), angles=2 * np.pi * np.arange(48) / 48,
        hub_height=90.0, duration=STEP * STEPS + 20, dt=0.05, seed=1,
    )  # fmt: skip
    inflow = steady_inflow(WIND, STEPS, 0.2, box=box)
    _, spent = timed(
        lambda: run(m, c, inflow, state, STEP, steps=STEPS, start=10.0, controlled=False)
    )
    weight = TURBINE.rotor_mass * 9.80665 * np.sin(TURBINE.rotor.tilt)
    mean = calm[-262:].mean(axis=0)  # one revolution
    return {"seconds": spent / STEPS, "power": mean[k.MX] * SPEED, "thrust": mean[k.FX] - weight}


def main(python):
    theirs = ccblade(python)
    rows = {"CCBlade": theirs} | {rung: ours(rung) for rung in ("bem", "tables", "flap", "tower")}
    print("rotor step     µs      CCBlade / ours   power kW   thrust kN")
    for name, row in rows.items():
        ratio = theirs["seconds"] / row["seconds"]
        print(
            f"{name:10s} {row['seconds'] * 1e6:8.1f} {ratio:14.0f} {row['power'] / 1e3:14.0f} "
            f"{row['thrust'] / 1e3:10.1f}"
        )


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("python", nargs="?", help="interpreter that has wisdem; else one is made")
    if (given := parser.parse_args().python) is not None:
        main(given)
    else:
        with environment("wisdem") as own:
            main(own)
