"""Richter's film between plates in the real form that Kruk prints, (2.5)–(2.10)."""

import numpy as np


def richter_printed(bulk_modulus, length, half_width, film, viscosity, frequency):
    """Stiffness (N/m) and damping (N s/m) of the plate in the printed real form, (2.5)–(2.10).

    Exact, but undefined at γ₆ = π/2 + kπ and overflowing for stiff films; arguments as
    `richter_plate`.
    """
    g3 = 12 * viscosity * frequency / (film**2 * bulk_modulus)
    g6 = half_width * np.sqrt(g3 / 2)
    tan, tanh = np.tan(g6), np.tanh(g6)
    over = 1 + tanh**2 * tan**2
    g4 = (tanh / np.cos(g6) ** 2 + tan / np.cosh(g6) ** 2) / over
    g5 = (tanh / np.cos(g6) ** 2 - tan / np.cosh(g6) ** 2) / over
    scale, reach = bulk_modulus * length / film, np.sqrt(2 / g3)
    return (
        float(scale * (2 * half_width - reach * g4)),
        float(scale / frequency * reach * g5),
    )
