"""A kind of rolling bearing in one place: what adding one takes."""

from dataclasses import dataclass
from typing import ClassVar

from loadflow.rolling import RollerBearing
from loadflow.rolling.contacts import Contacts


@dataclass(frozen=True, kw_only=True)
class HalfFilled(RollerBearing):
    """A cylindrical bearing in which each second place around is empty."""

    kind: ClassVar[str] = "half-filled"

    @property
    def track_rollers(self) -> int:
        """Rollers of a track."""
        return self.rollers // 2

    def contacts(self, element_angle: float = 0.0) -> Contacts:
        """Every second contact of the full bearing."""
        whole = super().contacts(element_angle)
        return Contacts(
            whole.table, whole.azimuth[::2], whole.law, whole.spatial, whole.cap, whole.lever
        )
