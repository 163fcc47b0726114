"""Our rotor in the hub wind of OpenFAST series: slow changes of thrust, torque and speed.

The series tell the wind at the hub alone. It blows over the whole disc here, so that only what is
slower than the passage of a gust over the disc can agree: below 0.1 Hz.
Run: python benchmarks/loads_same_wind.py FOLDER [wind speed …]
"""

import sys
from pathlib import Path

import numpy as np
from scipy.signal import butter, coherence, sosfiltfilt

from loadflow.readers import read_loads
from loadflow.rotor import simulate
from loadflow.wind.field import Field

SLOW, SETTLED = 0.1, 30.0  # Hz; s
RUN_IN = 60.0


def blowing(wind, step):
    """The hub wind over the whole disc, held at its first value before the series."""
    early, late = round(RUN_IN / step), round(20 / step)
    course = np.concatenate([np.full(early, wind[0]), wind, np.full(late, wind[-1])])
    change = np.broadcast_to((course - wind.mean())[:, None, None], (course.size, 2, 4))
    return Field(
        time=step * np.arange(course.size),
        radius=np.array([0.0, 70.0]),
        angle=2 * np.pi * np.arange(4) / 4,
        u=np.ascontiguousarray(change, dtype=np.float32),
        v=None,
        w=None,
        wind_speed=float(wind.mean()),
        shear_exponent=0.2,
    )


def slow(x, step):
    """What is slower than 0.1 Hz."""
    return sosfiltfilt(butter(4, SLOW, fs=1 / step, output="sos"), x)


def main(folder, winds):
    print("wind file    channel    mean      std below 0.1 Hz     correlation  coherence")
    print("                      (ours / OpenFAST)                             0.01–0.1 Hz")
    for wind in winds:
        for file in sorted(Path(folder).glob(f"nrel5mw_dlc11_v{wind:02d}_s*.outb")):
            theirs = read_loads(str(file)).isel(case=0).load()
            step = float(theirs["time"][1] - theirs["time"][0])
            hub = theirs["wind"].values.astype(float)
            ours = simulate(
                wind_speed=float(hub.mean()),
                duration=hub.size * step,
                field=blowing(hub, step),
                dt=step,
                run_in=RUN_IN,
            )
            for name, pick in (
                ("thrust", lambda s: s["hub_force"].sel(axis="x")),
                ("torque", lambda s: s["hub_moment"].sel(axis="x")),
                ("speed", lambda s: s["speed"]),
            ):
                a, b = (
                    pick(s).values.astype(float)[round(SETTLED / step) :] for s in (ours, theirs)
                )
                f, c = coherence(a, b, 1 / step, nperseg=round(100 / step))
                x, y = slow(a, step), slow(b, step)
                print(
                    f"{wind:4d} {file.stem[-2:]:6s}  {name:8s} {a.mean() / b.mean():9.3f} "
                    f"{x.std() / y.std():14.2f} {np.corrcoef(x, y)[0, 1]:19.2f} "
                    f"{c[(f >= 0.01) & (f <= SLOW)].mean():12.2f}",
                    flush=True,
                )


if __name__ == "__main__":
    main(sys.argv[1], [int(v) for v in sys.argv[2:]] or [4, 8, 12, 24])
