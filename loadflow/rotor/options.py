"""What the rotor model includes."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Annotated, Literal

from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError

Rung = Literal["tables", "bem", "flap", "tower"]
RUNGS: tuple[Rung, ...] = ("tables", "bem", "flap", "tower")
"""Rigid blades with tabulated induction; with induction solved at every step; bending blades; those
on a tower that bends and a drivetrain that twists.
"""

STEPS = (0.005, 0.1)
"""Shortest and longest step of the simulation, s."""


@dataclass(frozen=True)
class RotorOptions:
    """Switches of the rotor model.

    Attributes
    ----------
    modes : tuple of str
        Blade modes of the turbine file that may move; empty: rigid blades. The rung sets it.
    tabulated : bool
        Induction from a table instead of solving it at every section and step. The rung sets it.
    tower_motion, drivetrain_torsion : bool
        Whether the tower bends and the drivetrain twists; on the rung "tower" only.
    bend_twist : float
        Nose-down turn of a section, per product of its slopes out of and in the rotor plane, of a
        blade that bends both ways without twisting: 1/2 in the axes of OpenFAST's AeroDyn, which
        take the sweep out first; −1/2 for the section as it stands in the flow; 0 off.
    blade_torsion : bool
        Whether bending blades twist under their loads, quasi-statically, where the turbine tells
        their torsional stiffness.
    air_density : float
        kg/m³.
    skew_factor : float
        Factor of Pitt and Peters' redistribution of the induction under oblique inflow; 15π/32
        (OpenFAST's), 15π/64 (steady theory), 0 off.
    drag_in_induction : bool
        Whether drag counts in the momentum balance.
    shed_wake : bool
        Whether lift and drag lag behind the angle of attack as the wake is shed, and a section that
        turns about its span is met at three quarters of its chord.
    dynamic_inflow : bool
        Whether the induced velocity lags behind the load on the rotor (Øye's two time constants).
    dynamic_stall : bool, optional
        Whether separation lags behind lift; by default only where the rotor is parked or idles.
        Without this and `shed_wake` the polars hold at once, and blades that stand in an oblique
        storm draw from it a swing that is not real.
    tower_dam : bool
        Whether the blades pass through the potential flow around the tower.
    individual_pitch : bool
        Whether each blade pitches by itself against the tilt and yaw moment of the rotor.
    mass_imbalance : float
        Excess mass of blade 1, share of its mass.
    pitch_imbalance : float
        Pitch offset of blade 1, rad.

    Examples
    --------
    >>> from loadflow.rotor import RotorOptions
    >>> RotorOptions(dynamic_stall=True, skew_factor=0.0).air_density
    1.225
    """

    modes: tuple[str, ...] = ("flap1", "flap2", "edge1")
    tabulated: bool = False
    tower_motion: bool = True
    drivetrain_torsion: bool = True
    bend_twist: Annotated[float, Ge(-1), Le(1)] = 0.5
    blade_torsion: bool = True
    air_density: Annotated[float, Gt(0)] = 1.225
    skew_factor: Annotated[float, Ge(0), Le(2)] = 1.4726215563702154
    drag_in_induction: bool = False
    shed_wake: bool = True
    dynamic_inflow: bool = False
    dynamic_stall: bool | None = None
    tower_dam: bool = True
    individual_pitch: bool = False
    mass_imbalance: Annotated[float, Ge(-0.2), Le(0.2)] = 0.0
    pitch_imbalance: Annotated[float, Ge(-0.2), Le(0.2)] = 0.0

    def __post_init__(self) -> None:
        if not 0 < self.air_density < inf:
            raise InputError(
                f"air_density = {self.air_density} is not allowed; > 0 kg/m³ and finite"
            )
        if not 0 <= self.skew_factor <= 2:
            raise InputError(f"skew_factor = {self.skew_factor} is not allowed; 0 … 2")
        if not -1 <= self.bend_twist <= 1:
            raise InputError(f"bend_twist = {self.bend_twist} is not allowed; -1 … 1")
        for name in ("mass_imbalance", "pitch_imbalance"):
            value = getattr(self, name)
            if not -0.2 <= value <= 0.2:
                raise InputError(f"{name} = {value} is not allowed; -0.2 … 0.2")
