"""Where mixed friction begins: E_krit of a full cylinder, and its film in lobes and on pads."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.geometry import JournalGeometry


@dataclass(frozen=True)
class Critical:
    """Eccentricity ratio, or smallest film, beyond which friction is mixed.

    [Jonuschies 2015] states E_krit of a full cylinder (5.2), and the film that it leaves there
    (5.1), 37.5 µm where the radial clearance c is 0.75 mm: (1 − E_krit) c. The gap of arcs, lobes
    and pads closes at no certain ε; of them the same film is taken, with the clearance c of the
    assembled bore. Lobes without preload and with grooves as small as one likes, and an arc that is
    loaded in its middle, then have the E_krit of the cylinder.

    Attributes
    ----------
    ratio : float
        E_krit; infinite where a film says it.
    film : float
        m; 0 where E_krit says it.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lobes
    >>> from loadflow.journal.critical import Critical
    >>> Critical.of(JournalBearing(1.5, 1.5, 1e-3), 0.95)
    Critical(ratio=0.95, film=0.0)
    >>> lemon = Critical.of(JournalBearing(1.5, 1.5, 1e-3, shape=Lobes(2, preload=0.3)), 0.95)
    >>> f"{1e6 * lemon.film:.1f} µm"
    '37.5 µm'
    >>> round(lemon.left(1.1, 75e-6).item(), 6)
    2.0
    """

    ratio: float = math.inf
    film: float = 0.0

    @classmethod
    def of(cls, bearing: JournalGeometry, ratio: float) -> Critical:
        """That of a bearing whose full cylinder would have an E_krit."""
        if bearing.shape.segments:
            return cls(film=(1.0 - ratio) * bearing.clearance)
        return cls(ratio)

    @classmethod
    def told(cls, attributes: Mapping[str, Any]) -> Critical:
        """That of samples of a film, as their attributes tell it; none where they do not."""
        return cls(
            float(attributes.get("critical_eccentricity_ratio", math.inf)),
            float(attributes.get("critical_film", 0.0)),
        )

    @property
    def attributes(self) -> dict[str, float]:
        """What samples of a film tell of it."""
        return {"critical_eccentricity_ratio": self.ratio, "critical_film": self.film}

    def left(self, ratio: ArrayLike, film: ArrayLike) -> NDArray[np.float64]:
        """Film that is left over that at which friction becomes mixed; below 1 it is.

        Parameters
        ----------
        ratio, film : array
            Eccentricity ratio, and smallest film, m.
        """
        if self.film > 0:
            return np.asarray(film, float) / self.film
        if math.isfinite(self.ratio):
            return (1.0 - np.asarray(ratio, float)) / (1.0 - self.ratio)
        return np.full(np.shape(ratio), np.inf)
