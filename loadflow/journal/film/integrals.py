"""Integrals over a solved film: pressure, friction, flows, fill, and what the grooves feed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import FILL, LOAD, P
from loadflow.journal.film import _kernels as kernel
from loadflow.journal.film.groove_pressure import UNSUPPLIED

if TYPE_CHECKING:
    from loadflow.journal.film.film import DiscreteFilm
    from loadflow.journal.film.gap.asperity_load import AsperityLoad

Array = NDArray[np.float64]


class Integrals(NamedTuple):
    """Integrals over the solved film in the units of `_kernels`; numbers, or arrays over states.

    Largest pressure, dissipation, shear, flow over the bearing ends, total fill.
    """

    peak: Any
    dissipation: Any
    shear: Any
    outflow: Any
    fill: Any


def summary(film: DiscreteFilm, u: Array, position: Array) -> dict[str, Any]:
    """Integral results at `u`, in SI units, named as in `Equilibrium`."""
    film.place(u, position)
    found = integrals(film)
    row = {
        **in_units(film, found, film.speed, film.gap.narrowest(position)),
        **_supplied(film, u),
    }
    if film.contact is not None:
        rubbing = _rubbing(film, film.contact, position)
        row["friction_power"] += rubbing["contact_power"]
        row |= rubbing
    return row


@np.errstate(over="ignore", invalid="ignore")  # of an iteration that diverges
def integrals(film: DiscreteFilm) -> Integrals:
    """Integrals over the film at the state last placed."""
    mesh, coef, cells = film.mesh, film.gap.coef, film.mesh.z.size
    pressure, dz = film.state[LOAD], mesh.dz
    around, drops = _steps(film, pressure, film.p_edge, film.p_line)
    gap = coef[kernel.HM, :-1, :cells] * dz
    sheared = coef[kernel.HINV, :-1, :cells] * dz
    along, driving = around, drops
    if film.thickening is not None:
        along, driving = _steps(film, film.driving(pressure), *film.edges[:2])
        sheared = sheared * film.thickening.liquid.thickening(pressure)
    dissipation = float(np.sum(coef[kernel.G, : len(around), :cells] * along * around * dz))
    flow = coef[kernel.H3, :-1] * mesh.gz * driving
    if film.sheared_by_fill:
        fill = film.state[FILL].copy()
        for first, end, _, share in dragged_past_pads(film):
            fill[first:end] = share
        sheared = sheared * fill
    return Integrals(
        peak=float(pressure.max()),
        dissipation=dissipation + float(np.vdot(flow, drops)),
        shear=float(np.sum(sheared, where=~film.grooved)),
        outflow=float(np.maximum(flow[:, [0, -1]], 0.0).sum()),
        fill=float(np.vdot(film.state[FILL], gap) / gap.sum()),
    )


def idle_columns(film: DiscreteFilm) -> NDArray[np.bool_]:
    """Columns of cells (nx,) of pads without load."""
    return np.asarray((film.fixed & ~film.grooved).any(axis=1))


def dragged_past_pads(film: DiscreteFilm) -> Iterator[tuple[int, int, Array, Array]]:
    """What goes past each pad without load, at the state last placed.

    Its pressure is held, so that its balance of mass is nobody's: no more goes through than its
    narrowest place drags.

    Yields
    ------
    first, end : int
        Columns of its cells.
    through : array (nz,)
        Flow, in the units of `_kernels`.
    share : array (end − first, nz)
        Share of liquid of the cells.
    """
    idle = idle_columns(film)
    if not idle.any():
        return
    rows = film.mesh.shape[1]
    every = film.wedge * film.gap.coef[kernel.E, :, :rows] * film.mesh.area
    edges = np.flatnonzero(np.diff(np.concatenate([[False], idle, [False]]).astype(int)))
    for first, end in edges.reshape(-1, 2).tolist():
        faces = every[first : end + 1]
        through = faces[np.abs(faces).argmin(axis=0), np.arange(rows)]
        within = 0.5 * (faces[:-1] + faces[1:])
        yield first, end, through, through / np.where(within == 0.0, 1.0, within)


def _steps(film: DiscreteFilm, field: Array, edge: float, line: float) -> tuple[Array, Array]:
    """Steps of a `field` (nx, nz) over the faces around, and its drops over those across."""
    ends = (field[-1:],) if film.mesh.closed else (np.full((1, field.shape[1]), line),)
    around = np.diff(np.concatenate([*ends, field, *(() if film.mesh.closed else ends)]), axis=0)
    drops = np.empty((len(field), field.shape[1] + 1))
    np.subtract(field[:, :-1], field[:, 1:], out=drops[:, 1:-1])
    for end in (0, -1):
        drops[:, end] = np.where(film.grooved[:, end], 0.0, field[:, end] - edge)
    return around, drops


def _rubbing(film: DiscreteFilm, asperities: AsperityLoad, position: Array) -> dict[str, Any]:
    """What the asperities carry and lose at `position`, named as in `Equilibrium`."""
    touch, frame = asperities.at(position), film.gap.place(position)
    carried = touch.load[:2]
    whole = film.load_of(frame, position)[:2]
    size = float(whole @ whole)
    return {
        "contact_force": carried,
        "contact_pressure": touch.pressure,
        "contact_area": touch.area,
        "contact_power": asperities.contact.coefficient
        * touch.normal
        * abs(film.speed)
        * film.radius,
        "contact_share": float(carried @ whole) / size if size > 0.0 else 0.0,
    }


def in_units(film: DiscreteFilm, found: Integrals, speed: Any, narrowest: Any) -> dict[str, Any]:
    """Name `found` at `speed` and `narrowest` gap as in `Equilibrium`, in SI units."""
    clearance = film.relative_clearance * film.radius
    flow = film.pockets.flow_unit
    drag = film.mirrors * film.viscosity * speed**2 * film.radius**4 / clearance
    return {
        "minimum_film": clearance * narrowest,
        "maximum_pressure": found.peak,
        "friction_power": flow * found.dissipation + drag * found.shear,
        "side_flow": flow * found.outflow,
        "total_fill": found.fill,
    }


def _supplied(film: DiscreteFilm, u: Array) -> dict[str, Any]:
    """Flow and pressure of the grooves at the state last placed, named as in `Equilibrium`."""
    pockets = film.pockets
    if not film.ends_supply and not film.fixed.any():
        return UNSUPPLIED
    mass = np.zeros((film.mesh.shape[0], film.gap.across.shape[1]))
    outflow = film.balance(film.gap.coef, mass)
    flows = pockets.flows(outflow)
    shaped = float(outflow[film.fixed & ~pockets.fixed].sum()) + _from_ends(film)
    pressure = film.pressures[0].ravel()[pockets.samples]
    lack = film.unknown_of(np.array(film.p_edge)) - pockets.of_free(u)
    return {
        "supply_flow": float(flows.sum()) + pockets.flow_unit * shaped,
        "supply_power": pockets.feed.power(pressure, flows),
        "groove_flow": flows,
        "groove_pressure": pressure,
        "starved": bool(np.any(lack > 1e-9 * film.scale)),
    }


def _from_ends(film: DiscreteFilm) -> float:
    """Flow in at both ends of the film, where these are grooves."""
    if not film.ends_supply:
        return 0.0
    total = 0.0
    for cell, sign in ((0, 1.0), (-1, -1.0)):
        pressure, fill = (film.state[row, cell] for row in (P, FILL))
        upstream = film.line_fill if sign * film.wedge > 0 else fill
        g, e = film.gap.coef[[kernel.G, kernel.E], cell, : film.mesh.z.size]
        flow = g * (film.edges[1] - pressure) + sign * film.wedge * e * upstream
        total += float(film.mesh.dz @ flow)
    return total
