"""Where the load series of a scene come from, and what of it cannot be simulated."""

from __future__ import annotations

from math import pi
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, Field, ValidationInfo, field_validator, model_validator

from loadflow.numerics.fields import not_one_of
from loadflow.readers.aliases import Frame, read_channels
from loadflow.rotor.options import STEPS, RotorOptions
from loadflow.scene.section import Section
from loadflow.turbines import load_turbine
from loadflow.wind.cases import LOAD_CASES, load_case, wind_range
from loadflow.wind.options import CategoryName, ClassName, Lateral, Scaling, Spectrum, WindOptions

Positive = Annotated[float, Field(gt=0)]

LONGEST = 7200.0
"""Longest series, s: a wind field of more would fill the memory of most machines."""


class Loads(Section, BaseModel):
    """Where the load series come from.

    ``source = "simulate"`` makes them from IEC wind; ``source = "files"`` reads them: the output of
    a simulator, or a load cube (``.h5``). ``weights = "given"`` keeps the shares of the lifetime
    that a cube or a case list states; otherwise they follow from the wind speed (2.2).
    ``cases`` (list of cases), ``pattern``, ``channels`` (TOML file, or a table of them),
    ``gauge_distance`` (m) and ``frame`` of files are those of `loadflow.read_loads`.

    ``mass_imbalance`` (share of its mass) and ``pitch_imbalance`` (rad) are those of blade 1;
    without them the rotor is perfect and the fixed-frame loads have no 1p line.

    ``winds`` are turbulent fields of your own (names or patterns of ``.bts`` and ``.wnd`` files).
    The rotor is simulated in each, from its 60th second on, as in the load case ``dlc``. Their
    names tell wind speed and seed as those of load series do, or by ``pattern``; else the speed is
    the mean of the field.

    ``dlc`` is one design load case of IEC 61400-1 or several; wind speeds, realisations and length
    are those of each load case unless they are given here. ``seeds`` and ``first_seed`` concern
    turbulent winds; a gust has its own variants (sign, time of the event), and may meet the rotor
    at several ``azimuths`` (rad). ``yaw_errors`` are in rad. ``steady`` takes the steady extreme
    wind of 6.1 … 6.3 and 7.1.

    The wind is that of `loadflow.wind.WindOptions`: class "S" takes ``v_ref`` and ``v_ave`` (m/s),
    category "S" its ``reference_intensity``; ``shear_exponent`` is 0.2 onshore and 0.14 offshore
    (extreme winds have 0.11, fields of your own theirs); ``scaling`` and ``lateral`` say how the
    turbulence keeps its standard deviation and its coherence. ``spectrum = "mann"`` needs the extra
    of that name; ``wind_grid`` are the radii, with the hub, and the angles of the polar grid of the
    wind, and another grid is another realisation.

    ``dynamic_inflow``, ``dynamic_stall``, ``bend_twist``, ``blade_torsion`` (of turbines that tell
    theirs) and ``individual_pitch`` are those of `loadflow.rotor.RotorOptions`. Load cases in which
    the rotor stands or idles have ``dynamic_stall`` unless it is switched off by name. A ``rung``
    that is not named is "tower" ("flap" where the turbine does not say how its tower bends).
    """

    source: Literal["simulate", "files"] = "simulate"
    files: list[str] = []
    cases: str | None = None
    pattern: str | None = None
    channels: dict[str, list[str]] | None = None
    gauge_distance: Annotated[float, Field(ge=-100, le=100)] | None = None
    frame: Frame = "auto"
    winds: list[str] = []
    weights: Literal["rayleigh", "given"] = "rayleigh"
    dlc: str | Annotated[list[str], Field(min_length=1)] = "1.1"
    wind_speeds: Annotated[list[Positive], Field(min_length=1)] | None = None
    seeds: Annotated[int, Field(ge=1, le=1000)] | None = None
    first_seed: Annotated[int, Field(ge=0)] = 1
    yaw_errors: Annotated[list[float], Field(min_length=1)] | None = None
    azimuths: Annotated[list[float], Field(min_length=1)] = [0.0]
    steady: bool = False
    duration: Annotated[float, Field(gt=0, le=LONGEST)] | None = None
    step: Annotated[float, Field(ge=STEPS[0], le=STEPS[1])] = 0.025
    wind_class: ClassName = "I"
    v_ref: Positive | None = None
    v_ave: Positive | None = None
    category: CategoryName = "B"
    reference_intensity: Annotated[float, Field(gt=0, lt=1)] | None = None
    shear_exponent: Annotated[float, Field(ge=0, lt=1)] = 0.2
    spectrum: Spectrum = "kaimal"
    scaling: Scaling = "none"
    lateral: Lateral = "coherent"
    wind_grid: tuple[Annotated[int, Field(ge=2, le=41)], Annotated[int, Field(ge=6, le=288)]] = (
        11,
        48,
    )
    rung: Literal["tables", "bem", "flap", "tower"] | None = None
    dynamic_inflow: bool = False
    dynamic_stall: bool | None = None
    bend_twist: Annotated[float, Field(ge=-1, le=1)] = 0.5
    blade_torsion: bool = True
    individual_pitch: bool = False
    mass_imbalance: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0
    pitch_imbalance: Annotated[float, Field(ge=-0.2, le=0.2)] = 0.0

    @field_validator("yaw_errors", "azimuths")
    @classmethod
    def _in_radians(cls, angles: list[float] | None, info: ValidationInfo) -> list[float] | None:
        turn = 1 if info.field_name == "yaw_errors" else 2
        for angle in angles or []:
            if abs(angle) > turn * pi:
                raise ValueError(
                    f"{angle:g} rad is not allowed; it must be within ±{turn * pi:.5g} rad "
                    f"(±{turn * 180}°)"
                )
        return angles

    @property
    def makes_wind(self) -> bool:
        """Whether the wind is made, and neither it nor the loads are given."""
        return self.source == "simulate" and not self.winds

    @property
    def dlcs(self) -> tuple[str, ...]:
        """The design load cases, each once."""
        return tuple(dict.fromkeys([self.dlc] if isinstance(self.dlc, str) else self.dlc))

    @property
    def wind_options(self) -> WindOptions:
        """What the scene says about the wind."""
        radii, angles = self.wind_grid
        return WindOptions(
            wind_class=self.wind_class,
            category=self.category,
            v_ref=self.v_ref,
            v_ave=self.v_ave,
            reference_intensity=self.reference_intensity,
            shear_exponent=self.shear_exponent,
            seeds=self.seeds,
            spectrum=self.spectrum,
            scaling=self.scaling,
            lateral=self.lateral,
            radii=radii,
            angles=angles,
        )

    @property
    def rotor_options(self) -> RotorOptions:
        """What the scene says about the rotor, but for its rung."""
        return RotorOptions(
            bend_twist=self.bend_twist,
            blade_torsion=self.blade_torsion,
            dynamic_inflow=self.dynamic_inflow,
            dynamic_stall=self.dynamic_stall,
            individual_pitch=self.individual_pitch,
            mass_imbalance=self.mass_imbalance,
            pitch_imbalance=self.pitch_imbalance,
        )

    @field_validator("channels", mode="before")
    @classmethod
    def _own_channels(cls, channels: Any) -> Any:
        """The content of the file belongs to the scene: a run must not change with the file."""
        if channels is None:
            return None
        if not isinstance(channels, str | dict):
            raise ValueError(f"must be a file or a table of channels, not {channels!r}")
        return {key: list(names) for key, names in read_channels(channels).items()}

    @property
    def reading(self) -> dict[str, Any]:
        """Keywords of `loadflow.read_loads` that the scene states."""
        names = ("cases", "pattern", "channels", "gauge_distance", "frame")
        return {name: getattr(self, name) for name in names}

    @model_validator(mode="before")
    @classmethod
    def _former_names(cls, data: Any) -> Any:
        """Up to version 0.1 ``cases`` was called ``case_list``."""
        if isinstance(data, dict) and "case_list" in data:
            data = data | {"cases": data.get("cases") or data["case_list"]}
            del data["case_list"]
        return data

    @model_validator(mode="before")
    @classmethod
    def _given_before_simulated(cls, data: Any) -> Any:
        """Given series are read, not simulated anew, unless the scene says otherwise."""
        if isinstance(data, dict) and data.get("files") and "source" not in data:
            return data | {"source": "files"}
        return data

    @model_validator(mode="after")
    def _wind_is_whole(self) -> Self:
        _ = self.wind_options  # class and category S need what the others must not have
        return self

    @model_validator(mode="after")
    def _files_for_files(self) -> Self:
        if self.source == "simulate" and self.files:
            raise ValueError('files are given, but source = "simulate"; set source = "files"')
        own = {"wind_speeds", "seeds", "first_seed", "steady"} & self.changed
        if self.winds and (own or self.source == "files" or len(self.dlcs) > 1):
            raise ValueError(
                "winds: each field is a simulated case of one dlc; leave out "
                f"{', '.join(sorted(own)) or 'files, or all load cases but one'}"
            )
        return self


def check_simulation(loads: Loads, turbine: str) -> None:
    """Refuse what no simulation of these loads can do, before any is planned.

    Parameters
    ----------
    loads : Loads
        With ``source = "simulate"``.
    turbine : str
        Name or file of the turbine.

    Raises
    ------
    ValueError
        Naming key, value and what is allowed.
    """
    for dlc in loads.dlcs:
        if dlc not in LOAD_CASES:
            raise ValueError(f"loads.dlc: {not_one_of(dlc, LOAD_CASES)}")
        if loads.steady and not load_case(dlc).extreme:
            extreme = ", ".join(row.dlc for row in LOAD_CASES.values() if row.extreme)
            raise ValueError(
                f"loads.steady = true: load case {dlc} has no steady extreme wind; only {extreme}"
            )
    machine = load_turbine(turbine)
    if loads.individual_pitch and machine.control.individual_gain == 0:
        raise ValueError(
            f"loads.individual_pitch = true: {machine.name} has no control.individual_gain"
        )
    if loads.rung == "tower" and machine.tower.bending is None:
        raise ValueError(f'loads.rung = "tower": {machine.name} has no table tower.bending')
    for dlc in loads.dlcs:
        row = load_case(dlc)
        low, high = wind_range(row.events[0], machine.cut_in, machine.cut_out)
        state = "runs" if row.operating else "stands"
        for speed in loads.wind_speeds or []:
            if not low <= speed <= high:
                raise ValueError(
                    f"loads.wind_speeds = {speed} m/s is not allowed; in load case {dlc} "
                    f"{machine.name} {state} from {low:g} to {high:g} m/s"
                )
