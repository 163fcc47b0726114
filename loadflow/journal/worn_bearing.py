"""A journal bearing after its wear."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class WornBearing:
    """A bore after its wear, the surfaces as they have run in, and how they came there.

    Attributes
    ----------
    bearing : JournalBearing
        With the worn contour as its relief: all verbs answer for the worn bore.
    film : Film
        With the roughness that is left.
    angle, z : array (n,), (m,)
        Places of the contour, rad and m.
    depth : array (n, m)
        Worn depth, m.
    volume : float
        Worn volume, m³.
    work : float
        ∬∫ p dA ds of the asperities, N m; without running-in the volume is k times that.
    history : xarray.Dataset
        Over ``renewal`` (and ``cycle``), each film that was solved: `life`, the share of all cycles
        that is over, `depth`, `volume`, `roughness`, and of each cycle `minimum_film`,
        `contact_time`, `contact_speed` (largest speed in contact), `contact_energy`,
        `friction_energy`, `contact_pressure`.
    converged, residual, iterations
        Whether the whole life was followed, what is left of the load of the asperities, and the
        films that were solved.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import Contact, Cycle, Film, JournalBearing, Lubricant, Reynolds
    >>> from loadflow.journal import Wear, wear_bearing
    >>> from loadflow.tribology import Archard, AsperityContact
    >>> rough = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
    >>> film = Film(Lubricant(0.03), Reynolds(), grid=(60, 8), contact=Contact(rough))
    >>> turn = Cycle([0.0, 1.0], [(4e4, 0.0)] * 2, [0.5, 0.5], 1e3, in_motion=False)
    >>> worn = wear_bearing(JournalBearing(0.2, 0.1, 1e-3), [turn], film, Wear(Archard(1e-17)))
    >>> worn.converged, worn.depth.shape[0] == worn.angle.size
    (True, True)
    """

    bearing: JournalBearing
    film: Film
    angle: Array
    z: Array
    depth: Array
    volume: float
    work: float
    history: xr.Dataset
    converged: bool
    residual: float
    iterations: int
