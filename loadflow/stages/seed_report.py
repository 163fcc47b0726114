"""Load cube → which seeds of a wind speed are equal, as rows of a table and as a page of figures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import batched
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube, iter_cases
from loadflow.errors import InputError
from loadflow.report import Picture, Section, Table, figures, write_page
from loadflow.report.style import readable
from loadflow.seeds import Method, SeedEquality, averaged_spectrum, equality, holm
from loadflow.seeds.spectra import BAND

HEADS = (
    "DLC", "wind, m/s", "seeds", "component", "p location", "p spread", "p spectrum",
    "p of all", "equal", "what was found",
)  # fmt: skip
STAGES = ("location", "spread", "spectrum")
PANELS = 4  # components in one row of a figure

Group = list[xr.Dataset]
"""The seeds of one wind speed of one load case."""
