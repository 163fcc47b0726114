"""Rings in three dimensions with the contact resolved: reference of flexible rings and Hertz.

python -m benchmarks.references.ring_contact [four-ball | drive] [refinement]

Under axial load all balls are alike, so that one ring needs half a ball's sector only. It is meshed
by quadratic hexahedra in cylindrical coordinates, graded toward the contact to a fraction of its
ellipse. Pressures on the faces there and gaps to a ball, whose own surface yields as a half-space,
solve a linear complementarity problem; the ball rests between both rings where it is in balance.
Neither Hertz's law, nor a master point, nor a fixed contact angle enters. Prints load, u_z and ball
force, and those of `SlewingBearing.equilibrium`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import nnls, root
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementHexS2, ElementVector, FacetBasis, MeshHex, asm

from benchmarks.common import arguments
from loadflow.rolling import FiniteElementRing, FlexibleRings, SlewingBearing
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON
from loadflow.validation._slewing_cases import DRIVE, FOUR_BALL
from loadflow.validation.rings import drive_rings, four_ball_rings

MM = 1e-3  # the mesh is in mm, for well-scaled mappings


@dataclass(frozen=True)
class Refinement:
    """Sizes of the faces in the contact: along the groove, rad; around and in depth, of R_w."""

    along: float = math.radians(4)
    around: float = 0.01
    depth: float = 0.02
    growth: float = 2.0

    def finer(self, factor: float) -> Refinement:
        return Refinement(
            self.along / factor,
            self.around / factor,
            self.depth / factor,
            1 + (self.growth - 1) / math.sqrt(factor),
        )


class Wedge:
    """Half a ball's sector of one ring; `up` says on which groove the ball rests."""

    def __init__(self, ring: FiniteElementRing, up: float, fine: Refinement) -> None:
        bearing = ring.profile.bearing
        assert isinstance(bearing, SlewingBearing)
        self.ring, self.bearing, self.up = ring, bearing, up
        self.side = 1.0 if ring.profile.ring == "outer" else -1.0
        self.groove = bearing.groove(ring.profile.ring)
        arm = self.groove - bearing.ball_diameter / 2
        alpha = bearing.contact_angle
        self.centre = np.array(
            [
                bearing.pitch_diameter / 2 - self.side * arm * math.cos(alpha),
                -up * arm * math.sin(alpha),
            ]
        )
        line, self.cells = self._line(fine)
        self.line = line
        ball = bearing.ball_diameter / 2
        share = _graded(fine.depth * ball, fine.growth, 0.5 * ball)
        self.radius = float(line[:, 0].mean())  # turns angles into lengths
        count = round(0.04 / fine.around)
        step = fine.around * ball
        end = math.pi / bearing.balls * self.radius - count * step
        far = count * step + _graded(1.5 * step, 0.8 * fine.growth, end)
        self.around = np.concatenate([np.arange(count) * step, far])
        self.count = count
        points = line[:, None] + (share / share[-1])[:, None] * (self._far(line) - line)[:, None]
        self._compliances(self._mesh(points))

    def _line(self, fine: Refinement) -> tuple[np.ndarray, np.ndarray]:
        """Points of both grooves (r, z) from one land to the other, and cells in the contact."""
        profile, alpha = self.ring.profile, self.bearing.contact_angle
        edge = math.acos(self.side * (profile.land - self.centre[0]) / self.groove)
        arm = self.groove - self.bearing.ball_diameter / 2
        bottom = math.asin(arm * math.sin(alpha) / self.groove)
        low, high = math.radians(28), min(math.radians(72), edge - math.radians(2))
        contact = np.linspace(low, high, math.ceil((high - low) / fine.along) + 1)
        angle = np.concatenate(
            [np.linspace(bottom, low, 5)[:-1], contact, np.linspace(high, edge, 3)[1:]]
        )
        other = np.linspace(edge, bottom, 8)[:-1]

        def arc(angles: np.ndarray, up: float) -> np.ndarray:
            height = self.centre[1] * self.up  # of the groove's centre, mirrored with the groove
            return np.stack(
                [
                    self.centre[0] + self.side * self.groove * np.cos(angles),
                    up * (height + self.groove * np.sin(angles)),
                ],
                axis=1,
            )

        line = np.concatenate([arc(other, -self.up), arc(angle, self.up)])
        first = len(other) + 4
        return line, np.arange(first, first + len(contact) - 1)

    def _far(self, line: np.ndarray) -> np.ndarray:
        """Ends of the mesh lines on the section's other sides, on rays from mid groove."""
        profile = self.ring.profile
        assert math.isclose(profile.bottom, -profile.top)
        depth, top = abs(profile.back - self.centre[0]), profile.top
        angle = np.arctan2(line[:, 1], self.side * (line[:, 0] - self.centre[0]))
        corner = math.atan2(top, depth)
        far = np.empty_like(line)
        for k, a in enumerate(angle):
            if abs(a) <= corner:
                far[k] = profile.back, depth * math.tan(a)
            else:
                far[k] = self.centre[0] + self.side * top / math.tan(abs(a)), math.copysign(top, a)
        far[0], far[-1] = (profile.land, -self.up * top), (profile.land, self.up * top)
        for sign in (1, -1):
            far[np.abs(angle - sign * corner).argmin()] = profile.back, sign * top
        return far

    def _mesh(self, points: np.ndarray) -> Any:
        """Hexahedra in (r, arc at `radius`, z), mm."""
        shape = (*points.shape[:2], len(self.around))
        mesh = MeshHex.init_tensor(*(np.arange(n, dtype=float) for n in shape))
        i, j, k = mesh.p.round().astype(int)
        r, z = points[i, j].T
        return MeshHex(np.ascontiguousarray(np.stack([r, self.around[k], z]) / MM), mesh.t)

    def _compliances(self, mesh: Any) -> None:
        """Places, and mean displacement of all faces in the contact under unit loads on them."""
        basis = Basis(mesh, ElementVector(ElementHexS2()), intorder=4)
        lam, mu = self.ring.lame
        springs, big = self.ring.springs, self.radius

        def strains(u: Any, r: np.ndarray) -> tuple[np.ndarray, ...]:
            g = u.grad / MM
            return (
                g[0, 0],
                (u[0] + g[1, 1] * big) / r,
                g[2, 2],
                g[0, 1] * big / r + g[1, 0] - u[1] / r,
                g[1, 2] + g[2, 1] * big / r,
                g[0, 2] + g[2, 0],
            )

        @BilinearForm
        def elastic(u: Any, v: Any, w: Any) -> Any:
            r = w.x[0] * MM
            a, b = strains(u, r), strains(v, r)
            normal = lam * (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2])
            normal = normal + 2 * mu * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
            shear = mu * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
            return (normal + shear) * r / big * MM**3

        @BilinearForm
        def bedding(u: Any, v: Any, w: Any) -> Any:
            return sum(k * u[c] * v[c] for c, k in enumerate(springs)) * w.x[0] * MM / big * MM**2

        held = mesh.facets_satisfying(
            lambda x: self.ring.on_face(x[[0, 2]] * MM), boundaries_only=True
        )
        face = FacetBasis(mesh, basis.elem, facets=held, intorder=4)
        stiffness = (asm(elastic, basis) + asm(bedding, face)).tocsc()
        mirror = [
            basis.get_dofs(lambda x, e=e: np.abs(x[1] - e) < 1e-6).all()
            for e in (0.0, mesh.p[1].max())
        ]
        mirror = np.concatenate(mirror)
        free = np.setdiff1d(np.arange(basis.N), mirror[mirror % 3 == 1])  # no v on both planes
        loads = self._loads(basis, mesh)[free]
        inverse = splu(
            stiffness[free][:, free], permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}
        )
        compliance = loads.T @ inverse.solve(loads)
        n = len(self.place)
        self.compliance = ((compliance + compliance.T) / 2).reshape(n, 3, n, 3)

    def _loads(self, basis: Any, mesh: Any) -> np.ndarray:
        """Unit loads, evenly spread, on each face in the contact; sets the places of the faces."""
        width = self.around[self.count] / MM
        near = mesh.facets_satisfying(lambda x: x[1] < width, boundaries_only=True)
        middle = mesh.p[:, mesh.facets[:, near]].mean(axis=1) * MM
        cells = (self.line[:-1] + self.line[1:])[self.cells] / 2
        faces = {}
        for facet, (r, arc, z) in zip(near, middle.T):
            gap = np.hypot(cells[:, 0] - r, cells[:, 1] - z)
            if gap.min() < 1e-8:
                faces[int(gap.argmin()), int(np.searchsorted(self.around, arc)) - 1] = facet
        order = [faces[a, b] for a in range(len(cells)) for b in range(self.count)]
        surface = FacetBasis(mesh, basis.elem, facets=np.array(order), intorder=4)
        x = surface.global_coordinates().value * MM
        weight = surface.dx * x[0]
        weight /= weight.sum(axis=1, keepdims=True)
        self.place = (x * weight).sum(axis=-1).T / [1, self.radius, 1]
        loads = np.zeros((basis.N, len(order), 3))
        for k in range(surface.Nbfun):
            value = surface.basis[k][0].value
            for c in range(3):
                share = (value[c] * weight).sum(axis=-1)
                np.add.at(loads[:, :, c], (surface.element_dofs[k], np.arange(len(order))), share)
        return loads.reshape(basis.N, -1)

    def _ball_compliance(self) -> np.ndarray:
        """Of the ball's surface, a half-space, under the same faces and their mirror images."""
        length = np.linalg.norm(np.diff(self.line, axis=0), axis=1)[self.cells]
        along = np.cumsum(length) - length / 2
        ends = self.around[: self.count + 1]
        s, t = np.repeat(along, self.count), np.tile((ends[1:] + ends[:-1]) / 2, len(along))
        a, b = np.repeat(length, self.count) / 2, np.tile(np.diff(ends), len(along)) / 2

        def love(x: np.ndarray, y: np.ndarray) -> np.ndarray:
            def corner(u: np.ndarray, v: np.ndarray) -> np.ndarray:
                r = np.hypot(u, v)
                return u * np.log(v + r) + v * np.log(u + r)

            plus, minus = corner(x + a, y + b), corner(x - a, y - b)
            return plus + minus - corner(x - a, y + b) - corner(x + a, y - b)

        x = s[:, None] - s
        both = love(x, t[:, None] - t) + love(x, t[:, None] + t)
        return both * (1 - STEEL_POISSON**2) / (math.pi * STEEL_MODULUS * 4 * a * b)

    def push(self, ball: np.ndarray) -> np.ndarray:
        """Force (r, z) of a ball with its centre there on the ring."""
        r, theta, z = self.place.T
        away = np.stack([r * np.cos(theta) - ball[0], r * np.sin(theta), z - ball[1]])
        distance = np.linalg.norm(away, axis=0)
        normal = away / distance
        # faces are chords of the groove
        sag = self.groove - np.hypot(r - self.centre[0], z - self.centre[1])
        gap = distance + sag - self.bearing.ball_diameter / 2
        turned = np.stack(
            [
                normal[0] * np.cos(theta) + normal[1] * np.sin(theta),
                normal[1] * np.cos(theta) - normal[0] * np.sin(theta),
                normal[2],
            ],
            axis=1,
        )
        matrix = np.einsum("ia,iajb,jb->ij", turned, self.compliance, turned)
        factor = np.linalg.cholesky(matrix + self._ball_compliance())
        pressure, _ = nnls(factor.T, -np.linalg.solve(factor, gap), maxiter=10_000)
        return 2 * normal[[0, 2]] @ pressure


def solve(
    bearing: SlewingBearing, outer: Wedge, inner: Wedge, thrust: float
) -> tuple[float, float, float]:
    """Displacement u_z (m), ball force (N) and contact angle (rad) under an axial load."""
    share = thrust / bearing.balls
    start = float(bearing.equilibrium((0, 0, thrust)).displacement[2])

    def rest(x: np.ndarray) -> np.ndarray:
        ball, uz = x[:2] * MM, x[2] * MM
        on_outer, on_inner = outer.push(ball), inner.push(ball - [0, uz])
        return np.append(on_outer + on_inner, on_inner[1] + share) / abs(share)

    guess = np.array([bearing.pitch_diameter / 2, start, 2 * start]) / MM
    answer = root(rest, guess, options={"eps": 1e-6})
    if np.abs(answer.fun).max() > 1e-5:
        raise RuntimeError(f"no balance: {answer.message}")
    force = outer.push(answer.x[:2] * MM)
    return answer.x[2] * MM, float(np.hypot(*force)), math.atan2(abs(force[1]), force[0])


def _graded(first: float, growth: float, end: float) -> np.ndarray:
    """Places from 0 to `end`, the first steps growing from `first`."""
    places, step = [0.0], first
    while places[-1] + 1.3 * step < end:
        places.append(places[-1] + step)
        step *= growth
    return np.array([*places, end])


def main(name: str, factor: float) -> None:
    models: dict[str, tuple[SlewingBearing, FlexibleRings, tuple[float, ...]]] = {
        "four-ball": (FOUR_BALL, four_ball_rings(), (1e4, 3e4)),
        "drive": (DRIVE, drive_rings(), (2e4, 5e4, 1e5)),
    }
    bearing, rings, loads = models[name]
    fine = Refinement().finer(factor)
    for sign in (1.0, -1.0):
        parts = []
        for ring, up in ((rings.outer, sign), (rings.inner, -sign)):
            assert isinstance(ring, FiniteElementRing)
            parts.append(Wedge(ring, up, fine))
        for load in loads:
            shift, force, angle = solve(bearing, parts[0], parts[1], sign * load)
            ours = bearing.equilibrium((0, 0, sign * load), rings=rings)
            print(
                f"{sign * load:g} N: u_z {shift:.6g} m, ball {force:.6g} N, "
                f"{math.degrees(angle):.2f}°; "
                f"condensed {ours.displacement[2] / shift - 1:+.2%}, "
                f"{float(ours.maximum_force) / force - 1:+.2%}",
                flush=True,
            )


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("name", nargs="?", choices=("four-ball", "drive"), default="four-ball")
    parser.add_argument("factor", type=float, nargs="?", default=1.0, help="of refinement")
    main(**vars(parser.parse_args()))
