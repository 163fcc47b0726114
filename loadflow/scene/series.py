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
    [Jonuschies 2015] (4.30) if left out.

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

    @model_validator(mode="after")
    def _bounds_rise(self) -> Self:
        if self.bounds is not None and self.bounds[0] > self.bounds[1]:
            raise ValueError(f"bounds = {list(self.bounds)}: the second must be the larger one")
        return self
