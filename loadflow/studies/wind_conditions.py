"""Wind conditions of IEC 61400-1 at one wind speed, labelled with unit and meaning."""

from __future__ import annotations

import xarray as xr

from loadflow.stages.labelling import quantities
from loadflow.wind import iec


def iec_conditions(
    wind_speed: float, *, wind_class: str, category: str, rotor_diameter: float, hub_height: float
) -> xr.Dataset:
    """Return the wind conditions of IEC 61400-1 at a wind speed (m/s) for a rotor (m) and height.

    Raises
    ------
    loadflow.errors.InputError
        Unknown class or category, or a wind speed that has no gust.
    """
    v, size = wind_speed, (rotor_diameter, hub_height)
    rows = {
        "ntm_sigma": (iec.ntm_sigma(v, category), "m/s", "σ1, normal turbulence"),
        "etm_sigma": (iec.etm_sigma(v, wind_class, category), "m/s", "σ1, extreme turbulence"),
        "eog_amplitude": (
            iec.eog_amplitude(v, wind_class, category, *size),
            "m/s",
            "extreme operating gust",
        ),
        "edc_angle": (iec.edc_angle(v, category, *size), "rad", "extreme direction change, ±"),
        "ecd_angle": (iec.ecd_angle(v, wind_class), "rad", "coherent gust with direction change"),
        "ews_amplitude": (
            iec.ews_amplitude(v, category, *size),
            "m/s",
            "extreme wind shear, bracket before (1 − cos)",
        ),
        "length_scale": (iec.length_scale(hub_height), "m", "turbulence scale Λ1"),
    }
    conditions = (
        f"v = {v:g} m/s, class {wind_class}, category {category}, "
        f"D = {rotor_diameter:g} m, hub at {hub_height:g} m"
    )
    return quantities(rows, conditions=conditions)
