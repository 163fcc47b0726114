"""How far what is built may lie from what a scene states: clearance, oil, surfaces, alignment."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, Field

from loadflow.scene.section import Section

Share = Annotated[float, Field(ge=0, le=0.5)]

GRADES = {5: 7.0, 6: 10.0, 7: 16.0, 8: 25.0, 9: 40.0}
"""Width of the standard tolerance grades of ISO 286-1, in units of its factor i or I."""

BORE, SHAFT, ROLLING = 7, 6, 6
"""Grades of the bore and the shaft of a journal bearing, and of the internal clearance of a rolling
bearing as mounted; assumed."""


def grade_width(diameter: float, grade: int) -> float:
    """Width of a standard tolerance grade of ISO 286-1, m.

    By its formulas at the diameter itself, where the tables take the geometric mean of a step of
    diameters; beyond 3.15 m, where the standard ends, by the same formula.

    Parameters
    ----------
    diameter : float
        m.
    grade : int
        One of `GRADES`.

    Examples
    --------
    >>> round(1e6 * grade_width(0.894, 7))  # table: 90 µm from 800 to 1000 mm
    91
    >>> round(1e6 * grade_width(0.0387, 7))  # table: 25 µm from 30 to 50 mm
    25
    """
    size = 1e3 * diameter
    factor = 0.45 * size ** (1 / 3) + 0.001 * size if size <= 500 else 0.004 * size + 2.1
    return 1e-6 * GRADES[grade] * factor


class AsBuilt(Section, BaseModel):
    """How far what is built may lie from what the scene states; 0 leaves one out.

    `loadflow compare` takes each to both of its ends, one at a time, and shows beside a number how
    far it moves (docs/compare.md). Where values of a candidate have tolerances of their own,
    these count in place of what is assumed here.

    Attributes
    ----------
    clearance : float, optional
        Largest change of the clearance over the diameter, m. Left out: half of the grades IT7 of
        the bore and IT6 of the shaft together [ISO 286-1] for journal bearings and cones, half of
        IT6 at the pitch diameter for the internal clearance of rolling bearings; the grades are
        assumed.
    viscosity : float
        Of the oil at one temperature, as a share: that of a grade of ISO 3448.
    temperature : float
        Of the oil, K; assumed.
    roughness : float
        Of all surfaces, as a share; assumed.
    alignment : float
        Angle between shaft and bearing beside that of the bent shaft, rad; assumed.

    Examples
    --------
    >>> from loadflow.scene.as_built import AsBuilt
    >>> round(1e6 * AsBuilt().of_journal(1.0)), AsBuilt(clearance=5e-5).of_journal(1.0)
    (79, 5e-05)
    """

    clearance: Annotated[float, Field(ge=0, le=0.01)] | None = None
    viscosity: Share = 0.1
    temperature: Annotated[float, Field(ge=0, le=40)] = 5.0
    roughness: Share = 0.25
    alignment: Annotated[float, Field(ge=0, le=0.01)] = 3e-5

    @property
    def any(self) -> bool:
        """Whether one of them is not 0."""
        return self.clearance != 0 or any(
            size > 0 for size in (self.viscosity, self.temperature, self.roughness, self.alignment)
        )

    def of_journal(self, diameter: float) -> float:
        """Largest change of the diametral clearance of a bore, m."""
        if self.clearance is not None:
            return self.clearance
        return 0.5 * (grade_width(diameter, BORE) + grade_width(diameter, SHAFT))

    def of_rolling(self, pitch_diameter: float) -> float:
        """Largest change of the internal clearance of a rolling bearing, m."""
        if self.clearance is not None:
            return self.clearance
        return 0.5 * grade_width(pitch_diameter, ROLLING)
