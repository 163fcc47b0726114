"""How warm a rolling bearing is: by what carries off its heat, or as measured."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

from annotated_types import Gt, Le

from loadflow.errors import InputError
from loadflow.rolling.housing import housing_area

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

_FORMS = ({"conductance"}, {"area", "transfer"}, {"transfer"}, {"temperature"})


@dataclass(frozen=True)
class Cooling:
    """How warm one rolling bearing is: by what carries off its heat, or stated.

    Attributes
    ----------
    conductance : float, optional
        Heat that the bearing gives off for each kelvin above what is around it, W/K.
    area : float, optional
        Surface of its housing that gives off heat, m². Left out beside `transfer` it is that of
        `loadflow.rolling.housing.housing_area`, which follows from the rolling elements.
    transfer : float, optional
        Heat that this gives off for each kelvin, W/(m² K); in place of `conductance`.
    temperature : float, optional
        K, in place of a heat balance: as measured.

    Raises
    ------
    loadflow.errors.InputError
        None of these forms, or several.

    Examples
    --------
    >>> from loadflow.rolling import BallBearing
    >>> bearing = BallBearing(balls=20, ball_diameter=0.05, pitch_diameter=0.6, groove_radius=0.026)
    >>> Cooling(area=4.0, transfer=15.0).conductance_of(bearing)
    60.0
    >>> round(Cooling(transfer=15.0).conductance_of(bearing), 1)
    15.5
    """

    conductance: Annotated[float, Gt(0)] | None = None
    area: Annotated[float, Gt(0)] | None = None
    transfer: Annotated[float, Gt(0)] | None = None
    temperature: Annotated[float, Gt(200), Le(500)] | None = None

    def __post_init__(self) -> None:
        given = {name for name, value in vars(self).items() if value is not None}
        if given not in _FORMS:
            raise InputError(
                "give conductance (W/K), or transfer (W/(m² K)) of the housing with or without its "
                "area (m²), or temperature (K)"
            )

    def conductance_of(self, bearing: RollingGeometry) -> float | None:
        """Heat that a bearing gives off for each kelvin, W/K; None of a stated temperature."""
        if self.transfer is None:
            return self.conductance
        return self.transfer * (housing_area(bearing) if self.area is None else self.area)
