"""A film with everything on through 600 s at 40 Hz: what it costs on "reduced", and how far off.

    python -m benchmarks.references.film_series [--stretch STEPS] [--steps STEPS]

The reference bearing of [Jonuschies 2015] with tilt, a local shell, asperities and heat, as in
`film_effects`: processor time of the whole series, compiled before, and of one of 16 samples, whose
temperatures take as many loads at rest; then the largest difference from "grid" on the same cells
around and 20 across over a short stretch, and the time that the grid takes for it.
"""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from benchmarks.common import arguments, head, row, timed
from benchmarks.references.film_effects import ANSWERS, FILM, HEAT, ROUGH, SHELL, path
from loadflow.errors import ValidityWarning
from loadflow.journal import Contact, FilmHeat
from loadflow.quantities import percent

OVER_AREA = FilmHeat(
    "iso-vg-68", inlet_temperature=318.15, shell_transfer=100.0, shell_temperature=318.15
)
KINDS: dict[str, dict[str, Any]] = {
    "one temperature, stored": HEAT,
    "over the area": {"lubricant": None, "heat": OVER_AREA},
    "over the area, hardly cooled": {
        "lubricant": None,
        "heat": replace(OVER_AREA, shell_transfer=5.0),
    },
}
"""Heat by its name: fields of the film."""


def main() -> None:
    """Measure."""
    parser = arguments(__doc__)
    parser.add_argument("--stretch", type=int, default=12, help="Steps beside the grid.")
    parser.add_argument("--steps", type=int, default=24000, help="Steps of the series.")
    asked = parser.parse_args()
    warnings.simplefilter("ignore", ValidityWarning)
    print(
        head(
            "heat", "series, s", "16 samples, s", *ANSWERS, "stretch on the grid, s", "hottest, °C"
        )
    )
    for name, heat in KINDS.items():
        film = replace(FILM, shell=SHELL, contact=Contact(ROUGH), **heat)
        few, _ = timed(partial(path, film, True, 1.0, asked.stretch))
        _, before = timed(partial(path, film, True, 1.0, 15))
        _, seconds = timed(partial(path, film, True, 1.0, asked.steps))
        grid, other = timed(partial(path, replace(film, rung="grid"), True, 1.0, asked.stretch))
        hottest = few.attrs.get("maximum_temperature", float(few["temperature"].max())) - 273.15
        off = [float(np.abs(few[one] / grid[one] - 1.0).max()) for one in ANSWERS]
        print(
            row(
                name,
                f"{seconds:.3g}",
                f"{before:.3g}",
                *map(percent, off),
                f"{other:.3g}",
                f"{hottest:.3g}",
            ),
            flush=True,
        )


if __name__ == "__main__":
    main()
