"""The bearings that a scene has where it states none: made for one turbine, and said of others."""

from __future__ import annotations

from collections.abc import Iterator

from loadflow.scene.bearings import Rolling
from loadflow.scene.journal import Journal
from loadflow.scene.turbine import Turbine


def usual_bearings(
    turbine: str, journal: Journal | None = None, rolling: Rolling | None = None
) -> Iterator[str]:
    """Say which bearings of a scene have the measures of the package's, made for another turbine.

    Parameters
    ----------
    turbine : str
        Name or file of the scene's turbine.
    journal, rolling : Journal, Rolling, optional
        Bearings that a wanted result is of.

    Examples
    --------
    >>> from loadflow.scene.journal import Journal
    >>> list(usual_bearings("nrel-5mw", Journal()))
    []
    >>> print(*usual_bearings("iea-15mw", Journal()))
    bearings N, N2: 3 m × 2.25 m, made for nrel-5mw; state those of iea-15mw in [bearings.N]
    """
    made_for = Turbine().name
    if turbine == made_for:
        return  # its own
    films, balls = Journal().geometry, Rolling().geometry
    told = f"made for {made_for}; state those of {turbine} in"
    if journal is not None:
        same = [place for place in journal.bearings if journal.at(place).geometry == films]
        if same:
            size = f"{films.diameter:g} m × {films.width:g} m"
            yield f"bearings {', '.join(same)}: {size}, {told} [bearings.{same[0]}]"
    if rolling is not None:
        same = [place for place, geometry in rolling.geometries.items() if geometry == balls]
        if same:
            size = f"a slewing bearing of {balls.pitch_diameter:g} m"
            yield f"bearings {', '.join(same)}: {size}, {told} [bearings.{same[0]}]"
