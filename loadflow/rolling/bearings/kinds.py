"""The kinds of rolling bearings that scenes and the command line know: one row each."""

from __future__ import annotations

from loadflow.rolling.bearings.ball import BallBearing
from loadflow.rolling.bearings.base import RollingBearing
from loadflow.rolling.bearings.crossed_roller import CrossedRollerBearing
from loadflow.rolling.bearings.four_point import SlewingBearing
from loadflow.rolling.bearings.roller import RollerBearing
from loadflow.rolling.bearings.spherical import SphericalRollerBearing
from loadflow.rolling.bearings.three_row import ThreeRowRollerBearing
from loadflow.rolling.bearings.toroidal import ToroidalRollerBearing

KINDS: dict[str, type[RollingBearing]] = {
    kind.kind: kind
    for kind in (
        SlewingBearing,
        BallBearing,
        RollerBearing,
        SphericalRollerBearing,
        ToroidalRollerBearing,
        CrossedRollerBearing,
        ThreeRowRollerBearing,
    )
}
