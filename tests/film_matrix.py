"""Which parts of a film go together on which model: asked of the registry, pair by pair.

`PARTS` has one way to ask for each part; `goes` asks `why_not` for any number of them together, and
`table` writes the page docs/journal-matrix.md.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from loadflow.journal.cavitation import LAWS, GasMixture
from loadflow.journal.contact import Contact
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.heat import FilmHeat, Growth, Heat, RingGrowth
from loadflow.journal.line import Line
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.models.model import Verb, why_not
from loadflow.journal.questions import Steps
from loadflow.journal.relief import Contour, Crown
from loadflow.journal.shapes import Arc, Lobes, TiltingPads
from loadflow.journal.shells import LocalShell, ThickShell
from loadflow.journal.supply import Capillary, Groove, Supply
from loadflow.journal.turbulence import Turbulence
from loadflow.tribology.asperities import AsperityContact


@dataclass(frozen=True)
class Part:
    """One way to ask for a part of a film.

    Attributes
    ----------
    axis : str
        What it is one of: two parts of one axis exclude each other.
    film, bearing, line : dict
        Fields of `Film`, of `JournalGeometry`, and arguments of the verbs.
    """

    axis: str
    film: dict[str, Any] = field(default_factory=dict)
    bearing: dict[str, Any] = field(default_factory=dict)
    line: dict[str, Any] = field(default_factory=dict)


BEARING: dict[str, Any] = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
FILM: dict[str, Any] = {
    "lubricant": Lubricant(0.03), "edge_pressure": 1.5e5, "grid": (36, 8), "inlet": None,
    "grading": "uniform",
}  # fmt: skip
OCCASIONS: dict[str, tuple[Verb, Steps]] = {
    "position": ("at_position", Steps()),
    "rest": ("at_rest", Steps()),
    "motion": ("in_motion", Steps()),
    "adaptive": ("in_motion", Steps(step="adaptive")),
    "closed": ("in_motion", Steps(periodic=True)),
}
RUNGS_SHOWN = ("grid", "reduced")

_MIXTURE = GasMixture(5e4)  # the one law whose parameter has no default
_LAWS = {
    name: Part("law", {"cavitation": _MIXTURE if name == _MIXTURE.kind else law()})
    for name, law in LAWS.items()
}
_GROOVE = Groove(1.57, arc=0.3, length=0.05, pressure=2e5)
_OVAL = Contour((0.0, 1.571, 3.142, 4.712), (0.0, 1e-5, 0.0, 1e-5))
_FED = Groove(1.57, arc=0.3, length=0.05, pressure=4e5, restrictor=Capillary(1.5e-3, 0.1))
_ROUGH = Contact(AsperityContact(roughness=5e-7, contact_modulus=1e11, factor=1e-3))

PARTS: dict[str, Part] = _LAWS | {
    "arc": Part("bore", bearing={"shape": Arc(0.3, 3.0)}),
    "lobes": Part("bore", bearing={"shape": Lobes(3, preload=0.3)}),
    "tilting pads": Part("bore", bearing={"shape": TiltingPads(4, 1.2)}),
    "contour": Part("bore", bearing={"relief": (_OVAL,)}),
    "crown": Part("bore", bearing={"relief": (Crown(1e-5, 0.02),)}),
    "supply": Part("supply", {"supply": Supply((_GROOVE,))}),
    "supply by a capillary": Part("supply", {"supply": Supply((_FED,))}),
    "tilt and bend": Part("line", line={"tilt": (1e-5, 2e-5), "bend": (1e-5, 0.0)}),
    "moment": Part("line", line={"moment": (2.0, 3.0)}),
    "local shell": Part("shell", {"shell": LocalShell(1e-12)}),
    "thick shell": Part("shell", {"shell": ThickShell(outer_diameter=0.3, modulus=2.1e11)}),
    "heat": Part("heat", {"lubricant": None, "heat": Heat("iso-vg-68")}),
    "heat, stored": Part("heat", {"lubricant": None, "heat": Heat("iso-vg-68", capacity=1e5)}),
    "heat, stored, with growth": Part(
        "heat", {"lubricant": None, "heat": Heat("iso-vg-68", capacity=1e5, growth=Growth())}
    ),
    "heat over the area": Part("heat", {"lubricant": None, "heat": FilmHeat("iso-vg-68")}),
    "growth over the area": Part(
        "heat", {"lubricant": None, "heat": FilmHeat("iso-vg-68", growth=RingGrowth(0.3))}
    ),
    "contact": Part("contact", {"contact": _ROUGH}),
    "turbulence": Part("flow", {"turbulence": Turbulence(begin=0.0, end=0.0)}),
    "viscosity under pressure": Part("heat", {"lubricant": Lubricant(0.03, 870.0, 2e-8)}),
}
"""Every part by its name."""


def asked(names: Iterable[str], rung: str) -> tuple[Film, JournalGeometry, dict[str, Any]]:
    """Film, bearing and arguments of the verbs with the parts of these names."""
    film, bearing = FILM | {"cavitation": _MIXTURE}, dict(BEARING)
    line: dict[str, Any] = {}
    for name in names:
        part = PARTS[name]
        film, bearing, line = film | part.film, bearing | part.bearing, line | part.line
    return Film(**film, rung=rung), JournalGeometry(**bearing), line


def asks(names: Iterable[str], occasion: str) -> bool:
    """Whether the verb has words for these parts: no moment is given with a position."""
    return not (occasion == "position" and "moment" in names)


def refused(names: Iterable[str], rung: str, occasion: str) -> str | None:
    """Why parts do not go together on a rung on an occasion, by its name; or None."""
    film, bearing, line = asked(names, rung)
    if not asks(names, occasion):
        return "the moment is part of the answer"
    verb, steps = OCCASIONS[occasion]
    rows: dict[str, Any] = {name: np.array([values]) for name, values in line.items()}
    return why_not(verb, film, bearing, Line(**rows), steps)


def table(rung: str) -> list[str]:
    """Lines of the table of a rung: for each two parts the occasions on which they go together."""
    letters = {"position": "p", "rest": "r", "motion": "m", "adaptive": "a", "closed": "c"}
    rows = list(PARTS)
    lines = [f"| | {' | '.join(rows)} |", f"|---|{'---|' * len(rows)}"]
    for one in rows:
        cells = []
        for other in rows:
            same = one != other and PARTS[one].axis == PARTS[other].axis
            known = [
                letter
                for occasion, letter in letters.items()
                if not same and refused({one, other}, rung, occasion) is None
            ]
            cells.append(" " if same else " ".join(known) or "–")
        lines.append(f"| {one} | {' | '.join(cells)} |")
    return lines
