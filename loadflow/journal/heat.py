"""What a user states about the heat of a film: its oil, and how it is cooled. No solver."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np
from annotated_types import Ge, Gt, Le, Lt
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.lubricant import Lubricant
from loadflow.numerics.fields import check_fields, require
from loadflow.tribology import ExponentialOil, Oil, lubricant

Array = NDArray[np.float64]

HOTTEST = 423.15
"""Largest temperature of the film that is looked for, K; oils and white metal end before."""


_OF_CONTACTS = ("base", "critical_stress", "critical_pressure", "limiting_slope")
"""Fields of an oil that films under the pressure of rolling contacts know."""


@dataclass(frozen=True)
class Entering:
    """The oil that enters a film."""

    oil: str | Oil | ExponentialOil = "mineral-vg-320"
    inlet_temperature: Annotated[float, Gt(200)] = 313.15

    over_area: ClassVar[bool]
    of_pads: ClassVar[bool] = False

    def __post_init__(self) -> None:
        check_fields(self)
        for name in self._temperatures():
            value = getattr(self, name)
            require(value is None or value < HOTTEST, name, value, f"must be < {HOTTEST} K")
        self.liquid  # noqa: B018  a name that is not known is told here

    def _temperatures(self) -> tuple[str, ...]:
        """Names of the fields that are temperatures."""
        return ("inlet_temperature",)

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        named = isinstance(self.oil, str)
        for name in () if named else ("pressure_coefficient", "pressure_law", *_OF_CONTACTS):
            if hasattr(self.oil, name):
                yield f"oil.{name}", "films of journal bearings have the viscosity without pressure"

    @property
    def liquid(self) -> Oil | ExponentialOil:
        """The oil."""
        return lubricant(self.oil) if isinstance(self.oil, str) else self.oil

    def lubricant(self, temperature: float) -> Lubricant:
        """The oil of a film at `temperature`, K."""
        oil = self.liquid
        return Lubricant(float(oil.viscosity(temperature)), float(oil.density(temperature)))


@dataclass(frozen=True)
class Growth:
    """Expansion of shaft and shell, by which a warm bearing has another clearance than a cold one.

    c(T) = c + R [α_shell (T_shell − T_ref) − α_shaft (T_shaft − T_ref)]; with both as warm as the
    film that of ISO 7902-1, Δψ = (α_shell − α_shaft)(T − T_ref). The bearing's own clearance is the
    one at `reference_temperature`.

    Attributes
    ----------
    shaft_expansion, shell_expansion : float
        α of steel by default, 1/K.
    shaft_share, shell_share : float
        Rise of either above ambient over that of the film; a shell in a cool housing has less
        than 1.
    shaft_temperature, shell_temperature : float, optional
        K, in place of the shares.
    reference_temperature : float
        K.

    Examples
    --------
    >>> from loadflow.journal import Growth
    >>> cool_shell = Growth(shell_share=0.5)
    >>> round(float(cool_shell.radial(333.15, 293.15, radius=1.5)) * 1e6)  # µm, of 1.5 m
    -351
    """

    shaft_expansion: Annotated[float, Ge(0), Le(1e-4)] = 11.7e-6
    shell_expansion: Annotated[float, Ge(0), Le(1e-4)] = 11.7e-6
    shaft_share: Annotated[float, Ge(0), Le(2)] = 1.0
    shell_share: Annotated[float, Ge(0), Le(2)] = 1.0
    shaft_temperature: Annotated[float, Gt(200)] | None = None
    shell_temperature: Annotated[float, Gt(200)] | None = None
    reference_temperature: Annotated[float, Gt(200)] = 293.15

    def __post_init__(self) -> None:
        check_fields(self)

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        for part in ("shaft", "shell"):
            if getattr(self, f"{part}_temperature") is not None:
                yield f"{part}_share", f"{part}_temperature is given"

    @property
    def knows_ambient(self) -> bool:
        """Whether shaft or shell is cooler or warmer than the film by the surroundings."""
        parts = ("shaft", "shell")
        free = [part for part in parts if getattr(self, f"{part}_temperature") is None]
        return any(getattr(self, f"{part}_share") != 1 for part in free)

    def radial(self, temperature: ArrayLike, ambient: float, radius: float) -> Array:
        """Growth of the radial clearance, m, of a film at `temperature`, K, on a shaft, m."""
        rise = np.asarray(temperature) - ambient

        def warmth(given: float | None, share: float) -> Array:
            return np.asarray(ambient + share * rise if given is None else given)

        shaft = warmth(self.shaft_temperature, self.shaft_share) - self.reference_temperature
        shell = warmth(self.shell_temperature, self.shell_share) - self.reference_temperature
        return np.asarray(radius * (self.shell_expansion * shell - self.shaft_expansion * shaft))


@dataclass(frozen=True)
class Heat(Entering):
    """Oil and cooling of a bearing: one temperature of the whole film by its heat balance.

    Attributes
    ----------
    oil : str, Oil or ExponentialOil
        Name of an oil of `loadflow.tribology.lubricant_names`, or an oil.
    inlet_temperature : float
        Of the oil that enters the film, K.
    heat_capacity : float
        c_p of the oil, J/(kg K).
    transfer : float
        K, heat that passes from the film through the housing for each kelvin above ambient, W/K;
        0: all leaves with the oil.
    ambient_temperature : float
        K.
    capacity : float, optional
        Heat that oil, shell and shaft store for each kelvin, J/K: a film in motion then warms and
        cools with time. Left out, it is too slow to follow, and has one temperature all the time.
    start_temperature : float, optional
        Of a film in motion at its first time, K; left out, that of the mean friction and flow of
        its series.
    sump_transfer : float, optional
        Heat that the sump gives off for each kelvin above ambient, W/K: the oil goes round, enters
        as warm as the sump is, and `inlet_temperature` only says where the search begins. Left out,
        it enters at `inlet_temperature`, whatever cools it.
    growth : Growth, optional
        Expansion of shaft and shell; left out, the clearance is the same at all temperatures. With
        `capacity` it follows the temperature that is stored.

    Examples
    --------
    >>> from loadflow.journal import Heat
    >>> heat = Heat(oil="iso-vg-220", inlet_temperature=313.15)
    >>> bool(heat.lubricant(333.15).viscosity < heat.lubricant(313.15).viscosity)
    True
    """

    heat_capacity: Annotated[float, Gt(0)] = 2000.0
    transfer: Annotated[float, Ge(0)] = 0.0
    ambient_temperature: Annotated[float, Gt(200)] = 293.15
    capacity: Annotated[float, Gt(0)] | None = None
    start_temperature: Annotated[float, Gt(200)] | None = None
    sump_transfer: Annotated[float, Gt(0)] | None = None
    growth: Growth | None = None
    kind: Literal["balance"] = "balance"

    over_area: ClassVar[bool] = False

    def __post_init__(self) -> None:
        super().__post_init__()
        apart = self.capacity is None or self.sump_transfer is None
        allowed = "None with capacity: what is stored is without the sump"
        require(apart, "sump_transfer", self.sump_transfer, allowed)

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        yield from super().idle()
        cool = self.growth is not None and self.growth.knows_ambient
        if self.transfer == 0 and self.sump_transfer is None and not cool:
            yield (
                "ambient_temperature",
                "no heat passes to it, and shaft and shell are told without",
            )
        if isinstance(self.oil, ExponentialOil):
            yield "oil.constant_specific_heat", "heat_capacity is that of the oil"
            yield "oil.constant_conductivity", "the balance of a whole film conducts nothing"

    def _temperatures(self) -> tuple[str, ...]:
        """Names of the fields that are temperatures."""
        return ("inlet_temperature", "ambient_temperature", "start_temperature")

    @property
    def stands_as_it_enters(self) -> bool:
        """Whether oil that gains no heat is as warm as it enters, at once."""
        return self.transfer == 0 and self.sump_transfer is None and self.capacity is None

    @property
    def gives_off(self) -> bool:
        """Whether the temperature of the surroundings acts on the film."""
        return self.transfer > 0 or self.sump_transfer is not None or self.growth is not None

    @property
    def volume_heat(self) -> float:
        """ρ c_p of the oil as it enters, J/(m³ K)."""
        return float(self.liquid.density(self.inlet_temperature)) * self.heat_capacity

    @property
    def coldest(self) -> float:
        """Lowest temperature that the film may have, K."""
        taken = [self.ambient_temperature] if self.transfer or self.sump_transfer else []
        if self.start_temperature is not None:
            taken.append(self.start_temperature)
        return min([self.inlet_temperature, *taken])

    def temperature(self, friction_power: ArrayLike, side_flow: ArrayLike, at: ArrayLike) -> Array:
        """Effective temperature (K) that friction (W) and flow (m³/s) of a film at `at` ask for."""
        carried = 2.0 * self.liquid.density(at) * self.heat_capacity * np.asarray(side_flow)
        # a film that stands still neither warms its oil nor moves it
        standing = (carried == 0.0) & (self.transfer == 0.0) & (np.asarray(friction_power) == 0.0)
        carried = np.where(standing, 1.0, carried)
        carried, inlet = self._leaving(carried)
        lost = carried + self.transfer
        gained = carried * inlet + self.transfer * self.ambient_temperature
        with np.errstate(divide="ignore"):  # no flow, no transfer: it never stops to warm
            return np.asarray((np.asarray(friction_power) + gained) / lost)

    def entering(self, side_flow: ArrayLike, at: ArrayLike) -> Array:
        """Temperature (K) of the oil that enters a film at `at` with a flow, m³/s."""
        warm = np.asarray(at)
        if self.sump_transfer is None:
            return np.full(warm.shape, self.inlet_temperature)
        carried = 2.0 * self.liquid.density(warm) * self.heat_capacity * np.asarray(side_flow)
        sump, ambient = self.sump_transfer, self.ambient_temperature
        return np.asarray((carried * warm + sump * ambient) / (carried + sump))

    def _leaving(self, carried: Array) -> tuple[Array, float]:
        """W/K that the oil takes along, and the temperature, K, above which it does."""
        if self.sump_transfer is None:
            return carried, self.inlet_temperature
        # oil and sump carry one after the other
        return carried * self.sump_transfer / (carried + self.sump_transfer), (
            self.ambient_temperature
        )


@dataclass(frozen=True)
class RingGrowth:
    """Expansion of shaft and shell by which the gap grows from place to place.

    The shaft, which turns, grows by its one temperature, R α_shaft (T_shaft − T_ref). The shell is
    a ring whose bore has the temperatures of the film's surface there; in its wall they obey
    Laplace's equation, with the transfer of `FilmHeat.shell_transfer` at its outside. It is as wide
    as the bearing, and its side faces are free and pass on no heat: its bore moves by finite
    elements in (r, z), order by order around, so that the ends follow what is warm beside them.
    Outside free, the mean order widens it by the mean temperature of the wall, orders from 2 on
    bend it, hot places inward [Boley and Weiner 1960]; the first only moves the bore, from whose
    centre the place of the shaft is told. The bearing's own clearance is the one at
    `reference_temperature`.

    Attributes
    ----------
    outer_diameter : float
        Of the ring, m, above that of the bore.
    held : bool
        Whether the outside of the ring is held in place all round, by a stiff housing that does not
        warm, along which it may slide: the bore can then only grow inward. The first order counts,
        from the housing's middle.
    shaft_expansion, shell_expansion : float
        α, of steel by default, 1/K.
    conductivity : float
        Of the shell, W/(m K).
    poisson_ratio : float
        ν of the shell, below 0.5.
    reference_temperature : float
        K.

    Examples
    --------
    >>> from loadflow.journal import FilmHeat, RingGrowth
    >>> heat = FilmHeat("iso-vg-68", growth=RingGrowth(outer_diameter=0.4))
    >>> heat.growth.held
    False
    """

    outer_diameter: Annotated[float, Gt(0)]
    held: bool = False
    shaft_expansion: Annotated[float, Ge(0), Le(1e-4)] = 11.7e-6
    shell_expansion: Annotated[float, Ge(0), Le(1e-4)] = 11.7e-6
    conductivity: Annotated[float, Gt(0)] = 50.0
    poisson_ratio: Annotated[float, Ge(0), Lt(0.5)] = 0.3
    reference_temperature: Annotated[float, Gt(200)] = 293.15

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class FilmHeat(Entering):
    """Oil and cooling of a film whose temperature changes over its area, and across the gap.

    An energy equation of the film, ρ c_p ∇·(q T) = dissipation − conduction, by upwind finite
    volumes on the cells of the film. The viscosity of each cell is that of the oil at its
    temperature. Density and specific heat are those of the oil as it enters, as the balance of the
    film is one of volume.

    Attributes
    ----------
    oil : str, Oil or ExponentialOil
        Name of an oil of `loadflow.tribology.lubricant_names`, or an oil.
    inlet_temperature : float
        T_sup of the oil that the grooves are fed with, and that the film draws in at its ends, K.
    carry_over : float
        λ, share of the hot oil that flows into a groove and leaves it again with the next film; the
        fresh oil makes up the rest: T_in = [λ q_out T_out + (q_in − λ q_out) T_sup]/q_in. Measured
        0.4 … 0.8 [Mitsui, Hori and Tanaka 1983].
    shell_transfer, shaft_transfer : float
        Heat that passes from the film into shell and shaft for each kelvin, W/(m² K); 0: none.
    shell_temperature : float
        K; only matters with `shell_transfer`.
    shaft_temperature : float, optional
        K; left out, the one at which as much heat enters the shaft as leaves it: the mean
        temperature of the film.
    points : {1, 3, 4}
        1: constant across the gap. 3: on a parabola through both surfaces, with the viscosity at
        these and midway; the film then conducts to the surfaces by its own conductivity, and
        `shell_transfer` and `shaft_transfer` are from there on. 4: on a cubic, whose first moment
        the flow carries on, too: heat of the surfaces takes its way to the middle of the film.
    growth : RingGrowth, optional
        Expansion of shaft and shell; left out, the gap is the same at all temperatures.
    stiffness : {"frozen", "settled"}
        Temperatures at which the load is differentiated by the place of the shaft. "frozen": those
        that the film has, for motion faster than it warms, such as vibration. "settled": those in
        balance at every place, for slow drift; by differences of films with their heat, four of
        them more for an aligned shaft. So it is at rest and at given positions (`pressure`); all of
        it is NaN without ``strict`` where one of these films has no temperatures. Damping is always
        that at frozen temperatures.

    Raises
    ------
    loadflow.errors.InputError
        A value out of its range, or an oil that is not known.

    Examples
    --------
    >>> from loadflow.journal import Film, FilmHeat, JournalBearing, Lobes, MassConserving
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3, shape=Lobes(2))
    >>> heat = FilmHeat("iso-vg-68", inlet_temperature=313.15)
    >>> film = Film(None, MassConserving(), edge_pressure=1e4, grid=(40, 8), heat=heat)
    >>> state = bearing.equilibrium((8e3, 0.0), 100.0, film)
    >>> bool(state.maximum_temperature > state.temperature > 313.15)
    True
    """

    carry_over: Annotated[float, Ge(0), Le(1)] = 0.8
    shell_transfer: Annotated[float, Ge(0)] = 0.0
    shaft_transfer: Annotated[float, Ge(0)] = 0.0
    shell_temperature: Annotated[float, Gt(200)] = 293.15
    shaft_temperature: Annotated[float, Gt(200)] | None = None
    points: Literal[1, 3, 4] = 1
    growth: RingGrowth | None = None
    stiffness: Literal["frozen", "settled"] = "frozen"
    kind: Literal["film"] = "film"

    over_area: ClassVar[bool] = True

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        yield from super().idle()
        if self.shell_transfer == 0:
            yield "shell_temperature", "shell_transfer is 0"
        if self.shell_transfer == 0 and self.growth is not None:
            yield "growth.conductivity", "shell_transfer is 0: the wall is as warm as the bore"
        if isinstance(self.oil, ExponentialOil) and self.points == 1:
            yield "oil.constant_conductivity", "points = 1: nothing is conducted across the film"

    def _temperatures(self) -> tuple[str, ...]:
        """Names of the fields that are temperatures."""
        return ("inlet_temperature", "shell_temperature", "shaft_temperature")

    @property
    def coldest(self) -> float:
        """Lowest temperature that the film may have, K."""
        given = [self.inlet_temperature]
        if self.shell_transfer:
            given.append(self.shell_temperature)
        if self.shaft_transfer and self.shaft_temperature is not None:
            given.append(self.shaft_temperature)
        return min(given)

    @property
    def gives_off(self) -> bool:
        """Whether the temperature of the surroundings acts on the film."""
        return self.shell_transfer > 0

    @property
    def volume_heat(self) -> float:
        """ρ c_p of the oil as it enters, J/(m³ K)."""
        oil, entering = self.liquid, self.inlet_temperature
        return float(oil.density(entering) * oil.specific_heat(entering))
