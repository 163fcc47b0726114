"""Hard cases of films, friction and damping: no load, load reversal, edges, solids, resonance."""

import numpy as np
import pytest

from loadflow.rolling import FrictionOptions, RollerBearing, roller_friction, rotor_coefficients
from loadflow.rolling.film_dynamics import richter_plate, richter_printed
from loadflow.rolling.radial_load import behw_law, radial_distribution
from loadflow.tribology import lubricant, moes_line, traction
from loadflow.tribology.lubricant_laws import barus

BEARING = RollerBearing(
    rollers=14, roller_diameter=11e-3, roller_length=11e-3, pitch_diameter=60.5e-3, clearance=8e-6
)
OPTIONS = FrictionOptions(oil=lubricant("crankshaft-5w-30"), temperature=363.15)


def test_a_bearing_without_load_only_churns_and_has_no_stiffness():
    result = BEARING.equilibrium(force=(0.0, 0.0, 0.0))
    assert (result.roller_forces == 0).all()
    found = roller_friction(result, 100.0, OPTIONS)
    assert found.power == 0
    assert np.isfinite(found.film).all()
    assert (found.asperity_share == 0).all()
    out = rotor_coefficients(result, [1.0, 100.0], speed=100.0, options=OPTIONS)
    assert (out.stiffness == 0).all()
    assert (out.damping == 0).all()


def test_friction_is_continuous_through_a_load_reversal():
    load = np.concatenate([-np.logspace(3, -6, 40), [0.0], np.logspace(-6, 3, 40)])
    force = np.stack([load, 0 * load, 0 * load], axis=-1)
    loss = roller_friction(BEARING.equilibrium(force=force), 100.0, OPTIONS).power
    assert np.isfinite(loss).all()
    assert loss == pytest.approx(loss[::-1], rel=1e-6, abs=1e-12)
    assert loss[40] == 0
    assert (np.diff(loss[40:]) >= 0).all()


def test_load_zone_edges_as_the_cage_turns():
    turn = np.linspace(0, 2 * np.pi / 14, 401)[:, None]
    angles = 2 * np.pi * np.arange(14) / 14 + turn
    found = radial_distribution(2000.0, angles, 8e-6, behw_law(11e-3))
    assert found.loads.max() == pytest.approx(718.29, rel=1e-5)
    counts = (found.loads > 0).sum(axis=-1)
    assert set(counts) == {4, 5} or set(counts) == {5, 6}
    jumps = np.abs(np.diff(found.loads, axis=0)).max()
    assert jumps < 10  # N a step: rollers enter and leave without a jump


@pytest.mark.parametrize("turn", [0, 1, 2])
def test_the_plate_passes_where_the_printed_form_divides_by_zero(turn):
    """γ₆ = π/2 + kπ: tan is infinite."""
    half, film, modulus, omega = 1e-4, 5e-7, 1.5e9, 100.0
    target = np.pi / 2 + turn * np.pi
    eta = 2 * (target / half) ** 2 * film**2 * modulus / (12 * omega)
    values = [
        richter_plate(modulus, 11e-3, half, film, eta * (1 + d), omega) for d in (-1e-6, 0, 1e-6)
    ]
    assert abs(values[1] - (values[0] + values[2]) / 2) < 1e-9 * abs(values[1])
    near = richter_printed(modulus, 11e-3, half, film, eta * (1 + 1e-4), omega)
    assert values[1].real == pytest.approx(near[0], rel=1e-3)
    # a film so stiff that cosh overflows in the printed form
    trapped = richter_plate(modulus, 11e-3, half, film, 1e15, 1e5)
    assert trapped.real == pytest.approx(modulus * 11e-3 / film * 2 * half, rel=1e-6)


def test_a_free_roller_has_a_rigid_film():
    # pressed by its own inertia at 1000/min: 0.61 N, where elastic films are outside validity
    modulus, radius = 230.77e9, 6.5e-3
    w = 0.61 / (modulus * 11e-3 * radius)
    u = 10.6e-3 * 1.5315 / (modulus * radius)
    rigid = 1.2257 * 4.895 * u / w
    film = moes_line(2e-8 * modulus, u, w)
    assert film > rigid
    assert film == pytest.approx(rigid, rel=0.6)


def test_traction_of_a_film_under_gigapascals_is_its_limit():
    stiff = barus(10.6e-3, 2e-8, 3e9)
    sliding = np.array([-1.0, -1e-12, 0.0, 1e-12, 1.0])
    newton = traction.newtonian_stress(stiff, sliding, 1e-7)
    for law in (traction.clipped_stress, traction.smooth_stress):
        stress = law(newton, 4e7)
        assert stress[2] == 0
        assert stress == pytest.approx(-stress[::-1])
        assert stress[-1] == pytest.approx(4e7)


def test_a_series_with_standstills_and_reversals():
    speed = np.array([0.0, 1e-9, 1e-3, -1.5, 1.5, 0.0])
    result = BEARING.equilibrium(force=np.tile([3e3, 0, 0], (6, 1)))
    found = roller_friction(result, speed, OPTIONS)
    assert (found.power[[0, 5]] == 0).all()
    assert found.power[3] == pytest.approx(found.power[4])
    assert (np.diff(found.power[[0, 1, 2, 4]]) > 0).all()
    assert np.isfinite(found.torque).all()
