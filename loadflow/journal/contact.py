"""Contact of rough surfaces as an effect of the film: what the asperities are, and how they rub."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated

from annotated_types import Ge, Gt, Le

from loadflow.numerics.fields import check_fields, require
from loadflow.tribology.asperities import AsperityContact
from loadflow.tribology.boundary import friction_pair

ROUGHEST = 0.05  # roughness over the radial clearance up to which a film is one of smooth curvature


@dataclass(frozen=True)
class Contact:
    """Asperities of shaft and shell in a film, `Film.contact`: load, flow and friction are shared.

    The asperities carry p_a(h) at the gap h of the mean planes, which may be negative; the oil
    flows through the mean gap ⟨h_T⟩ that is left between them. Their friction, `friction` times
    the force normal to the shell, is added to that of the oil; its sideways force on the shaft is
    left out, as is that of the oil.

    Attributes
    ----------
    asperities : AsperityContact
        Combined roughness, contact modulus and factor of both surfaces [Greenwood and Tripp 1970].
    surface_roughness : float, optional
        Combined R_q of all heights, m, which the oil feels; left out, that of the asperities.
    friction : float or str
        Boundary friction coefficient μ, or the name of a pair of
        `loadflow.tribology.friction_pair_names`.
    pattern : float, optional
        Peklenik number γ of the roughness along the motion over that across, for the flow factors
        of [Patir and Cheng 1978, 1979]; 1 is isotropic. None: no flow factors, ⟨h_T⟩ alone.
    shaft_share : float
        Share of the shaft in the square of the combined roughness, σ₁²/σ². The rougher moving
        surface carries oil along; equal surfaces, 0.5, do not. Has no effect without `pattern`.

    Raises
    ------
    loadflow.errors.InputError
        A coefficient or pattern out of range, a pair that is not in the library.

    Examples
    --------
    >>> from loadflow.journal import Contact, Film, JournalBearing, Lubricant, Reynolds
    >>> from loadflow.tribology import AsperityContact
    >>> rough = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
    >>> film = Film(Lubricant(0.03), Reynolds(), contact=Contact(rough, friction=0.1))
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> standing = bearing.equilibrium((80e3, 0.0), 0.0, film)
    >>> round(float(standing.contact_share), 6), float(standing.friction_power)
    (1.0, 0.0)
    """

    asperities: AsperityContact
    friction: float | str = 0.15
    pattern: Annotated[float, Gt(0)] | None = None
    shaft_share: Annotated[float, Ge(0), Le(1)] = 0.5
    surface_roughness: Annotated[float, Gt(0), Le(1e-3)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        require(
            0.0 <= self.coefficient <= 2.0, "friction", self.friction, "0 … 2, or a pair's name"
        )

    @property
    def coefficient(self) -> float:
        """Boundary friction coefficient μ."""
        if isinstance(self.friction, str):
            return friction_pair(self.friction).boundary_coefficient
        return self.friction

    @property
    def roughness(self) -> float:
        """Combined roughness σ of all heights, m."""
        return self.surface_roughness or self.asperities.roughness

    def as_rough(self, share: float) -> Contact:
        """Return surfaces `share` times as rough, their tips as round.

        Then K of [Greenwood and Tripp 1970] goes as √σ.

        Examples
        --------
        >>> from loadflow.journal import Contact
        >>> from loadflow.tribology import AsperityContact
        >>> rough = Contact(AsperityContact(roughness=0.4e-6, contact_modulus=115e9, factor=1e-3))
        >>> worn = rough.as_rough(0.25).asperities
        >>> worn.roughness, worn.factor
        (1e-07, 0.0005)
        """
        tips, rough = self.asperities, self.surface_roughness
        asperities = replace(
            tips,
            roughness=share * tips.roughness,
            summit_height=share * tips.summit_height,
            factor=share**0.5 * tips.factor,
        )
        heights = None if rough is None else share * rough
        return replace(self, asperities=asperities, surface_roughness=heights)

    def check_clearance(self, clearance: float) -> None:
        """Refuse surfaces whose roughness is no longer small beside the radial `clearance`, m.

        Raises
        ------
        loadflow.errors.InputError
            Names the roughness and its range.
        """
        allowed = f"at most {ROUGHEST:g} of the radial clearance {clearance:.6g} m"
        rough, tips = self.asperities.roughness, self.asperities.summit_height
        for name, size in (
            ("roughness", rough),
            ("surface_roughness", self.roughness),
            ("summit_height", tips),
        ):
            require(size <= ROUGHEST * clearance, name, size, allowed)
