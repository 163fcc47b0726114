"""Friction torque of a driven crank over speed: main bearings, bearing on the pin, cage, seals.

The rig of von Hollen 2013 in its three configurations: a throw with rollers on its pin
(`CrankRig()`), with a journal bearing there (`pin_film`), and a straight shaft (`drive=None`). The
geometry of its bearings is that of Tables 8.1 … 8.4; masses, the pocket angle and the journal
bearing are not printed, and are assumed where they stand.
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, ValidityWarning
from loadflow.journal import Contact, Film, Guembel, JournalBearing, Lubricant
from loadflow.numerics.fields import check_one_of
from loadflow.rolling import FrictionOptions
from loadflow.rolling import friction as parts
from loadflow.rolling.friction import RollerGaps
from loadflow.rolling.kinematics import common_period
from loadflow.rolling.motion.cage import CageRim, cage_orbit
from loadflow.rolling.motion.crank import CrankDrive
from loadflow.rolling.motion.history import (
    GRAVITY,
    RollerHistory,
    RollerRow,
    crank_history,
    radial_history,
)
from loadflow.rolling.motion.radial_load import behw_law, radial_distribution
from loadflow.rolling.motion.rollers import coulomb_motion, film_motion
from loadflow.rolling.motion.torque import FrictionTorque, coulomb_torque, film_torque
from loadflow.tribology import AsperityContact, lubricant

Array = NDArray[np.float64]
Stage = Literal["coulomb", "film"]

CREEP = 10.0
"""Speed, 1/min, that stands for rest: at a tenth of it the torque of rollers changes by 0.2 %."""


@dataclass(frozen=True, kw_only=True)
class RowOnRig:
    """A row of rollers with what brakes it.

    Attributes
    ----------
    row : RollerRow
        Rollers.
    gaps : RollerGaps
        Pockets and ribs.
    clearance : float
        Diametral, m.
    """

    row: RollerRow
    gaps: RollerGaps
    clearance: float


MAIN = RowOnRig(
    row=RollerRow(
        rollers=14, roller_diameter=11e-3, roller_length=11e-3, pitch_diameter=60.5e-3,
        roller_mass=11e-3,
    ),
    gaps=RollerGaps(
        radius=5.5e-3, length=11e-3, end_gaps=(0.4e-3, 0.4e-3), rib_gaps=(0.06e-3, 0.06e-3),
        pocket_gaps=(0.39e-3, 0.39e-3), rib_height=1.6e-3, cage_half_height=2.75e-3,
        pocket_angle=math.radians(30), roughness=3.84e-6, pitch_diameter=60.5e-3,
    ),
    clearance=8e-6,
)  # fmt: skip
"""NU2208, Table 8.2; the pocket angle and the height of the cage are assumed."""

PIN = RowOnRig(
    row=RollerRow(
        rollers=18, roller_diameter=7.5e-3, roller_length=18e-3, pitch_diameter=55.5e-3,
        roller_mass=6.67e-3,
    ),
    gaps=RollerGaps(
        radius=3.75e-3, length=18e-3, end_gaps=(0.33e-3, 0.33e-3), rib_gaps=(0.473e-3, 0.473e-3),
        pocket_gaps=(0.06e-3, 0.06e-3), rib_height=0.0, cage_half_height=2.5625e-3,
        pocket_angle=math.radians(43.1), roughness=5e-6, pitch_diameter=55.5e-3,
    ),
    clearance=25e-6,
)  # fmt: skip
"""Crank-pin bearing, Table 8.1; as `MAIN`."""


@dataclass(frozen=True, kw_only=True)
class CrankRig:
    """A crank throw, or a straight shaft, that is driven against its own friction.

    Attributes
    ----------
    drive : CrankDrive, optional
        Crank, rod and masses (assumed: those of a 1.8 l engine); None: a straight shaft.
    load : float
        Radial load on a straight shaft, N.
    main, pin : RowOnRig
        Main bearings, which share the load evenly, and the bearing of the rod.
    main_bearings : int
        How many.
    pin_film : JournalBearing, optional
        In place of `pin`.
    oil : str
        Of `loadflow.tribology.lubricant_names`.
    temperature : float
        K.
    film : str
        Law of the films in stage "film": "moes" in all regimes with asperities and hysteresis, or,
        as von Hollen has it, elastic films alone between smooth surfaces, such as "hamrock".
    adhesion, sliding, rolling : float
        μ, μ′ and μ_R, Table 8.4.
    cage_mass : float
        Of the pin's cage, kg, (4.72).
    cage_width, cage_gap : float
        Of its contact with the rod, and between its sides and the rod, m.
    thrust_share : float
        Axial force on the washers of the rod over the load of the pin, (8.6); 0: no washers. The
        source takes 0.04, and prints no outer radius: 37 mm is assumed, bronze with 0.07.
    seal_force : float
        Radial force of the shaft's seal, N; 0: none.

    Examples
    --------
    >>> from loadflow.studies.one_bearing.crank_rig import CrankRig
    >>> straight = CrankRig(drive=None, load=2e3)
    >>> sorted(straight.friction_torque(1000.0).torques)[:2]
    ['main drag', 'main pocket']
    """

    drive: CrankDrive | None = field(
        default_factory=lambda: CrankDrive(
            radius=42.5e-3, rod_length=143.5e-3, piston_mass=0.4, rod_mass=0.6, rod_centre=43e-3
        )
    )
    load: float = 2e3
    main: RowOnRig = MAIN
    pin: RowOnRig = PIN
    main_bearings: int = 2
    pin_film: JournalBearing | None = None
    oil: str = "crankshaft-5w-30"
    temperature: float = 363.15
    film: str = "moes"
    adhesion: float = 0.12
    sliding: float = 0.04
    rolling: float = 5e-4
    cage_mass: float = 30e-3
    cage_width: float = 4e-3
    cage_gap: float = 0.27e-3
    thrust_share: float = 0.0
    seal_force: float = 11.5

    def __post_init__(self) -> None:
        if self.main_bearings < 1:
            raise InputError(f"main_bearings = {self.main_bearings}: must be 1 or more")
        if self.drive is None and self.pin_film is not None:
            raise InputError("pin_film: a straight shaft has no pin")
        for name in (
            "load",
            "seal_force",
            "thrust_share",
            "cage_mass",
            "adhesion",
            "sliding",
            "rolling",
        ):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0):
                raise InputError(f"{name} = {value}: must be finite and >= 0")

    @property
    def viscosity(self) -> float:
        """Pa s."""
        return float(lubricant(self.oil).viscosity(self.temperature))

    def friction_torque(self, rpm: float, stage: Stage = "coulomb") -> FrictionTorque:
        """All losses at a speed, 1/min, and their torque at the crank.

        Parameters
        ----------
        rpm : float
            Speed of the shaft, 1/min; 0: `torque_at_rest`.
        stage : {"coulomb", "film"}
            Von Hollen's model stage 1 or 2.

        Raises
        ------
        InputError
            A negative speed, an unknown stage, or stage 2 at rest.
        SolverError
            A motion or an orbit that is not found.
        """
        check_one_of("stage", stage, ("coulomb", "film"))
        if not (math.isfinite(rpm) and rpm >= 0):
            raise InputError(f"rpm = {rpm}: must be ≥ 0")
        if rpm == 0.0:
            if stage == "film":
                raise InputError('stage = "film": at rest there are no films; "coulomb"')
            return self.torque_at_rest()
        found = self._mains(rpm, stage) + self._seal(rpm)
        if self.drive is None:
            return found
        if self.pin_film is not None:
            return found + self._journal(self.drive, self.pin_film, rpm)
        return found + self._pin(self.drive, rpm, stage) + self._cage(self.drive, rpm)

    def torque_at_rest(self) -> FrictionTorque:
        """Torque as the shaft comes to rest, N m, part by part; its losses are those at `CREEP`.

        Only the weights of piston and rod then press on the pin. Rollers are taken at `CREEP`, a
        journal bearing rests on its asperities.

        Raises
        ------
        SolverError
            As `friction_torque`.

        Examples
        --------
        >>> from loadflow.studies.one_bearing.crank_rig import CrankRig
        >>> round(CrankRig(drive=None).torque_at_rest().torque, 2)
        0.09
        """
        if self.drive is None or self.pin_film is None:
            return self.friction_torque(CREEP)
        omega = CREEP * math.pi / 30
        pin = FrictionTorque({"pin asperities": self._rubbing(self.drive) * omega}, omega)
        return self._mains(CREEP, "coulomb") + self._seal(CREEP) + pin

    def _rubbing(self, drive: CrankDrive) -> float:
        """Torque of asperities under the weights on the pin, N m.

        How rough and how stiff they are, which is assumed, decides how deep they sink, not what
        they rub.
        """
        assert self.pin_film is not None
        asperities = AsperityContact(roughness=0.4e-6, contact_modulus=1e11, factor=1e-3)
        contact = Contact(asperities, friction=self.adhesion)
        film = Film(Lubricant(self.viscosity), Guembel(), grid=(48, 12), contact=contact)
        weight = GRAVITY * (drive.piston_mass + drive.rod_mass)
        speed = 1e-5  # rad/s: 0.01 % of the weight is left to the oil
        return float(self.pin_film.equilibrium((weight, 0.0), speed, film).friction_power) / speed

    def _mains(self, rpm: float, stage: Stage) -> FrictionTorque:
        row, omega = self.main.row, rpm * math.pi / 30
        inner, outer = row.raceways
        turns, _ = common_period(inner, outer)
        time = np.linspace(0.0, 2 * turns * 60 / rpm, 2 * turns * 180 + 1)
        force, direction = self.load / self.main_bearings, np.zeros_like(time)
        size = np.full_like(time, force)
        if self.drive is not None:
            vector = self.drive.main_load(omega * time, omega) / self.main_bearings
            size, direction = np.hypot(*vector.T), np.arctan2(vector[:, 0], vector[:, 1])
        history = radial_history(
            row, time, omega, size, self.main.clearance, behw_law(row.roller_length),
            direction=direction,
        )  # fmt: skip
        one = self._rollers(history, self.main, stage, omega, "inner", inner / (inner + outer))
        every = {name: self.main_bearings * loss for name, loss in one.losses.items()}
        return FrictionTorque(every, omega).named("main")

    def _pin(self, drive: CrankDrive, rpm: float, stage: Stage) -> FrictionTorque:
        row, omega = self.pin.row, rpm * math.pi / 30
        inner, outer = row.raceways
        turns, _ = common_period(outer, inner)  # the outer ring drives
        time = np.linspace(0.0, turns * 60 / rpm, turns * 180 + 1)
        load = drive.pin_loads(omega * time, omega).crank
        cage = outer / (outer + inner) * drive.swing(omega * time, omega).angle
        place = (cage - np.arctan2(load[:, 0], load[:, 1]))[:, None] + row.places
        law = behw_law(row.roller_length)
        loads = radial_distribution(np.hypot(*load.T), place, self.pin.clearance, law).loads
        history = crank_history(row, drive, time, omega, loads)
        ratio = outer / (inner + outer)
        return self._rollers(history, self.pin, stage, omega, "outer", ratio).named("pin")

    def _rollers(
        self,
        history: RollerHistory,
        bearing: RowOnRig,
        stage: Stage,
        omega: float,
        driving: Literal["inner", "outer"],
        ratio: float,
    ) -> FrictionTorque:
        held = parts.drag_constants(bearing.gaps, self.viscosity, ratio, variant="thesis")
        if stage == "coulomb":
            with_cage = parts.coulomb_drag_constants(
                bearing.gaps, self.viscosity, ratio, self.adhesion, self.sliding,
                driving=driving, variant="thesis",
            )  # fmt: skip
            motion = coulomb_motion(
                history, with_cage, adhesion=self.adhesion, sliding=self.sliding, driving=driving
            )
            return coulomb_torque(
                motion, held, omega, adhesion=self.adhesion, sliding=self.sliding,
                rolling=self.rolling, driving=driving,
            )  # fmt: skip
        regimes = self.film == "moes"
        options = FrictionOptions(
            oil=lubricant(self.oil), temperature=self.temperature, film=self.film,
            roughness=0.3e-6 if regimes else 1e-12, hysteresis=0.01 if regimes else 0.0,
        )  # fmt: skip
        motion = film_motion(history, options, drag=held, sliding=self.sliding)
        return film_torque(motion, options, omega, drag=held, sliding=self.sliding)

    def _cage(self, drive: CrankDrive, rpm: float) -> FrictionTorque:
        """Film between cage and rod, and sides of the cage, (4.30), (5.44), (5.45)."""
        row, omega = self.pin.row, rpm * math.pi / 30
        inner, outer = row.raceways
        share = outer / (inner + outer)
        time = np.linspace(0.0, 60 / rpm, 181)
        ring = drive.swing(omega * time, omega).speed
        force = parts.cage_inertia_force(self.cage_mass, row.rollers, row.mass, drive.radius, omega)
        rim = CageRim(
            width=self.cage_width, bore=outer, diameter=outer - 0.15e-3, viscosity=self.viscosity
        )
        orbit = cage_orbit(rim, time, (float(force), 0.0), share * ring, ring)
        # the sides slide on the rod, which overtakes the cage
        apart = (1 - share) * ring
        sides = parts.cage_side_torque(
            self.viscosity, (self.cage_gap, self.cage_gap), apart, 31.425e-3, 26.3e-3
        )
        found = {
            "cage film": float(np.mean(orbit.friction_power[:-1])),
            "cage sides": float(np.mean((sides * apart)[:-1])),
        }
        if self.thrust_share:
            load = np.hypot(*drive.pin_loads(omega * time, omega).crank.T)
            washer = parts.thrust_washer_torque(self.thrust_share * load, 0.07, 37e-3, outer / 2)
            found["thrust washers"] = float(np.mean((washer * ring)[:-1]))
        return FrictionTorque(found, omega)

    def _journal(self, drive: CrankDrive, bearing: JournalBearing, rpm: float) -> FrictionTorque:
        """A film between pin and rod, on the orbit that closes."""
        omega = rpm * math.pi / 30
        time = np.linspace(0.0, 60 / rpm, 181)
        phi = omega * time
        # in the rod the pin turns from its y to its x; the film turns its first axis to its second
        load = drive.pin_loads(phi, omega).rod[:, ::-1]
        film = Film(Lubricant(self.viscosity), Guembel(), grid=(96, 24))
        with warnings.catch_warnings():
            # of the thinnest film: twice the cells each way move the mean loss by less than 0.1 %
            warnings.simplefilter("ignore", ValidityWarning)
            path = bearing.orbit(
                time, load, drive.swing(phi, omega).speed, film, periodic=True
            )  # fmt: skip
        loss = float(path["friction_power"][:-1].mean())
        return FrictionTorque({"pin film": loss}, omega)

    def _seal(self, rpm: float) -> FrictionTorque:
        """Lip seal of the shaft, (8.1)."""
        omega = rpm * math.pi / 30
        if self.seal_force == 0.0:
            return FrictionTorque({}, omega)
        torque = parts.seal_torque(
            omega, 17.5e-3, self.seal_force, 0.3, viscosity=self.viscosity, width_ratio=122
        )
        return FrictionTorque({"seal": float(torque) * omega}, omega)
