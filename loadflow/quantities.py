"""The table of quantities: symbol, unit and meaning of what results give, stated once.

Results, orbits, stages and command line read what they say of a name from here.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from loadflow.errors import InputError


class Quantity(NamedTuple):
    """A quantity of a result.

    Attributes
    ----------
    symbol : str
        As formulas have it.
    units : str
        SI; "1" without dimension.
    meaning : str
        In one line.
    """

    symbol: str
    units: str
    meaning: str

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of an xarray variable."""
        return {"units": self.units, "long_name": self.meaning}


HOURS_PER_YEAR = 8766.0
"""Of 365.25 days."""

READABLE = {
    "N": (1e-3, "kN"),
    "N m": (1e-6, "MN m"),
    "Pa": (1e-6, "MPa"),
    "Pa s": (1e3, "mPa s"),
    "W": (1e-3, "kW"),
    "h": (1 / HOURS_PER_YEAR, "years"),
    "rad/s": (30 / math.pi, "1/min"),
    "rad": (180 / math.pi, "°"),
    "W/m^2": (1e-3, "kW/m²"),
    "m^3/s": (6e4, "l/min"),
    "m3/s": (6e4, "l/min"),  # of files of former versions
    "megarevolution": (1.0, "Mrev"),
    "1e6 revolution": (1.0, "Mrev"),  # of files of former versions
    "1": (1.0, "–"),
    "": (1.0, "–"),
}
"""Factor and unit in which an engineer reads each SI unit that the data hold."""

CELSIUS = 273.15
"""Temperature of 0 °C, K."""

_SMALLER = {
    "N": ((1.0, "N"),),
    "N m": ((1e-3, "kN m"), (1.0, "N m")),
    "Pa": ((1e-3, "kPa"), (1.0, "Pa")),
    "W": ((1.0, "W"),),
    "h": ((1.0, "h"),),
    "m": ((1e3, "mm"), (1e6, "µm")),
}
"""Smaller units than those of `READABLE`, in order."""


def fitting_unit(units: str, largest: float) -> tuple[float, str]:
    """Return factor and unit in which a number of some size is read without leading zeros.

    Parameters
    ----------
    units : str
        SI unit of the number.
    largest : float
        Its magnitude, or the largest of several.

    Examples
    --------
    >>> fitting_unit("N m", 16.0), fitting_unit("N m", 2e6)
    ((1.0, 'N m'), (1e-06, 'MN m'))
    """
    usual = READABLE.get(units, (1.0, units))
    for factor, unit in (usual, *_SMALLER.get(units, ())):
        if factor * largest >= _LEAST:
            return factor, unit
    return usual if largest == 0 or not _SMALLER.get(units) else _SMALLER[units][-1]


_LEAST = 0.1


def factor_to(unit: str, units: str) -> float:
    """Return the factor from an SI unit to one in which an engineer reads it.

    Parameters
    ----------
    unit : str
        That is wanted.
    units : str
        SI unit.

    Raises
    ------
    loadflow.errors.InputError
        Numbers of `units` are not shown in `unit`.

    Examples
    --------
    >>> factor_to("µm", "m"), factor_to("kN m", "N m")
    (1000000.0, 0.001)
    """
    known = [READABLE[units]] if units in READABLE else []
    every = [(1.0, units), *known, *_SMALLER.get(units, ())]
    for factor, shown in every:
        if shown == unit:
            return factor
    names = ", ".join(dict.fromkeys(shown for _, shown in every))
    raise InputError(f"units: {unit!r} is no unit of numbers in {units}; there are {names}")


def scale_of(units: str) -> tuple[float, str]:
    """Zero and unit of the scale on which a value is read, not a difference of two.

    Examples
    --------
    >>> scale_of("K"), scale_of("N")
    ((273.15, '°C'), (0.0, 'N'))
    """
    return (CELSIUS, "°C") if units == "K" else (0.0, units)


def four_digits(value: float) -> str:
    """Return a number with four digits, written out up to ten million.

    Examples
    --------
    >>> four_digits(0.0123456), four_digits(13394.2), four_digits(2.5e9), four_digits(-10000.0)
    ('0.01235', '13390', '2.5e+09', '-10000')
    """
    rounded = float(f"{value:.4g}")
    return f"{rounded:.0f}" if 1e4 <= abs(rounded) < 1e7 else f"{value:.4g}"


def load_cases(count: int) -> str:
    """Return a number of load cases in words.

    Examples
    --------
    >>> load_cases(1), load_cases(66)
    ('1 load case', '66 load cases')
    """
    return f"{count} load case{'s' * (count != 1)}"


def three_digits(value: float) -> str:
    """Return a number with three digits, and all of those before its point up to ten million.

    Examples
    --------
    >>> three_digits(1.6), three_digits(109.2), three_digits(1352.4)
    ('1.60', '109', '1,352')
    """
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 999.5:
        return f"{value:#.3g}".rstrip(".")
    return f"{value:,.0f}" if 999.5 <= abs(value) < 1e7 else f"{value:.2e}"


def percent(share: float, signed: bool = False) -> str:
    """Return a share as a percentage of two digits, written out.

    Examples
    --------
    >>> percent(0.0123), percent(1.04), percent(-0.5, signed=True)
    ('1.2 %', '100 %', '-50 %')
    """
    value = float(f"{100.0 * share:.2g}")
    sign = "+" if signed else ""
    return f"{value:{sign}.0f} %" if abs(value) >= 100.0 else f"{value:{sign}.2g} %"


FILM: dict[str, Quantity] = {
    "force": Quantity("F", "N", "what the shaft applies to the bearing"),
    "film_force": Quantity("−F", "N", "force of the film on the shaft"),
    "speed": Quantity("ω", "rad/s", "speed of the shaft"),
    "eccentricity": Quantity("e", "m", "shaft centre relative to the shell"),
    "eccentricity_ratio": Quantity("ε", "1", "eccentricity ratio"),
    "attitude_angle": Quantity("β", "rad", "attitude angle"),
    "minimum_film": Quantity("h_min", "m", "smallest film thickness"),
    "maximum_pressure": Quantity("p_max", "Pa", "largest film pressure, absolute"),
    "contact_force": Quantity("F_a", "N", "part of the load that asperities carry"),
    "contact_pressure": Quantity("p_a", "Pa", "largest pressure of touching asperities"),
    "contact_area": Quantity("A_r/A", "1", "largest real over nominal area of contact"),
    "contact_power": Quantity("P_a", "W", "friction power of touching asperities"),
    "contact_share": Quantity("F_a/F", "1", "share of the load that asperities carry"),
    "sommerfeld_number": Quantity("So", "1", "Sommerfeld number"),
    "friction_power": Quantity("P_f", "W", "friction power"),
    "side_flow": Quantity("Q_s", "m^3/s", "side flow"),
    "supply_flow": Quantity("Q", "m^3/s", "flow of the grooves into the film"),
    "supply_power": Quantity("P_Q", "W", "power that lifts the oil to supply pressure"),
    "groove_flow": Quantity("Q_g", "m^3/s", "flow of each groove into the film"),
    "groove_pressure": Quantity("p_g", "Pa", "pressure of each groove, absolute"),
    "starved": Quantity("", "1", "whether a fed groove gives less than the film would draw"),
    "total_fill": Quantity("F", "1", "share of liquid in the gap"),
    "reynolds_number": Quantity("Re", "1", "Reynolds number of the gap"),
    "critical_reynolds_number": Quantity("Re_cr", "1", "Re at which the flow turns turbulent"),
    "laminar": Quantity("", "1", "whether the flow is laminar"),
    "stiffness": Quantity("K", "N/m", "−∂F/∂e of the film; of moments and tilts in N, N m"),
    "damping": Quantity("C", "N s/m", "−∂F/∂ė of the film; of moments and tilts in N s, N m s"),
    "moment": Quantity("M", "N m", "moment of the shaft on the bearing about its middle"),
    "restoring_moment": Quantity("M_r", "N m", "moment of films on a tilted collar, its size"),
    "tilt": Quantity("γ", "rad", "rotation of the shaft about both axes"),
    "pad_tilt": Quantity("δ", "rad", "rotation of each pad about its pivot"),
    "shell_deformation": Quantity("", "m", "largest growth of the gap by the elastic shell"),
    "temperature": Quantity("T", "K", "effective temperature of the film"),
    "clearance": Quantity("c", "m", "radial clearance as shaft and shell have grown"),
    "inlet_temperature": Quantity("T_in", "K", "temperature of the oil that enters"),
    "outlet_temperature": Quantity("T_out", "K", "temperature of the oil that leaves"),
    "viscosity": Quantity("η", "Pa s", "viscosity at the effective temperature"),
    "heat_residual": Quantity("", "K", "what is left of the heat balance"),
    "heat_iterations": Quantity("", "1", "temperatures tried"),
    "maximum_temperature": Quantity("T_max", "K", "largest temperature of the film"),
    "shaft_temperature": Quantity("T_s", "K", "temperature of the shaft"),
    "heat_carried": Quantity("", "W", "heat that leaves with the oil"),
    "heat_conducted": Quantity("", "W", "heat that passes into shell and shaft"),
    "heat_imbalance": Quantity("", "1", "what is missing of the heat balance, over the friction"),
    "leading_temperature": Quantity("T_in", "K", "temperature of the oil that leaves each groove"),
    "trailing_temperature": Quantity(
        "T_out", "K", "temperature of the oil that enters each groove"
    ),
    "film_temperature": Quantity("T", "K", "temperature of each cell"),
    "surface_temperature": Quantity(
        "T", "K", "temperature of the surface of the shell at each cell"
    ),
    "thermal_growth": Quantity("", "m", "growth of the gap of each cell by heat"),
    "film_viscosity": Quantity("η", "Pa s", "viscosity in each cell"),
    "pressure": Quantity("p", "Pa", "film pressure, absolute"),
    "fill": Quantity("F", "1", "share of liquid in each cell"),
    "deformation": Quantity("", "m", "growth of the gap by the elastic shell"),
    "gap": Quantity("h", "m", "mean gap of each cell"),
    "angle": Quantity("θ", "rad", "angle of the cell centres from the first axis"),
    "z": Quantity("z", "m", "axial place of the cell centres from mid-plane"),
    "resolved": Quantity("", "1", "whether the cells resolve the film"),
    "converged": Quantity("", "1", "whether the equilibrium was found"),
    "residual": Quantity("", "1", "scaled residual of film and load"),
    "iterations": Quantity("", "1", "iterations"),
    "steps": Quantity("", "1", "implicit steps since the time before"),
    "in_range": Quantity("", "1", "whether the model covers position and load"),
}
"""Of a film, at rest, at a position and in time."""

GRID_ERROR = "_grid_error"
"""Ending of the name of the bound of what the cells do to a quantity."""


def _short(name: str) -> str:
    """Meaning of a quantity in few words."""
    return "force" if name == "force" else FILM[name].meaning.split(",")[0]


FILM |= {
    name + GRID_ERROR: Quantity(
        f"Δ{FILM[name].symbol}",
        FILM[name].units,
        f"bound of what the cells do to the {_short(name)}",
    )
    for name in (
        "force", "eccentricity_ratio", "attitude_angle", "minimum_film", "maximum_pressure",
        "friction_power", "side_flow",
    )
}  # fmt: skip

ROLLING: dict[str, Quantity] = {
    "force": Quantity("F", "N", "force on the inner ring"),
    "moment": Quantity("M", "N m", "moment on the inner ring"),
    "displacement": Quantity("u", "m, rad", "displacement and tilt of the inner ring"),
    "stiffness": Quantity("K", "N/m, N, N m/rad", "tangent stiffness"),
    "element_forces": Quantity("Q", "N", "force on each rolling element"),
    "maximum_force": Quantity("Q_max", "N", "largest force on a rolling element"),
    "maximum_pressure": Quantity("p_max", "Pa", "largest Hertzian pressure"),
    "pressure_safety": Quantity("", "1", "allowable over largest pressure"),
    "static_safety": Quantity("s_0", "1", "allowable over largest force"),
    "equivalent_load": Quantity("P", "N", "dynamic equivalent load"),
    "rating_life": Quantity("L_10", "megarevolution", "basic rating life"),
    "reference_life": Quantity("L_10r", "megarevolution", "reference life of ISO/TS 16281"),
    "converged": Quantity("", "1", "whether every component is balanced"),
    "residual": Quantity("", "1", "largest unbalanced component over the load"),
    "iterations": Quantity("", "1", "Newton steps"),
    "singular": Quantity("", "1", "whether a motion meets no resistance"),
}
"""Of a rolling bearing, at rest and in time."""


def table(*names: str) -> dict[str, tuple[str, str]]:
    """Units and meaning of quantities of a film.

    Examples
    --------
    >>> table("minimum_film")
    {'minimum_film': ('m', 'smallest film thickness')}
    """
    return {name: (FILM[name].units, FILM[name].meaning) for name in names}
