"""The published steady states of CCBlade beside CCBlade and ours, one difference after the other.

`loadflow validate turbines --folder CLONES` holds rigid blades at the printed speed and pitch of
the IEA 3.4 and 10 MW against what their repositories print. What one of both does and the other
does not is switched here: tilt of the shaft, prebend that turns with the pitch, polars
smoothed by splines as CCBlade does, and with the delay of stall of Du and Selig as WISDEM does.
All with the sections and polars that we read from the windIO file; the mean over eight azimuths.
Run: python -m benchmarks.peers.ccblade_states CLONES [PYTHON that has wisdem]
"""

from __future__ import annotations

import json
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.common import arguments, environment
from loadflow.turbines import Turbine
from loadflow.validation.turbines import TURBINES, completed, published_states, rigid_states

TIP_SPEED_RATIOS = {"IEA 3.4 MW": 8.018, "IEA 10 MW": 9.0}
"""Of the windIO files, `control.torque.tsr`; the delay of stall takes it."""

CCBLADE = """
import json, sys
import numpy as np
from scipy.interpolate import PchipInterpolator, RectBivariateSpline
from wisdem.ccblade.ccblade import CCAirfoil, CCBlade
from wisdem.ccblade.Polar import Polar

given = json.load(sys.stdin)
span = np.array(given["r"])
edge = given["Rtip"] * np.cos(np.radians(given["cone"]))
fine = np.unique(np.hstack([np.linspace(-180, -30, 51), np.linspace(-30, 30, 100),
                            np.linspace(30, 180, 51)]))

def foil(k, stall, smoothing):
    one = given["foils"][k]
    angle, lift, drag = (np.array(one[name]) for name in ("angle", "lift", "drag"))
    angle, first = np.unique(angle, return_index=True)
    lift, drag = lift[first], drag[first]
    if stall and one["thickness"] < 0.7:
        polar = Polar(Re=1e6, alpha=fine, cl=np.interp(fine, angle, lift),
                      cd=np.interp(fine, angle, drag), cm=np.zeros(fine.size))
        polar = polar.correction3D(span[k] / edge, given["chord"][k] / span[k], given["ratio"])
        angle = fine
        lift, drag = (PchipInterpolator(polar.alpha, v)(fine) for v in (polar.cl, polar.cd))
    made = CCAirfoil(angle, [1e6], lift, drag)
    for name, values, rest in (("cl_spline", lift, 0.1), ("cd_spline", drag, 0.001)):
        order, rest = (3, rest) if smoothing else (1, 0.0)
        setattr(made, name, RectBivariateSpline(np.radians(angle), [1e1, 1e15],
                np.c_[values, values], kx=order, ky=1, s=rest))
    return made

def states(tilt, prebend, stall, smoothing):
    foils = [foil(k, stall, smoothing) for k in range(span.size)]
    rotor = CCBlade(span, np.array(given["chord"]), np.array(given["theta"]), foils, given["Rhub"],
                    given["Rtip"], B=3, rho=1.225, precone=given["cone"],
                    tilt=given["tilt"] if tilt else 0.0, shearExp=0.0, hubHt=given["height"],
                    nSector=8, precurve=-prebend * np.array(given["prebend"]),
                    precurveTip=-prebend * given["prebend_tip"])
    found = []
    for wind, rpm, pitch, *_ in given["states"]:
        total, _ = rotor.evaluate([wind], [rpm], [pitch])
        found.append([float(total["P"][0]), float(total["T"][0])])
    return found

print(json.dumps({name: states(*way) for name, way in given["ways"].items()}))
"""

WAYS = {
    "CCBlade, upright and straight": (False, 0.0, False, False),
    "CCBlade, with prebend": (False, 1.0, False, False),
    "CCBlade, and tilt": (True, 1.0, False, False),
    "CCBlade, and smoothed polars": (True, 1.0, False, True),
    "CCBlade, and delay of stall": (True, 1.0, True, True),
}
"""Tilt, share of the prebend, delay of stall, smoothing."""


def description(name: str, turbine: Turbine) -> dict[str, Any]:
    """The blade as CCBlade takes it, degrees."""
    blade, rotor = turbine.blade, turbine.rotor
    foils = [turbine.airfoils[each] for each in blade.airfoil]
    slope = (blade.prebend[-1] - blade.prebend[-2]) / (blade.radius[-1] - blade.radius[-2])
    return {
        "r": blade.radius.tolist(),
        "chord": blade.chord.tolist(),
        "theta": np.degrees(blade.twist).tolist(),
        "prebend": blade.prebend.tolist(),
        "prebend_tip": float(blade.prebend[-1] + slope * (rotor.radius - blade.radius[-1])),
        "foils": [
            {
                "angle": np.degrees(foil.angle).tolist(),
                "lift": foil.lift.tolist(),
                "drag": foil.drag.tolist(),
                "thickness": float(foil.name.removeprefix("thickness ")),
            }
            for foil in foils
        ],
        "Rhub": rotor.hub_radius,
        "Rtip": rotor.radius,
        "cone": float(np.degrees(rotor.cone)),
        "tilt": float(np.degrees(rotor.tilt)),
        "height": rotor.hub_height,
        "ratio": TIP_SPEED_RATIOS[name],
        "states": published_states(name).tolist(),
        "ways": WAYS,
    }


def main(folder: Path, python: str) -> None:
    """Print the deviations of power and thrust from the print, %."""
    for public in TURBINES:
        if not public.rigid:
            continue
        turbine = completed(public, folder)
        done = subprocess.run(
            [python, "-W", "ignore", "-c", CCBLADE],
            input=json.dumps(description(public.name, turbine)),
            check=True,
            capture_output=True,
            text=True,
        )
        rows = json.loads(done.stdout.splitlines()[-1])
        upright = replace(turbine, rotor=replace(turbine.rotor, tilt=0.0))
        rows["ours, upright"] = rigid_states(public.name, upright, prebend_turns=False)
        rows["ours, tilted"] = rigid_states(public.name, turbine, prebend_turns=False)
        rows["ours, prebend turns with the pitch"] = rigid_states(public.name, turbine)
        printed = published_states(public.name)
        print(f"{public.name}: power/thrust, % off the print, at m/s")
        print(f"{'':36s}" + "".join(f"{wind:>13.4g}" for wind in printed[:, 0]))
        for name, found in rows.items():
            off = 100 * (np.array(found) / printed[:, 3:] - 1)
            print(f"{name:36s}" + "".join(f"{f'{a:+.2f}/{b:+.2f}':>13s}" for a, b in off))


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("folder", type=Path, help="clones as OWNER/NAME")
    parser.add_argument("python", nargs="?", help="interpreter that has wisdem; else one is made")
    asked = parser.parse_args()
    if asked.python is not None:
        main(asked.folder, asked.python)
    else:
        with environment("wisdem") as own:
            main(asked.folder, own)
