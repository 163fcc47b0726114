"""What a scene says about the wind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, get_args

from annotated_types import Ge, Gt, Lt

from loadflow.errors import InputError

ClassName = Literal["I", "II", "III", "S", "T", "I-T", "II-T", "III-T"]
CategoryName = Literal["A+", "A", "B", "C", "S"]
Spectrum = Literal["kaimal", "mann"]
Scaling = Literal["none", "hub", "each"]
Lateral = Literal["coherent", "independent"]
_CHOICES = {
    "wind_class": ClassName,
    "category": CategoryName,
    "spectrum": Spectrum,
    "scaling": Scaling,
    "lateral": Lateral,
}


@dataclass(frozen=True)
class WindOptions:
    """Wind class, turbulence and grid.

    Attributes
    ----------
    wind_class : str
        Class of IEC 61400-1; "S" takes `v_ref` and `v_ave`, the tropical classes are of edition 4.
    category : str
        Turbulence category; "S" takes `reference_intensity`.
    v_ref, v_ave : float, optional
        Reference and annual mean speed of class S, m/s.
    reference_intensity : float, optional
        Turbulence intensity at 15 m/s of category S.
    shear_exponent : float
        Exponent of the normal wind profile: 0.2 onshore, 0.14 offshore.
    speed_step : float
        Distance of the mean speeds of a load case, m/s.
    seeds : int, optional
        Realisations per mean speed; by default those of the load case.
    spectrum : {"kaimal", "mann"}
        Model of the turbulence; "mann" needs the extra of that name, and is made on a square grid
        with the spacing of the radii (`mann_box`).
    scaling : {"none", "hub", "each"}
        Whether the turbulence is rescaled to the standard deviation asked for (`kaimal`).
    lateral : {"coherent", "independent"}
        Coherence of the lateral and vertical components (`kaimal`).
    radii, angles : int
        Number of radii (with the hub) and of angles of the polar grid.
    step : float
        Time step of the wind, s. Half of it moves equivalent hub loads by less than 0.5 %, single
        extremes by about 1 % (docs/wind.md).

    Examples
    --------
    >>> from loadflow.wind import WindOptions
    >>> WindOptions(wind_class="II", category="A").shear_exponent
    0.2
    """

    wind_class: ClassName = "I"
    category: CategoryName = "B"
    v_ref: Annotated[float, Gt(0)] | None = None
    v_ave: Annotated[float, Gt(0)] | None = None
    reference_intensity: Annotated[float, Gt(0), Lt(1)] | None = None
    shear_exponent: Annotated[float, Ge(0), Lt(1)] = 0.2
    speed_step: Annotated[float, Gt(0)] = 2.0
    seeds: Annotated[int, Ge(1)] | None = None
    spectrum: Spectrum = "kaimal"
    scaling: Scaling = "none"
    lateral: Lateral = "coherent"
    radii: Annotated[int, Ge(2)] = 11
    angles: Annotated[int, Ge(3)] = 48
    step: Annotated[float, Gt(0)] = 0.1

    def __post_init__(self) -> None:
        for name, kind in _CHOICES.items():
            value, known = getattr(self, name), get_args(kind)
            if value not in known:
                raise InputError(f"{name} = {value!r} is unknown; known: {', '.join(known)}")
        if not 0 <= self.shear_exponent < 1:
            raise InputError(
                f"shear_exponent = {self.shear_exponent} is not allowed; it must be in [0, 1)"
            )
        if self.spectrum == "mann" and self.scaling == "each":
            raise InputError("scaling = 'each' would break the correlations of spectrum = 'mann'")
        own_speeds = [speed for speed in (self.v_ref, self.v_ave) if speed is not None]
        if len(own_speeds) != (2 if self.wind_class == "S" else 0):
            raise InputError(
                f"wind_class = {self.wind_class!r} with v_ref = {self.v_ref} and v_ave = "
                f"{self.v_ave} m/s: class 'S', and only it, takes both"
            )
        for name in ("v_ref", "v_ave"):
            speed = getattr(self, name)
            if speed is not None and not 0 < speed < float("inf"):
                raise InputError(f"{name} = {speed} m/s must be > 0 and finite")
        intensity = self.reference_intensity
        if intensity is not None and not 0 < intensity < 1:
            raise InputError(f"reference_intensity = {intensity} must be in (0, 1)")
        if (self.reference_intensity is not None) != (self.category == "S"):
            raise InputError(
                f"category = {self.category!r} with reference_intensity = "
                f"{self.reference_intensity}: category 'S', and only it, takes one"
            )
        for name in ("speed_step", "step"):
            if not 0 < getattr(self, name) < float("inf"):
                raise InputError(f"{name} = {getattr(self, name)} must be > 0 and finite")
        if self.radii < 2 or self.angles < 3 or (self.seeds is not None and self.seeds < 1):
            raise InputError(
                f"radii = {self.radii}, angles = {self.angles}, seeds = {self.seeds}: "
                "at least 2 radii, 3 angles and 1 seed"
            )


@dataclass(frozen=True)
class Machine:
    """What the wind conditions need to know of a turbine.

    Attributes
    ----------
    cut_in, rated, cut_out : float
        Wind speeds at hub height, m/s.
    rotor_diameter, hub_height : float
        Lengths, m.

    Examples
    --------
    >>> from loadflow.wind import Machine
    >>> Machine(cut_in=3.0, rated=11.4, cut_out=25.0, rotor_diameter=126.0, hub_height=90.0).rated
    11.4
    """

    cut_in: float
    rated: float
    cut_out: float
    rotor_diameter: float
    hub_height: float

    def __post_init__(self) -> None:
        if not 0 < self.cut_in < self.rated < self.cut_out < float("inf"):
            raise InputError(
                f"cut_in = {self.cut_in}, rated = {self.rated}, cut_out = {self.cut_out} m/s "
                "must rise from above 0"
            )
        if not 0 < self.rotor_diameter / 2 < self.hub_height < float("inf"):
            raise InputError(
                f"a rotor of {self.rotor_diameter} m at a hub height of {self.hub_height} m "
                "reaches the ground"
            )
