"""Contacts of points and of lines as Hertz has them: what is known of them, shown and drawn."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.shown import Shown, in_words
from loadflow.quantities import Quantity

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]

_OF_POINTS = {
    "pressure": Quantity("p_max", "Pa", "largest pressure"),
    "approach": Quantity("δ", "m", "mutual approach of the two bodies"),
    "stiffness": Quantity("K", "N/m^1.5", "stiffness factor K of force = K approach^1.5"),
    "major_semi_axis": Quantity("a", "m", "major semi-axis of the contact ellipse"),
    "minor_semi_axis": Quantity("b", "m", "minor semi-axis of the contact ellipse"),
    "ellipticity": Quantity("a/b", "1", "major over minor semi-axis"),
    "coefficient": Quantity("δ*", "1", "Hertz's coefficient of the approach"),
}

_OF_LINES = {
    "pressure": Quantity("p_max", "Pa", "largest pressure"),
    "approach": Quantity("δ", "m", "mutual approach of the two bodies"),
    "stiffness": Quantity("k", "N/m", "tangent stiffness"),
    "semi_width": Quantity("b", "m", "half the width of the contact strip"),
}


class _HertzContact(Shown):
    """What contacts of points and of lines show of themselves."""

    pressure: Array

    @property
    @abstractmethod
    def _reach(self) -> Mapping[str, Array]:
        """How far the contact reaches from its middle, m, by direction."""

    def to_dataset(self) -> xr.Dataset:
        """The contact over ``case``, with units; of one load case without that dimension.

        Examples
        --------
        >>> from loadflow.tribology import hertz_point
        >>> data = hertz_point(50.0, 50.0, 25.0, 25.0, force=[100.0, 200.0]).to_dataset()
        >>> data["pressure"].dims, data["pressure"].units
        (('case',), 'Pa')
        """
        import xarray as xr

        told = self.shown_quantities()
        whole = np.broadcast_arrays(*(getattr(self, name) for name in told))
        if not whole[0].ndim:
            return xr.Dataset({n: ((), x, told[n].attributes) for n, x in zip(told, whole)})
        return xr.Dataset({n: ("case", x.ravel(), told[n].attributes) for n, x in zip(told, whole)})

    def plot(self) -> Figure:
        """Draw the pressure from the middle to the edges of the contact that is pressed most.

        Examples
        --------
        >>> from loadflow.tribology import hertz_line
        >>> drawing = hertz_line(100.0, 0.0, length=0.03, force=2e4).plot()
        >>> round(float(drawing.axes[0].lines[0].get_ydata().max()))  # MPa
        1565
        """
        from loadflow import plots

        drawing, axis = plots.figure(1, 1, height=3.0)
        hardest = int(np.argmax(self.pressure))
        share = np.linspace(-1.0, 1.0, 201)
        inside = np.sqrt(1.0 - share**2) * np.ravel(self.pressure)[hardest] / 1e6
        for name, reach in self._reach.items():
            far = np.ravel(np.broadcast_to(reach, np.shape(self.pressure)))[hardest]
            axis.plot(1e3 * far * share, inside, label=name)
        axis.set(xlabel="from the middle, mm", ylabel="pressure, MPa")
        axis.legend()
        return drawing

    def __repr__(self) -> str:
        pressure, unit = in_words(self.pressure, "Pa")
        return f"<{type(self).__name__}, largest pressure {pressure} {unit}>"


@dataclass(frozen=True, repr=False)
class PointContact(_HertzContact):
    """Elliptical contact of two bodies; numbers of equations are those of [Ritzer 2018].

    Attributes
    ----------
    stiffness : ndarray
        Contact stiffness factor K of ``force = K * approach**1.5``, N/m^1.5, (3.5).
    approach : ndarray
        Mutual approach of the two bodies, m, (2.5).
    pressure : ndarray
        Largest (central) pressure, Pa, (2.1).
    semi_axes : tuple of ndarray
        Major and minor semi-axis of the contact ellipse, m.
    ellipticity : ndarray
        Major over minor semi-axis, at least 1.
    coefficient : ndarray
        Hertz's coefficient ψ/ξ of the approach (δ* of Harris).

    Examples
    --------
    >>> from loadflow.tribology import hertz_point
    >>> contact = hertz_point(50.0, 50.0, 25.0, 25.0, force=100.0)
    >>> round(float(contact.pressure) / 1e6), round(float(contact.ellipticity), 3)
    (1132, 1.0)
    """

    stiffness: Array
    approach: Array
    pressure: Array
    semi_axes: tuple[Array, Array]
    ellipticity: Array
    coefficient: Array

    @property
    def major_semi_axis(self) -> Array:
        """Of the contact ellipse, m."""
        return self.semi_axes[0]

    @property
    def minor_semi_axis(self) -> Array:
        """Of the contact ellipse, m."""
        return self.semi_axes[1]

    @property
    def _reach(self) -> Mapping[str, Array]:
        return dict(zip(("along the major axis", "along the minor axis"), self.semi_axes))

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a contact at a point."""
        return _OF_POINTS


@dataclass(frozen=True, repr=False)
class LineContact(_HertzContact):
    """Contact of two bodies along a line [Hertz 1881], its approach by the law of `hertz_line`.

    Attributes
    ----------
    stiffness : ndarray
        Tangent stiffness d(force)/d(approach), N/m.
    approach : ndarray
        Mutual approach of the two bodies, m.
    pressure : ndarray
        Largest pressure, Pa.
    semi_width : ndarray
        Half the width of the contact strip, m.

    Examples
    --------
    >>> from loadflow.tribology import hertz_line
    >>> contact = hertz_line(100.0, 0.0, length=0.03, force=2e4)
    >>> round(float(contact.pressure) / 1e6), round(float(contact.semi_width) * 1e6)  # MPa, µm
    (1565, 271)
    """

    stiffness: Array
    approach: Array
    pressure: Array
    semi_width: Array

    @property
    def _reach(self) -> Mapping[str, Array]:
        return {"across the line": self.semi_width}

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a contact along a line."""
        return _OF_LINES
