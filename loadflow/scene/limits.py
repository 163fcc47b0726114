"""Limits that the bearings of a scene must hold, each with where its default comes from."""

from __future__ import annotations

import math
from typing import Annotated, Literal, Self

from pydantic import BaseModel, Field, model_validator

from loadflow.scene.section import Section

Positive = Annotated[float, Field(gt=0)]
Oil = Literal[
    "mineral, oxygen-saturated",
    "mineral, without oxygen",
    "synthetic, oxygen-saturated",
    "synthetic, without oxygen",
]

OIL_TEMPERATURES: dict[str, tuple[float, float]] = {
    "mineral, oxygen-saturated": (348.15, 303.15),
    "mineral, without oxygen": (623.15, 568.15),
    "synthetic, oxygen-saturated": (573.15, 533.15),
    "synthetic, without oxygen": (768.15, 703.15),
}
"""Largest temperature (K) of oils for 100 h and for 10,000 h, the lower ends of the ranges of
[Jonuschies 2015] Table 3-2."""

OIL_HOURS = 100.0, 10_000.0

NORMAL_OPERATION = 1.0, 6.0
"""Least and largest So of the mean load in normal operation [Jonuschies 2015, ch. 3.4]."""


class FilmLimits(Section, BaseModel):
    """What the film of any bearing must hold.

    Attributes
    ----------
    waviness : float
        W_t of shaft and shell together, m; assumed.
    margin : float
        What the film must be thicker than roughness and waviness, m; assumed.
    minimum_film : float, optional
        Smallest film allowed, m, such as h_lim of ISO 7902-3. Left out: the sum of R_z of both
        surfaces, `waviness` and `margin` (3.1).
    material : tuple of (float, float)
        Points of temperature, K, and largest film pressure, Pa, of the shell's material; between
        them it falls in straight lines, above the last it carries nothing. White metal: 7 MPa up to
        127 °C, 1.4 MPa at 190 °C [Jonuschies 2015, ch. 3].
    contact_time : float
        Time in a case of power production, s, in which shaft and shell may touch while turning.
    start_time : float, optional
        The same of a start, a stop or a fault that stops; told without a limit if left out.
    """

    waviness: Annotated[float, Field(ge=0)] = 5e-6
    margin: Annotated[float, Field(ge=0)] = 5e-6
    minimum_film: Positive | None = None
    material: Annotated[tuple[tuple[Positive, Positive], ...], Field(min_length=1)] = (
        (400.15, 7e6),
        (463.15, 1.4e6),
    )
    contact_time: Annotated[float, Field(ge=0)] = 0.0
    start_time: Annotated[float, Field(ge=0)] | None = None

    @model_validator(mode="after")
    def _film_in_order(self) -> Self:
        temperatures = [point[0] for point in self.material]
        if temperatures != sorted(set(temperatures)):
            raise ValueError(f"material: the temperatures {temperatures} K must rise")
        if self.minimum_film is not None and {"waviness", "margin"} & self.changed:
            raise ValueError("minimum_film: takes the place of waviness and margin")
        return self

    def least_film(self, contact_film: float) -> float:
        """Smallest film allowed, m, of surfaces that touch at a film of `contact_film`, m.

        As stated, or R_z + W_t of both surfaces and a margin (3.1).
        """
        return self.minimum_film or contact_film + self.waviness + self.margin

    def pressure_at(self, temperature: float) -> float:
        """Largest film pressure, Pa, that the material carries at a temperature, K.

        NaN is a temperature that no one knows: then it counts as cold.
        """
        (low, first), *_ = self.material
        if math.isnan(temperature) or temperature <= low:
            return first
        for (t0, p0), (t1, p1) in zip(self.material, self.material[1:]):
            if temperature <= t1:
                return p0 + (p1 - p0) * (temperature - t0) / (t1 - t0)
        return 0.0


class JournalLimits(FilmLimits):
    """What a journal bearing must hold, beside `FilmLimits`.

    Attributes
    ----------
    eccentricity_ratio : float
        Largest ε; above E_krit = 0.95 begins mixed friction [Jonuschies 2015, (5.2)]. Arcs, lobes
        and pads have the film (1 − E_krit) c in its place, see `loadflow.journal.critical`.
    sommerfeld_range : tuple of float, optional
        So of the mean load. Left out: 1 … 6 in normal operation [Jonuschies 2015, ch. 3.4], on
        tilting pads without the lower end, see `Journal.sommerfeld_range`.
    sommerfeld_peak : float
        Largest So, reached briefly: 10 [Jonuschies 2015, ch. 3.4].
    specific_load : float, optional
        Largest F/(B D), Pa, such as p_lim of ISO 7902-3; not judged if left out.
    oil, oil_hours
        Kind of oil, and hours that it shall last, 100 … 10,000 [Jonuschies 2015, Table 3-2].
    temperature : float, optional
        Largest temperature of the film, K, such as T_lim of ISO 7902-3, in place of the oil's.
    """

    eccentricity_ratio: Annotated[float, Field(gt=0, lt=1)] = 0.95
    sommerfeld_range: tuple[Annotated[float, Field(ge=0)], Positive] | None = None
    sommerfeld_peak: Positive = 10.0
    specific_load: Positive | None = None
    oil: Oil = "mineral, oxygen-saturated"
    oil_hours: Annotated[float, Field(ge=100, le=10_000)] = 100.0
    temperature: Annotated[float, Field(gt=200)] | None = None

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        low, high = self.sommerfeld_range or NORMAL_OPERATION
        if not low < high <= self.sommerfeld_peak:
            raise ValueError(
                f"sommerfeld_range = {low:g} … {high:g} must rise and end at or below "
                f"sommerfeld_peak = {self.sommerfeld_peak:g}"
            )
        if self.temperature is not None and {"oil", "oil_hours"} & self.changed:
            raise ValueError("temperature: takes the place of oil and oil_hours; leave them out")
        return self

    @property
    def oil_temperature(self) -> float:
        """Largest temperature of the oil, K, between both columns of the table in ln(hours)."""
        if self.temperature is not None:
            return self.temperature
        short, long = OIL_TEMPERATURES[self.oil]
        share = math.log(self.oil_hours / OIL_HOURS[0]) / math.log(OIL_HOURS[1] / OIL_HOURS[0])
        return short + share * (long - short)


class RollingLimits(Section, BaseModel):
    """What a rolling bearing must hold.

    Attributes
    ----------
    static_safety : float
        Smallest static rating over the design load, which has the partial safety factor in it: 1
        [IEC 61400-1 as quoted by Jonuschies 2015, (1.11)].
    life : float
        Smallest rating life, h: 20 years [IEC 61400-1 as quoted by Jonuschies 2015, (1.10)].
    """

    static_safety: Positive = 1.0
    life: Positive = 175_320.0
