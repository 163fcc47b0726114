"""Films with effects and without them share their compiled loops."""

from dataclasses import replace

import numpy as np
import pytest
from numba import typeof

from loadflow.journal import Film, Groove, JournalBearing, Lubricant, Supply, Turbulence
from loadflow.journal.cavitation import GasMixture
from loadflow.journal.contact import Contact
from loadflow.journal.line import Line
from loadflow.journal.models.composed.model import build
from loadflow.journal.shells import LocalShell
from loadflow.tribology.asperities import AsperityContact

BEARING = JournalBearing(diameter=1.2, width=0.9, relative_clearance=1e-3)
FILM = Film(
    lubricant=Lubricant(0.05), edge_pressure=1.5e5, cavitation=GasMixture(5e4), grid=(60, 20),
    inlet=None, rung="reduced", grading="uniform",
)  # fmt: skip
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)
EFFECTS = {
    "asperities": {"contact": ROUGH},
    "turbulence": {"turbulence": Turbulence()},
    "supply": {"supply": Supply((Groove(1.57, arc=0.3, length=0.4, pressure=3e5),))},
    "elastic shell": {"shell": LocalShell(3e-12)},
}


def kinds_of(film):
    """Types by which numba chooses the loops of a film around a tilted shaft."""
    model = build(BEARING, film, np.array([2.0]), Line(tilt=np.array([[6e-5, 3e-5]])))
    return typeof(model.film), typeof(model.work)


@pytest.mark.parametrize("effect", EFFECTS)
def test_an_effect_asks_for_no_loops_of_its_own(effect):
    """Compiling the loops takes half a minute."""
    assert kinds_of(replace(FILM, **EFFECTS[effect])) == kinds_of(FILM)
