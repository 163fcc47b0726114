"""The sections ``[seeds]`` and ``[reduction]`` of a scene: what is done with load series."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, Field, model_validator

from loadflow.scene.section import Section

Positive = Annotated[float, Field(gt=0)]


class Seeds(Section, BaseModel):
    """Tests of seed equality: level of significance, method, half width of the spectral band."""

    alpha: Annotated[float, Field(gt=0, lt=1)] = 0.05
    methods: list[Literal["as-printed", "calibrated"]] = ["as-printed", "calibrated"]
    band: Annotated[float, Field(gt=0, lt=1)] = 0.025


class Reduction(Section, BaseModel):
    """Reduction of each series to design loads.

    ``method = "histogram"`` (quasi-static) keeps a share ``size`` of the samples. One of each class
    of speed and load is kept at least; ``classes`` is their number along each, that of
    [Jonuschies 2015] (4.30) if left out. ``grid = "cube"`` takes the same classes for all load
    cases of a bearing, that of (4.30) for all of them together, so that they make one histogram of
    the whole cube; the loads are given as files then. ``between`` takes only the samples of these
    times of each series, s, the second time not included.

    ``"stationary"`` takes the mean load at the mean speed, the largest at the lowest, and the
    instants at which something is extreme. ``"periodic"`` takes the mean, the largest harmonic
    below the lower of two ``bounds`` (Hz) and ``additional`` ones between them, or those nearest to
    ``orders`` of the rotor's speed; films are driven round the orbit that closes. Without bounds
    the film of a journal bearing says them, else they are half the speed and half the sampling
    rate. Both are chosen by hand: no accuracy can be asked of what they find, so that ``accuracy``
    is "given".
    """

    method: Literal["histogram", "stationary", "periodic"] = "histogram"
    bounds: tuple[Positive, Positive] | None = None
    additional: Annotated[int, Field(ge=0, le=20)] = 2
    orders: Annotated[list[Positive], Field(min_length=1)] | None = None
    size: Annotated[float, Field(gt=0, le=1)] = 0.1
    classes: Annotated[int, Field(ge=2, le=200)] | None = None
    pick: Literal["random", "extremes", "envelope"] = "extremes"
    seed: Annotated[int, Field(ge=0)] = 0
    between: tuple[Annotated[float, Field(ge=0)], Positive] | None = None
    grid: Literal["each", "cube"] = "each"

    @model_validator(mode="after")
    def _pairs_rise(self) -> Self:
        if self.bounds is not None and self.bounds[0] > self.bounds[1]:
            raise ValueError(f"bounds = {list(self.bounds)}: the second must be the larger one")
        if self.between is not None and self.between[0] >= self.between[1]:
            raise ValueError(f"between = {list(self.between)}: the second must be the larger one")
        return self

    def check(self, simulated: bool, duration: float | None) -> None:
        """Refuse what the series do not have: `duration`, s, is that of simulated ones.

        Raises
        ------
        ValueError
            Classes of a cube that is not known beforehand, or times after the end.
        """
        if simulated and self.grid == "cube":
            raise ValueError(
                'reduction.grid = "cube": its classes are known when all load cases are; give a '
                "load cube (`loadflow loads` makes one) as loads.files, or leave reduction.grid out"
            )
        if simulated and self.between and duration and self.between[0] >= duration:
            raise ValueError(
                f"reduction.between = {list(self.between)}: a series has {duration:g} s; set "
                "reduction.between or loads.duration"
            )
