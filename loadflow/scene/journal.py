"""The journal bearings of a scene: what each is, and how its film is modelled."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal, Self

import numpy as np
from pydantic import BaseModel, Field, ValidationError, model_validator

from loadflow.errors import InputError
from loadflow.former_names import renamed_attribute
from loadflow.journal import (
    Contact,
    Film,
    GasMixture,
    JournalBearing,
    Lubricant,
    Supply,
    Turbulence,
)
from loadflow.journal.critical import Critical
from loadflow.journal.heat import FilmHeat, Heat
from loadflow.journal.line import Line
from loadflow.journal.models.model import Verb, why_not
from loadflow.journal.shells import Shell
from loadflow.journal.thermal import grown_by
from loadflow.scene.films import HeatTable, Law, RungName
from loadflow.scene.limits import NORMAL_OPERATION, JournalLimits
from loadflow.scene.messages import message
from loadflow.scene.places import SHARED
from loadflow.scene.seats import SeatTable, check_seat
from loadflow.scene.section import Section

Positive = Annotated[float, Field(gt=0)]
Slope = Annotated[float, Field(ge=-0.1, le=0.1)]

USUAL_HEAT_CAPACITY = 2000.0
"""c_p of mineral oil, J/(kg K), the default of `Heat`."""


class Journal(Section, BaseModel):
    """Journal bearings: which ones of the shaft, and one set of data for all of them.

    Bearings with data of their own are in ``own``, by place; `at` gives the data of each. Motion,
    tilt, rung and grid are those of all.

    ``motion = "quasi-static"`` solves the equilibrium of every sample of the reduced series;
    ``"transient"`` follows the shaft through the whole series, step by step.
    ``rung = "map"`` tabulates the film once, for long series (docs/journal-map.md).

    With a table ``heat`` the friction of the film warms its oil, which takes the place of
    ``lubricant``: each equilibrium for itself, a film in motion to one temperature for the whole
    series, as its loads change faster than a bearing warms. With ``kind = "film"`` an energy
    equation gives every cell of the film at rest its own temperature.

    ``step`` is the largest step of a film in motion, s: it passes over the samples between;
    default every sample.
    With ``tilt`` the shaft is tilted and bent in them as the beam of its suspension is; if it
    has none, it tilts freely under the moment that the shaft stage gives. The film is then solved
    over its full width.

    ``alignment`` is how far the bore is turned against the shaft that does not bend, rad: about
    down and about left; only a film with ``tilt`` around a beam knows it. ``"mean"`` is a bore that
    was aligned with the shaft as it lies at its usual load: in steady operation over the lifetime,
    or in the mean of given series. A ``self_aligning`` bearing has a shell on a support that turns
    with the shaft, such as a spherical seat or a ring of elastic or tilting pieces: however the
    shaft tilts, it lies straight in it, and ``tilt`` and ``alignment`` say nothing of it. ``seat``
    is what the support resists with, friction or stiffness. Shells on seats are followed with shaft
    and films where supports of the beam take their moment; else plans count what that leaves.

    ``cavitation`` is the law of the ruptured film; its key ``kind`` says which:
    gas-mixture, sommerfeld, guembel, reynolds or mass-conserving. ``inlet`` replaces the oil on a
    line at the widest gap, or does not; "auto" leaves it to the law.

    A ``shell`` makes the bore elastic; its key ``kind`` says how: local, lined, thick, matrix with
    a ``matrix`` of influence coefficients of the cells, or the name of a file that holds it,
    housed in a housing on feet or a flange, or influence with the ``file`` of a finite-element
    program.

    With a table ``turbulence``, which may be empty, the flow is turbulent where its Reynolds number
    is beyond the critical one; without, it is laminar, and a run warns where it would not be.

    ``shaft_roughness`` and ``shell_roughness`` are R_z, m, about 6.3 R_a of the 0.2 and 0.4 µm that
    Autodesk Inventor's plain bearing calculator recommends. Where the film would be thinner than
    both together the surfaces touch: such samples are counted as ``in_contact``. With ``contact``,
    the asperities of `loadflow.journal.Contact`, they are solved as the others, standstill
    included. Without, they have no film, and the shaft rubs there with ``boundary_friction``:
    bronze [Jonuschies 2015, Table 3-1]. ``limits`` are what the verdicts hold the bearing against.

    Examples
    --------
    >>> from loadflow.scene import Journal
    >>> journal = Journal(bearings=["N"], shaft_roughness=2e-6)
    >>> round(journal.contact_film * 1e6, 1), journal.film_model.grid
    (4.5, (60, 20))
    """

    bearings: Annotated[list[str], Field(min_length=1)] = ["N", "N2"]
    own: dict[str, Journal] = {}
    geometry: JournalBearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    lubricant: Lubricant = Lubricant(viscosity=0.050)
    cavitation: Law = GasMixture(0.05e6)
    edge_pressure: Annotated[float, Field(ge=0)] = 0.5e6
    supply: Supply | None = None
    inlet: Literal["auto", "widest gap", "none"] = "auto"
    grid: tuple[Annotated[int, Field(ge=12, le=720)], Annotated[int, Field(ge=4, le=240)]] = (
        60,
        20,
    )
    grading: Literal["auto", "uniform", "graded"] = "auto"
    rung: RungName = "grid"
    heat: HeatTable | None = None
    motion: Literal["quasi-static", "transient"] = "quasi-static"
    step: Positive | None = None
    tilt: bool = False
    alignment: Literal["mean"] | tuple[Slope, Slope] = (0.0, 0.0)
    self_aligning: bool = False
    seat: SeatTable | None = None
    shell: Shell | None = None
    contact: Contact | None = None
    turbulence: Turbulence | None = None
    shaft_roughness: Positive = 1.3e-6
    shell_roughness: Positive = 2.5e-6
    boundary_friction: Annotated[float, Field(gt=0, le=1)] = 0.15
    limits: JournalLimits = JournalLimits()

    @model_validator(mode="after")
    def _one_model_for_all(self) -> Self:
        for place, other in self.own.items():
            for name in other.model_fields_set.intersection(SHARED):
                if getattr(other, name) != getattr(self, name):
                    raise ValueError(
                        f"{name}: all journal bearings of a scene have one, but {place} has "
                        f"{getattr(other, name)!r} beside {getattr(self, name)!r}"
                    )
        return self

    def at(self, place: str) -> Journal:
        """The data of one of the bearings; one that is `self_aligning` knows no tilt."""
        own, shared = self, {}
        if place in self.own:
            own, shared = self.own[place], {name: getattr(self, name) for name in SHARED}
        if own.self_aligning:
            shared |= {"tilt": False}
        return own.model_copy(update=shared) if shared else own

    @property
    def tilting(self) -> list[str]:
        """Bearings in which the shaft may tilt: all but those that are `self_aligning`."""
        return [name for name in self.bearings if not self.at(name).self_aligning]

    @property
    def on_seats(self) -> list[str]:
        """Bearings that are `self_aligning`, of which is stated what they stand on."""
        return [name for name in self.bearings if self.at(name).seat is not None]

    def check_moment(self, place: str, what: str) -> None:
        """Refuse a support that is to take the moment of a film which has none.

        Raises
        ------
        ValueError
            Naming it by `what`, and what helps.
        """
        if not self.tilt and place not in self.on_seats:
            raise ValueError(
                f"{what}: only a tilted film takes a moment; set journal.tilt = true, or leave out "
                "takes_moment"
            )
        if place in self.on_seats and not (self.in_motion and self.rung == "reduced"):
            raise ValueError(
                f"{what}: what a seat holds is followed in motion alone; set journal.motion = "
                '"transient" and rung = "reduced"'
            )

    @model_validator(mode="after")
    def _seat_of_what_aligns_itself(self) -> Self:
        check_seat(self, 0.5 * self.geometry.diameter)
        return self

    @model_validator(mode="after")
    def _smoother_than_the_gap(self) -> Self:
        if self.contact_film >= self.geometry.clearance:
            raise ValueError(
                f"shaft_roughness and shell_roughness: together {self.contact_film:g} m, must be "
                f"< the radial clearance {self.geometry.clearance:g} m"
            )
        return self

    def idle(self) -> Iterator[tuple[str, str]]:
        """Keys without effect beside the others, and why."""
        grooved = self.supply is not None and self.supply.grooves
        if isinstance(self.heat, FilmHeat) and not grooved and not self.geometry.shape.segments:
            yield "heat.carry_over", "the bore has no groove that hot oil runs into"

    @property
    def contact_film(self) -> float:
        """Film, m, below which the surfaces touch: the sum of their R_z."""
        return self.shaft_roughness + self.shell_roughness

    @property
    def critical(self) -> Critical:
        """Where friction becomes mixed: an ε, or a film where the gap closes at no certain one."""
        return Critical.of(self.geometry, self.limits.eccentricity_ratio)

    critical_eccentricity_ratio = renamed_attribute("critical_eccentricity_ratio", "critical.ratio")

    @property
    def least_film(self) -> float:
        """Smallest film allowed, m: as stated, or R_z + W_t of both surfaces and a margin (3.1).

        In lobes and on pads that at which friction becomes mixed, if it is thicker.
        """
        return max(self.limits.least_film(self.contact_film), self.critical.film)

    @property
    def sommerfeld_range(self) -> tuple[float, float]:
        """Least and largest So of the mean load: as stated, or 1 … 6, on tilting pads 0 … 6.

        The least keeps a bearing from running fast for its load [Jonuschies 2015, ch. 3.4], where a
        plain bore, or one of lobes, drives the shaft into a whirl. Pads do not [Lund 1987].
        """
        if self.limits.sommerfeld_range is not None:
            return self.limits.sommerfeld_range
        low, high = NORMAL_OPERATION
        return 0.0 if any(part.tilting for part in self.geometry.shape.segments) else low, high

    @property
    def in_motion(self) -> bool:
        """Whether the film follows the whole series; it does not read the reduced one then."""
        return self.motion == "transient"

    def every(self, step: float) -> int:
        """How-manyth sample a film in motion takes of a series sampled at `step`, s."""
        return 1 if self.step is None else max(1, int(self.step / step + 1e-6))

    @property
    def film_model(self) -> Film:
        """The film that these keys describe."""
        heat = self.heat
        return Film(heat=heat, **self.film | ({} if heat is None else {"lubricant": None}))

    @property
    def film(self) -> dict[str, Any]:
        """The film at the temperature of its lubricant, as keywords of the verbs."""
        mesh = ("grid", "grading", "rung")
        effects = ("supply", "shell", "contact", "turbulence")
        names = ("lubricant", "cavitation", "edge_pressure", *mesh, *effects)
        inlet = None if self.inlet == "none" else self.inlet
        return {name: getattr(self, name) for name in names} | {"inlet": inlet}

    @property
    def volume_heat(self) -> float:
        """ρ c_p of the oil, J/(m³ K); c_p of an oil without a heat balance is the usual one."""
        if self.heat is not None:
            return self.heat.volume_heat
        return self.lubricant.density * USUAL_HEAT_CAPACITY

    def at_temperature(self, temperature: float) -> Journal:
        """The bearing with its oil held at `temperature`, K."""
        if self.heat is None:
            return self
        held: dict[str, Any] = {"lubricant": self.heat.lubricant(temperature), "heat": None}
        if isinstance(self.heat, Heat):  # as shaft and shell have grown
            held["geometry"] = grown_by(self.geometry, self.heat, temperature)
        return self.model_copy(update=held)

    @model_validator(mode="after")
    def _one_oil(self) -> Self:
        if self.heat is not None and "lubricant" in self.changed:
            raise ValueError("lubricant: follows from heat.oil and its temperature; leave it out")
        return self

    @model_validator(mode="after")
    def _a_model_that_knows_the_film(self) -> Self:
        verb: Verb = "in_motion" if self.in_motion else "at_rest"
        journals: list[Journal] = [self, *(self.at(place) for place in self.own)]
        for journal in journals:
            tilts = self.tilt and not journal.self_aligning
            line = Line(moment=np.zeros((1, 2))) if tilts else Line()
            why = why_not(verb, journal.film_model, journal.geometry, line)
            if why is not None:
                raise ValueError(why)
        return self


def make_journal(data: dict[str, Any], source: str = "journal") -> Journal:
    """Build the section of the journal bearings alone; `source` names it in messages.

    Raises
    ------
    InputError
        As `read_scene`.
    """
    try:
        return Journal.model_validate(data)
    except ValidationError as error:
        raise InputError(message(error, source, {(): ("journal",)}, Journal)) from error
