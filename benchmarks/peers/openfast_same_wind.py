"""Our rotor in the wind of OpenFAST series, and our control on their rotor speed.

The series tell the wind that the sections of the blades meet on average (AeroDyn's RtVAvgxh). Below
0.05 Hz that is nearly the wind over the whole disc: it blows here uniformly, with the mean profile,
and thrust, torque, speed and pitch are compared seed by seed, without the noise of other winds. The
average gives the inner sections more weight than the load does, so it varies more by some percent.

The second table replays our control over the generator speed of the series, without a rotor.
Run: python -m benchmarks.peers.openfast_same_wind FOLDER [wind speed …]
"""

from pathlib import Path

import numpy as np
from scipy.signal import butter, sosfiltfilt

from benchmarks.common import arguments
from loadflow.readers import read_loads
from loadflow.readers.openfast import read_table
from loadflow.rotor import simulate
from loadflow.rotor import slots as k
from loadflow.rotor.control._kernels import control
from loadflow.rotor.control.constants import UNEVENTFUL, controller
from loadflow.turbines import load_turbine
from loadflow.wind.field import Field, polar_angles

SLOW, SETTLED, RUN_IN = 0.05, 30.0, 60.0  # Hz; s; s
REPLAYED = 60.0  # s until the control has forgotten what came before the series


def slow(x, step):
    """What is slower than `SLOW`."""
    return sosfiltfilt(butter(4, SLOW, fs=1 / step, output="sos"), np.asarray(x, float))


def profile_share(turbine, shear):
    """Mean over the sections of the wind along the shaft, of the wind at the hub."""
    angle = polar_angles(72)
    height = turbine.blade.radius[:, None] * np.cos(angle) / turbine.rotor.hub_height
    return float(((1 + height) ** shear).mean() * np.cos(turbine.rotor.tilt))


def uniform_field(wind, mean, step):
    """The change of the wind, the same all over the disc; held before and after the series."""
    early, late = round(RUN_IN / step), round(20 / step)
    change = np.pad(wind - mean, (early, late), mode="edge")
    angle = polar_angles(3)
    u = np.broadcast_to(change[:, None, None], (change.size, 2, angle.size))
    time = step * np.arange(change.size)
    u = np.ascontiguousarray(u, dtype=np.float32)
    return Field(time, np.array([0.0, 100.0]), angle, u, None, None, mean, 0.2)


def same_wind(file, wind_speed, turbine):
    """Print our thrust, torque, speed and pitch over those of one file."""
    theirs = read_loads(str(file), channels={"wind": ("RtVAvgxh",)}).isel(case=0).load()
    step = float(theirs["time"][1] - theirs["time"][0])
    wind = slow(theirs["wind"].values.squeeze(), step) / profile_share(turbine, 0.2)
    ours = simulate(
        turbine,
        wind_speed=wind_speed,
        duration=wind.size * step,
        field=uniform_field(wind, float(wind_speed), step),
        dt=step,
        run_in=RUN_IN,
    )
    inside = slice(round(SETTLED / step), -round(SETTLED / step))
    for name, pick in (
        ("thrust", lambda s: s["hub_force"].sel(axis="x")),
        ("torque", lambda s: s["hub_moment"].sel(axis="x")),
        ("speed", lambda s: s["speed"]),
        ("pitch", lambda s: s["pitch"]),
    ):
        x, y = (slow(pick(s).values, step)[inside] for s in (ours, theirs))
        if y.std() > 1e-6:
            print(
                f"{wind_speed:4d} {file.stem[-2:]:6s}{name:8s}{x.mean() / y.mean():8.3f}"
                f"{x.std() / y.std():10.3f}{np.corrcoef(x, y)[0, 1]:12.3f}",
                flush=True,
            )


def replay(file, turbine):
    """Generator torque (N m) and pitch (rad) of our control and of the file, each (n,)."""
    table = read_table(file)
    torque, pitch, speed = (
        table.series(name, unit)
        for name, unit in (("GenTq", "N m"), ("BldPitch1", "rad"), ("GenSpeed", "rad/s"))
    )
    step = float(table.stamps[1] - table.stamps[0])
    law = controller(turbine)
    state, blades = np.zeros(k.SLOTS), np.full(3, pitch[0])
    state[k.S_FILTERED], state[k.S_PITCH], state[k.S_TORQUE] = speed[0], pitch[0], torque[0]
    state[k.S_FLOOR] = law.minimum_pitch
    gain = 1 / (1 + pitch[0] / law.gain_halving_pitch)
    state[k.S_INTEGRAL] = pitch[0] / (gain * law.integral_gain)
    out = np.empty((speed.size, 2))
    for i, value in enumerate(speed):
        control(law, UNEVENTFUL, state, blades, value, 0.0, 0.0, i * step, step)
        out[i] = state[k.S_TORQUE], blades[0]
    late = slice(round(REPLAYED / step), None)
    return out[late, 0], torque[late], out[late, 1], pitch[late]


def main(folder, winds):
    turbine = load_turbine("nrel-5mw")
    files = {v: sorted(Path(folder).glob(f"nrel5mw_dlc11_v{v:02d}_s*.outb")) for v in winds}
    print(f"what is slower than {SLOW} Hz, ours / OpenFAST")
    print("wind file  channel    mean       std correlation")
    for wind, of_wind in files.items():
        for file in of_wind:
            same_wind(file, wind, turbine)
    print("\ncontrol replayed: rms error (standard deviation) of torque, N m, and pitch, °")
    for wind, of_wind in files.items():
        for file in of_wind:
            ours, torque, bent, pitch = replay(file, turbine)
            off, wrong = np.sqrt(np.mean((ours - torque) ** 2)), np.degrees((bent - pitch).std())
            print(
                f"{wind:4d} {file.stem[-2:]:6s}{off:8.1f} ({torque.std():7.1f})"
                f"{wrong:10.4f} ({np.degrees(pitch.std()):6.3f})"
            )


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("folder")
    parser.add_argument("winds", type=int, nargs="*", default=[4, 8, 12, 24], help="m/s")
    main(**vars(parser.parse_args()))
