"""Our rotor in the hub wind of OpenFAST series: slow changes of thrust, torque and speed.

The series tell the wind at the hub alone. Over the disc blows what is expected around it: each
frequency of the hub wind times the coherence of IEC 61400-1 over the distance from the hub. So only
the part of the load that the hub wind explains can agree, and only slowly: below 0.1 Hz.
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
RADIUS = np.array([0.0, 5.0, 10.0, 17.0, 25.0, 35.0, 45.0, 55.0, 65.0])  # m
COHERENCE = 8.1 * 42.0  # scale of the coherence, m


def expected_field(wind, step):
    """Wind to be expected over the disc, held at its first value before the series."""
    early, late = round(RUN_IN / step), round(20 / step)
    course = np.concatenate([np.full(early, wind[0]), wind, np.full(late, wind[-1])])
    mean = float(wind.mean())
    frequency = np.fft.rfftfreq(course.size, step)
    hub = np.fft.rfft(course - mean)
    rings = [
        np.fft.irfft(
            hub * np.exp(-12 * np.hypot(frequency * r / mean, 0.12 * r / COHERENCE)), course.size
        )
        for r in RADIUS
    ]
    change = np.broadcast_to(np.stack(rings, axis=1)[:, :, None], (course.size, RADIUS.size, 4))
    return Field(
        time=step * np.arange(course.size),
        radius=RADIUS,
        angle=2 * np.pi * np.arange(4) / 4,
        u=np.ascontiguousarray(change, dtype=np.float32),
        v=None,
        w=None,
        wind_speed=mean,
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
                field=expected_field(hub, step),
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
