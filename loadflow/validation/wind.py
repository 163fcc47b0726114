"""Wind conditions of IEC 61400-1 against oracle values computed from the standard (class I A)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from loadflow.validation.check import Check, evidence

# D = 126 m, hub height 90 m: speed, σ1 NTM, σ1 ETM, V_gust EOG, θ EDC, θ ECD, EWS, Rayleigh bin ± 1
CLASS_I_A = (
    (4, 1.3760, 2.8314, 3.4929, 59.287, 180.0, 4.8180, 0.11003),
    (8, 1.8560, 3.2000, 4.7114, 40.474, 90.0, 5.6266, 0.15124),
    (12, 2.3360, 3.5686, 5.9298, 34.066, 60.0, 6.4352, 0.12143),
    (15, 2.6960, 3.8451, 6.8437, 31.486, 48.0, 7.0416, 0.08061),
    (25, 3.8960, 4.7667, 9.8898, 27.343, 28.8, 9.0631, 0.00590),
)
# share by which the 90 % quantile of edition 4 exceeds the formula with b = 5.6 m/s
QUANTILE_EXCESS = ((4, 0.025), (15, 0.006), (25, 0.003))


@evidence("closed form")
def checks() -> Iterator[Check]:
    """Yield the oracle values of class I A and the consistency of σ1's distribution."""
    from loadflow.wind import iec

    source = "IEC 61400-1, class I A, D = 126 m, z_hub = 90 m"
    geometry = (126.0, 90.0)
    for v, ntm, etm, eog, edc, ecd, ews, share in CLASS_I_A:
        # half a unit of the last printed digit
        rows = (
            ("σ1 NTM", ntm, iec.ntm_sigma(v, "A"), 5e-5, "m/s"),
            ("σ1 ETM", etm, iec.etm_sigma(v, "I", "A"), 5e-5, "m/s"),
            ("V_gust EOG", eog, iec.eog_amplitude(v, "I", "A", *geometry), 5e-5, "m/s"),
            ("θ EDC", edc, np.rad2deg(iec.edc_angle(v, "A", *geometry)), 5e-4, "deg"),
            ("θ ECD", ecd, np.rad2deg(iec.ecd_angle(v, "I")), 5e-4, "deg"),
            ("EWS bracket", ews, iec.ews_amplitude(v, "A", *geometry), 5e-5, "m/s"),
            ("share of bin ± 1 m/s", share, iec.bin_probability(v, 10.0), 5e-6, "-"),
        )
        for name, expected, got, digit, unit in rows:
            yield Check(
                f"{name}, V = {v} m/s", source, expected, float(got), digit, "absolute", unit
            )
    for v, excess in QUANTILE_EXCESS:
        got = iec.ntm_sigma_quantile(0.9, v, "A", edition=4) / iec.ntm_sigma(v, "A") - 1
        name = f"90 % quantile of σ1 above NTM, V = {v} m/s"
        yield Check(name, "IEC 61400-1 ed. 4", excess, float(got), 6e-4, "absolute")
    yield from turbulence_checks()


@evidence("closed form")
def turbulence_checks() -> Iterator[Check]:
    """Yield what a series of finite length holds, and the coherence between two points."""
    from loadflow.wind.spectra import coherence, kaimal_spectrum

    # S1 f^(5/3) = 0.05 σ1² (Λ1/V)^(−2/3) at high frequency
    high = 1e5
    limit = kaimal_spectrum(high, 15.0, 1.0, 42.0) * high ** (5 / 3) * (42.0 / 15.0) ** (2 / 3)
    name = "Kaimal inertial-range constant"
    yield Check(name, "IEC 61400-1, Annex B", 0.05, float(limit), 0.003)
    source = "Kaimal, class A, V = 15 m/s, z_hub = 90 m"
    for duration, share in ((600.0, 0.960), (3600.0, 0.990)):
        lines = np.arange(1, int(10 * duration)) / duration
        held = np.sqrt(kaimal_spectrum(lines, 15.0, 1.0, 42.0).sum() / duration)
        yield Check(f"σ1 held by {duration:.0f} s", source, share, float(held), 1e-3, "absolute")
    band = np.linspace(0.01, 0.03, 201)
    for distance, expected in ((7.0, 0.891), (35.0, 0.565)):
        got = coherence(band, distance, 15.0, 42.0).mean()
        name = f"coherence at {distance:.0f} m, 0.01 … 0.03 Hz"
        yield Check(name, source, expected, float(got), 3e-3, "absolute")
