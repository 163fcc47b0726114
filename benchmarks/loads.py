"""Time per case of each rung of the rotor, and its error against the top rung.

Run: python benchmarks/loads.py [wind speed …]
"""

import sys
import time

import numpy as np

from loadflow.rotor import RUNGS, simulate


def measure(rung, wind_speed, duration=300.0):
    start = time.process_time()
    series = simulate(wind_speed=wind_speed, seed=1, duration=duration, rung=rung)
    spent = (time.process_time() - start) * 600.0 / duration
    moment = series["hub_moment"].sel(axis=["y", "z"]).values / 1e3
    return spent, moment.mean(axis=1), moment.std(axis=1)


def main(wind_speeds):
    for rung in RUNGS:  # compile and fill tables outside the measurement
        simulate(wind_speed=10.0, duration=1.0, run_in=1.0, rung=rung)
    print("wind  rung    s per 600 s   tilt mean, std   yaw mean, std (kN m)   std error tilt, yaw")
    for wind_speed in wind_speeds:
        results = {rung: measure(rung, wind_speed) for rung in RUNGS}
        top = results[RUNGS[-1]][2]
        for rung, (spent, mean, std) in results.items():
            error = np.abs(std / top - 1)
            print(
                f"{wind_speed:4.0f}  {rung:7s} {spent:8.2f}     {mean[0]:7.0f} {std[0]:6.0f}   "
                f"{mean[1]:7.0f} {std[1]:6.0f}          {error[0]:6.1%} {error[1]:6.1%}"
            )


if __name__ == "__main__":
    main([float(v) for v in sys.argv[1:]] or [8.0, 12.0, 20.0])
