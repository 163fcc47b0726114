"""What the film asks of every shell that gives way."""

from __future__ import annotations


class ElasticShell:
    """What the film asks of a shell, of whatever kind."""

    local = False
    """Whether it gives way where it is pressed alone, by a `compliance`, m/Pa."""
    any_grid = True
    """Whether it is known on every grid of the film."""

    @property
    def symmetric(self) -> bool:
        """Whether both halves of the width give way alike."""
        return True

    def symmetric_on(self, across: int) -> bool:
        """Whether both halves of the width give way alike on so many cells of a film across."""
        return self.symmetric

    def check_local(self, length: float) -> None:
        """Refuse a shell that is not as local as it claims under a pressure over `length`, m."""
