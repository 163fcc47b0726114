"""A journal bearing after its wear."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film
from loadflow.numerics.shown import Shown, in_words
from loadflow.quantities import Quantity

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]


_SHOWN = {
    "deepest": Quantity("", "m", "deepest place of the worn bore"),
    "volume": Quantity("V", "m^3", "worn volume"),
    "work": Quantity("W", "N m", "pressure of the asperities over the distance that they slid"),
    "roughness": Quantity("σ", "m", "roughness that is left"),
    "converged": Quantity("", "1", "whether the whole life was followed"),
    "residual": Quantity("", "1", "what is left of the load of the asperities"),
    "iterations": Quantity("", "1", "films that were solved"),
}


@dataclass(frozen=True, eq=False, repr=False)
class WornBearing(Shown):
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

    @property
    def deepest(self) -> float:
        """Deepest place of the worn bore, m."""
        return float(self.depth.max())

    @property
    def roughness(self) -> float:
        """Roughness that is left after the life, m."""
        return float(self.history["roughness"][-1])

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a worn bore."""
        return _SHOWN

    def to_dataset(self) -> xr.Dataset:
        """The worn contour over ``angle`` and ``z`` beside the history, with units.

        Returns
        -------
        xarray.Dataset
            `depth_of_bore` (angle, z) is the contour after the life; `depth` (renewal) of the
            history its deepest place on the way there. Volume, work and search are attributes.
        """
        depth = Quantity("", "m", "worn depth after the life").attributes
        angle = Quantity("", "rad", "from straight down, with the rotation").attributes
        z = Quantity("", "m", "place across the width, from its middle").attributes
        return (
            self.history.assign(depth_of_bore=(("angle", "z"), self.depth, depth))
            .assign_coords(angle=("angle", self.angle, angle), z=("z", self.z, z))
            .assign_attrs(
                films=self.iterations, residual=self.residual, volume=self.volume, work=self.work
            )
        )

    def plot(self) -> Figure:
        """Draw the worn contour, and its deepest place over the life."""
        from loadflow import plots

        drawing, (contour, way) = plots.figure(1, 2, height=3.0)
        order = np.argsort((self.angle + np.pi) % (2 * np.pi))
        angle = (np.degrees(self.angle[order]) + 180) % 360 - 180
        if self.z.size > 1:
            shown = contour.pcolormesh(
                angle, 1e3 * self.z, 1e6 * self.depth[order].T, cmap="viridis", shading="nearest"
            )
            drawing.colorbar(shown, ax=contour, label="worn depth, µm")
            contour.set_ylabel("axial place, mm")
            contour.grid(False)
        else:
            contour.plot(angle, 1e6 * self.depth[order, 0])
            contour.set_ylabel("worn depth, µm")
        contour.set_xlabel("angle from straight down, °")
        way.plot(100 * self.history["life"], 1e6 * self.history["depth"], "o-", ms=3)
        way.set(xlabel="share of the life, %", ylabel="deepest place, µm")
        return drawing

    def __repr__(self) -> str:
        depth, unit = in_words(np.array(self.deepest), "m")
        said = "converged" if self.converged else "not converged"
        return f"<WornBearing, {depth} {unit} deep, {self.iterations} films, {said}>"
