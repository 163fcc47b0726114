"""Verbs of bearings by what rolls in them: balls in grooves, rollers on raceways."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Literal, cast

from numpy.typing import ArrayLike

from loadflow.rolling import friction
from loadflow.rolling.bearings.base import RollingBearing, RollingEquilibrium
from loadflow.rolling.friction.bearing import BearingFriction
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.results import ContactResult
from loadflow.rolling.rings.coupling import LineCoupling

if TYPE_CHECKING:
    from loadflow.rolling.raceways import BallRaceways
    from loadflow.rolling.roller_raceways import RollerRaceways


class BearingOfBalls(RollingBearing):
    """Verbs of bearings whose balls roll in grooves."""

    friction_model: ClassVar[Literal["balls", "rollers"] | None] = "balls"

    def losses(
        self, result: RollingEquilibrium[RollingBearing], speed: ArrayLike, options: FrictionOptions
    ) -> BearingFriction:
        """Friction of the contacts of a `result`; see `RollingEquilibrium.friction`."""
        return friction.ball_friction(cast("ContactResult[BallRaceways]", result), speed, options)


class BearingOfRollers(RollingBearing):
    """Verbs of bearings whose rollers roll straight on."""

    friction_model: ClassVar[Literal["balls", "rollers"] | None] = "rollers"
    flexible_rings: ClassVar[bool] = True

    def ring_coupling(self, element_angle: float = 0.0) -> LineCoupling:
        """How rollers feel flexible rings, the first one of each row at an azimuth, rad."""
        return LineCoupling(cast("RollerRaceways", self), element_angle)

    def losses(
        self, result: RollingEquilibrium[RollingBearing], speed: ArrayLike, options: FrictionOptions
    ) -> BearingFriction:
        """Friction of the contacts of a `result`; see `RollingEquilibrium.friction`."""
        rollers = cast("ContactResult[RollerRaceways]", result)
        return friction.roller_friction(rollers, speed, options)
