"""Where windIO has each figure: version 2 first, then the ontology of WISDEM before it."""

from __future__ import annotations

from typing import Any

import numpy as np

_DEGREE = np.pi / 180
_RPM = np.pi / 30
Alternatives = tuple[tuple[str, float], ...]

SCALARS: tuple[str, ...] = (
    "rated_power",
    "cut_in",
    "cut_out",
    "rotor.blades",
    "rotor.hub_height",
    "rotor.overhang",
    "rotor.tilt",
    "rotor.cone",
    "rotor.hub_mass",
    "rotor.hub_inertia",
    "drivetrain.gear_ratio",
    "drivetrain.generator_inertia",
    "drivetrain.torsional_stiffness",
    "drivetrain.torsional_damping",
    "drivetrain.hub_to_bearing",
    "drivetrain.bearing_span",
    "control.maximum_torque_rate",
    "control.speed_filter",
    "control.pitch_rate",
    "control.minimum_pitch",
    "control.constant_power",
)
"""Keys of a turbine that the format has as one number each."""

_TRAIN = "components.drivetrain"
_NACELLE = "components.nacelle.drivetrain"

PATHS: dict[str, Alternatives] = {
    "rated_power": (("assembly.rated_power", 1), ("control.supervisory.rated_power", 1)),
    "cut_in": (("assembly.cut_in_wind_speed", 1), ("control.supervisory.Vin", 1)),
    "cut_out": (("assembly.cut_out_wind_speed", 1), ("control.supervisory.Vout", 1)),
    "rotor.blades": (("assembly.number_of_blades", 1),),
    "rotor.hub_height": (("assembly.hub_height", 1),),
    "rotor.overhang": ((f"{_TRAIN}.outer_shape.overhang", 1), (f"{_NACELLE}.overhang", 1)),
    "rotor.tilt": (
        (f"{_TRAIN}.outer_shape.uptilt", _DEGREE),
        (f"{_NACELLE}.uptilt", 1),
        (f"{_NACELLE}.uptilt_angle", 1),
    ),
    "rotor.cone": (("components.hub.cone_angle", _DEGREE),),
    "rotor.hub_mass": (
        ("components.hub.elastic_properties.mass", 1),
        ("components.hub.elastic_properties_mb.system_mass", 1),
    ),
    "rotor.hub_inertia": (
        ("components.hub.elastic_properties.inertia", 1),
        ("components.hub.elastic_properties_mb.system_inertia", 1),
    ),
    "hub diameter": (("components.hub.diameter", 1),),
    "drivetrain.gear_ratio": ((f"{_TRAIN}.gearbox.gear_ratio", 1), (f"{_NACELLE}.gear_ratio", 1)),
    "drivetrain.generator_inertia": (
        (f"{_TRAIN}.generator.elastic_properties.inertia", 1),
        ("components.nacelle.generator.elastic_properties_mb.system_inertia", 1),
    ),
    "drivetrain.torsional_stiffness": ((f"{_TRAIN}.elastic_properties.spring_constant", 1),),
    "drivetrain.torsional_damping": ((f"{_TRAIN}.elastic_properties.damping_coefficient", 1),),
    "drivetrain.hub_to_bearing": (
        (f"{_TRAIN}.outer_shape.distance_hub_mb", 1),
        (f"{_NACELLE}.distance_hub_mb", 1),
    ),
    "drivetrain.bearing_span": (
        (f"{_TRAIN}.outer_shape.distance_mb_mb", 1),
        (f"{_NACELLE}.distance_mb_mb", 1),
    ),
    "gearbox efficiency": (
        (f"{_TRAIN}.gearbox.efficiency", 1),
        (f"{_NACELLE}.gearbox_efficiency", 1),
    ),
    "generator efficiency": (
        (f"{_TRAIN}.generator.rpm_efficiency.values", 1),
        (f"{_NACELLE}.generator_rpm_efficiency_user.values", 1),
    ),
    "control.maximum_torque_rate": (
        ("control.max_torque_rate", 1),
        ("control.torque.max_torque_rate", 1),
    ),
    "control.speed_filter": (("control.lpf_frequency", 1 / (2 * np.pi)),),
    "control.pitch_rate": (
        ("control.max_pitch_rate", _DEGREE),
        ("control.pitch.max_pitch_rate", 1),
    ),
    "control.minimum_pitch": (("control.fine_pitch", _DEGREE), ("control.pitch.min_pitch", 1)),
    "control.constant_power": (("control.constant_power", 1),),
    "rated rotor speed": (
        ("control.rated_rotor_speed", _RPM),
        ("control.supervisory.maxOmega", 1),
    ),
    "lowest rotor speed": (
        ("control.min_rotor_speed", _RPM),
        ("control.supervisory.minOmega", 1),
        ("control.torque.VS_minspd", 1),
    ),
    "largest tip speed": (("control.supervisory.maxTS", 1),),
    "tip speed ratio": (("control.optimal_tsr", 1), ("control.torque.tsr", 1)),
    "largest torque": (("control.max_gen_torque", 1),),
    "pitch frequency": (("control.pitch.PC_omega", 1),),
    "pitch damping": (("control.pitch.PC_zeta", 1),),
    "thrust limit": (("control.pitch.ps_percent", 1),),
    "blade shape": (("components.blade.outer_shape", 1), ("components.blade.outer_shape_bem", 1)),
    "blade length": (
        ("components.blade.reference_axis.z.values", 1),
        ("components.blade.outer_shape_bem.reference_axis.z.values", 1),
    ),
    "tower diameter": (
        ("components.tower.outer_shape.outer_diameter.values", 1),
        ("components.tower.outer_shape_bem.outer_diameter.values", 1),
    ),
    "tower height": (
        ("components.tower.reference_axis.z.values", 1),
        ("components.tower.outer_shape_bem.reference_axis.z.values", 1),
    ),
    "pitch_kp": (("control.pitch_kp", 1),),
    "pitch_ki": (("control.pitch_ki", 1),),
    "min_pitch_table": (("control.min_pitch_table", 1),),
    "name": (("name", 1),),
}
"""Where each figure stands, and what makes SI units and radians of it."""


class Source:
    """A document of windIO, asked by what is wanted.

    Attributes
    ----------
    hints : dict
        Where in the format the keys are that were asked for and are not there.
    """

    def __init__(self, document: dict[str, Any]) -> None:
        self.document = document
        self.old = "windIO_version" not in document
        self.hints: dict[str, str] = {}

    def path(self, dotted: str) -> Any:
        """Return what stands at a path, None if nothing does."""
        found: Any = self.document
        for part in dotted.split("."):
            if not isinstance(found, dict) or part not in found:
                return None
            found = found[part]
        return found

    def at(self, key: str) -> Any:
        """Return what is there of a key, as it is written."""
        return self._first(key)[0]

    def number(self, key: str) -> float | None:
        """Return a number in SI units and radians; of a list its first, as inertias have it."""
        found, factor = self._first(key)
        if isinstance(found, list):
            found = found[0] if found else None
        return None if found is None else float(found) * factor

    def last(self, key: str) -> float | None:
        """Return the last number of a list."""
        found, factor = self._first(key)
        return None if not found else float(found[-1]) * factor

    def list(self, key: str) -> list[float]:
        """Return a list of numbers, empty if there is none."""
        return self._first(key)[0] or []

    def hint(self, key: str) -> str:
        """Say where the format has a key."""
        return "in windIO: " + " or ".join(path for path, _ in PATHS[key])

    def _first(self, key: str) -> tuple[Any, float]:
        for path, factor in PATHS[key]:
            found = self.path(path)
            if found is not None:
                # angles of the hub are in degrees in version 2 only
                return found, 1.0 if key == "rotor.cone" and self.old else factor
        self.hints[key] = self.hint(key)
        return None, 1.0
