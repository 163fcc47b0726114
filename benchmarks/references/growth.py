"""How loads of main bearings grow with the radius of the rotor, beside R³ of Hart et al. 2022.

python -m benchmarks.references.growth [--seeds N] [--duration S] [--wind-speeds V …]

One turbine scaled to 5, 7.5 and 10 MW, on a suspension scaled with it and on that of the 5 MW, and
turbines that were each designed for their size (two, three), in the same turbulence: exponents by
least squares. `loadflow validate similarity` has rows of them at 12 m/s.
"""

from __future__ import annotations

from benchmarks.common import arguments
from loadflow.validation._growth import DESIGNS, SIMILAR, exponents


def main() -> None:
    """Print a line for each set of turbines and wind."""
    parser = arguments(__doc__)
    parser.add_argument("--seeds", type=int, default=6)
    parser.add_argument("--duration", type=float, default=200.0, help="of each seed, s")
    parser.add_argument("--wind-speeds", type=float, nargs="+", default=[8.0, 12.0, 18.0])
    asked = parser.parse_args()
    seeds = range(1, asked.seeds + 1)
    for name, turbines, shaft in (
        ("5, 7.5, 10 MW by similarity", SIMILAR, None),
        ("the same on the span of 5 MW", SIMILAR, SIMILAR[0]),
        ("NREL 5 MW, IEA 15 MW", DESIGNS[1:], None),
        ("WindPACT 1.5 MW, NREL 5 MW, IEA 15 MW", DESIGNS, None),
    ):
        for wind in asked.wind_speeds:
            found = exponents(turbines, wind, seeds, asked.duration, shaft)
            told = ", ".join(f"{load} R^{power:.2f}" for load, power in found.items())
            print(f"{name}, {wind:g} m/s: {told}", flush=True)


if __name__ == "__main__":
    main()
