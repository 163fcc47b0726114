"""Hard cases of films, friction and damping of rolling bearings."""

from __future__ import annotations

import numpy as np
from hard_case import Outcome, hard, refused
from richter import richter_printed

from loadflow.rolling import FrictionOptions, RollerBearing, roller_friction, rotor_coefficients
from loadflow.rolling.friction import balanced_temperature
from loadflow.rolling.motion.radial_load import behw_law, radial_distribution
from loadflow.rolling.stiffness.contact_films import richter_plate
from loadflow.tribology import lubricant, moes_line, traction
from loadflow.tribology.lubricant_states import barus_state

BEARING = RollerBearing(
    rollers=14, roller_diameter=11e-3, roller_length=11e-3, pitch_diameter=60.5e-3, clearance=8e-6
)
OPTIONS = FrictionOptions(oil=lubricant("crankshaft-5w-30"), temperature=363.15)


@hard(
    "friction",
    "a bearing without load",
    why="no contact: Hertz widths of zero, loads under roots in denominators, films without end",
    what="contacts without load lose nothing, are not stiff, and have wide but finite films",
)
def no_load():
    result = BEARING.equilibrium(force=(0.0, 0.0, 0.0))
    assert (result.roller_forces == 0).all()
    found = roller_friction(result, 100.0, OPTIONS)
    assert found.power == 0
    assert np.isfinite(found.film).all()
    assert (found.asperity_share == 0).all()
    out = rotor_coefficients(result, [1.0, 100.0], speed=100.0, options=OPTIONS)
    assert (out.stiffness == 0).all()
    assert (out.damping == 0).all()
    return Outcome("0 W, K = C = 0")


@hard(
    "friction",
    "load reversed through zero in steps of nine decades",
    why="all rollers let go within the clearance and touch on the other side",
    what="losses follow the loads: continuous, and the same both ways",
)
def reversal():
    load = np.concatenate([-np.logspace(3, -6, 40), [0.0], np.logspace(-6, 3, 40)])
    result = BEARING.equilibrium(force=load[:, None] * [1.0, 0.0, 0.0])
    loss = roller_friction(result, 100.0, OPTIONS).power
    assert np.isfinite(loss).all()
    assert np.allclose(loss, loss[::-1], rtol=1e-6, atol=1e-12)
    assert loss[40] == 0
    assert (np.diff(loss[40:]) >= 0).all()
    return Outcome(f"0 to {loss.max():.2f} W", float(result.residual.max()))


@hard(
    "friction",
    "rollers at the edge of the load zone",
    why="stiffness grows as δ^0.08: with infinite slope where a roller comes to bear",
    what="Newton's method from above on the convex balance, which it cannot cross",
)
def zone_edge():
    turn = np.linspace(0, 2 * np.pi / 14, 401)[:, None]
    angles = 2 * np.pi * np.arange(14) / 14 + turn
    found = radial_distribution(2000.0, angles, 8e-6, behw_law(11e-3))
    assert abs(found.loads.max() / 718.29 - 1) < 1e-5
    counts = {int(n) for n in (found.loads > 0).sum(axis=-1)}
    assert len(counts) == 2
    assert np.abs(np.diff(found.loads, axis=0)).max() < 10  # N a step
    balance = np.abs((found.loads * np.cos(angles)).sum(axis=-1) / 2000 - 1).max()
    return Outcome(f"{min(counts)} or {max(counts)} rollers carry", float(balance))


@hard(
    "friction",
    "squeezed film where tan γ₆ is infinite, and a film like glass",
    why="the printed real form is 0/0 at γ₆ = π/2 + kπ and overflows for stiff films",
    what="one complex tanh, and its series where it cancels",
)
def plate():
    half, film, modulus, omega = 1e-4, 5e-7, 1.5e9, 100.0
    worst = 0.0
    for turn in range(3):
        target = np.pi / 2 + turn * np.pi
        eta = 2 * (target / half) ** 2 * film**2 * modulus / (12 * omega)
        below, here, above = (
            richter_plate(modulus, 11e-3, half, film, eta * (1 + d), omega)
            for d in (-1e-6, 0, 1e-6)
        )
        worst = max(worst, float(abs(here - (below + above) / 2) / abs(here)))
        near = richter_printed(modulus, 11e-3, half, film, eta * (1 + 1e-4), omega)
        assert abs(here.real / near[0] - 1) < 1e-3
    trapped = richter_plate(modulus, 11e-3, half, film, 1e15, 1e5)
    assert abs(trapped.real / (modulus * 11e-3 / film * 2 * half) - 1) < 1e-6
    return Outcome("smooth through all three", worst)


@hard(
    "friction",
    "a free roller, pressed by its own inertia",
    why="0.6 N on a strip 2 μm wide: elastic films and rolling forces are far outside validity",
    what="films of all regimes (Moes), rolling force and traction of rigid cylinders",
)
def free_roller():
    modulus, radius = 230.77e9, 6.5e-3
    w = 0.61 / (modulus * 11e-3 * radius)
    u = 10.6e-3 * 1.5315 / (modulus * radius)
    rigid, film = 1.2257 * 4.895 * u / w, moes_line(2e-8 * modulus, u, w)
    assert rigid < film < 1.6 * rigid
    pull = traction.inlet_force(1.0, 10.6e-3, 11e-3, radius, film * radius)
    strip = 2 * 2e-6 * 11e-3 * 10.6e-3 / (film * radius)
    assert pull > 10 * strip
    return Outcome(f"h = {film * radius * 1e6:.2f} μm, wedge pulls {pull / strip:.0f} × the strip")


@hard(
    "friction",
    "traction of a film at 3 GPa",
    why="Barus gives e^60 times the viscosity: products overflow, the slope at rest is a step",
    what="the stress is limited before it is multiplied; 0 at rest, odd, the limit elsewhere",
)
def solid_film():
    stiff = barus_state(10.6e-3, 0.0, 2e-8, 0.0, np.array([3e9, 1e12]))[0][:, None]
    sliding = np.array([-1.0, -1e-12, 0.0, 1e-12, 1.0])
    newton = traction.newtonian_stress(stiff, sliding, 1e-7)
    stress = traction.smooth_stress(newton, 4e7)
    assert (stress[:, 2] == 0).all()
    assert np.array_equal(stress, -stress[:, ::-1])
    assert np.allclose(stress[:, -1], 4e7)
    return Outcome("40 MPa, 0 at rest")


@hard(
    "friction",
    "a series with standstills and reversals",
    why="film, thermal loading and losses over speed are 0/0 at rest",
    what="losses and films vanish with the speed; the sense of turning does not matter",
)
def standstill():
    speed = np.array([0.0, 1e-9, 1e-3, -1.5, 1.5, 0.0])
    result = BEARING.equilibrium(force=np.tile([3e3, 0, 0], (6, 1)))
    found = roller_friction(result, speed, OPTIONS)
    assert (found.power[[0, 5]] == 0).all()
    assert np.isclose(found.power[3], found.power[4])
    assert (np.diff(found.power[[0, 1, 2, 4]]) > 0).all()
    assert np.isfinite(found.torque).all()
    return Outcome(f"0 to {found.power.max():.1e} W", float(result.residual.max()))


@hard(
    "friction",
    "a bearing that cannot shed its heat",
    why="the temperature has no upper bound; oil laws end",
    what="a named error with the power that is left",
)
def too_hot():
    loaded = BEARING.equilibrium(force=(5e3, 0, 0))
    return refused(
        lambda: balanced_temperature(loaded, 500.0, OPTIONS, 1e-3, 293.15), "heat balance", "W"
    )
