"""A sketch of the shaft: hub, bearings, masses and axes, as SVG."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

WIDTH, LINE = 720.0, 150.0
LEFT, RIGHT = 90.0, 150.0

NAMES = {
    "two_point": "two bearings",
    "three_point": "one bearing and the arms of the gearbox",
    "integrated": "two bearings in the housing of the gearbox",
    "direct_drive": "two bearings, direct drive",
    "moment": "one bearing that takes the moment",
}


def sketch(suspensions: Sequence[Mapping[str, Any]]) -> str:
    """Draw the suspensions of a shaft below each other, to scale along it.

    Parameters
    ----------
    suspensions : sequence of mapping
        Each with `name`, `bearings`, `positions` (m from the hub centre), `locating` (the bearing
        that takes the thrust) and `masses` (pairs of position, m, and mass, kg).

    Returns
    -------
    str
        An ``<svg>`` element.

    Examples
    --------
    >>> line = {"name": "moment", "bearings": ["M"], "positions": [1.9], "locating": "M",
    ...     "masses": []}
    >>> sketch([line]).startswith("<svg")
    True
    """
    ends = [max([*one["positions"], *(at for at, _ in one["masses"])]) for one in suspensions]
    scale = (WIDTH - LEFT - RIGHT) / max([*ends, 1e-9])
    height = LINE * len(suspensions)
    body = "".join(
        _suspension(one, scale, LINE * (k + 0.5), ends[k]) for k, one in enumerate(suspensions)
    )
    label = "Shaft with its bearings: x along the shaft downwind, z up, y to the left downwind"
    return (
        f'<svg class="sketch" viewBox="0 0 {WIDTH:g} {height:g}" role="img" '
        f'aria-label="{label}">{body}{_axes(WIDTH - 105, LINE * 0.62)}</svg>'
    )


def _suspension(one: Mapping[str, Any], scale: float, y: float, end: float) -> str:
    stop = LEFT + end * scale + 18
    parts = [
        f'<text x="8" y="{y - 58:g}" class="strong">{escape(NAMES.get(one["name"], one["name"]))}'
        "</text>",
        f'<line x1="{LEFT:g}" y1="{y:g}" x2="{stop:g}" y2="{y:g}" class="shaft"/>',
        f'<path d="M {LEFT - 8:g} {y - 40:g} L {LEFT - 26:g} {y:g} L {LEFT - 8:g} {y + 40:g} Z" '
        'class="hub"/>',
        f'<text x="{LEFT - 84:g}" y="{y + 4:g}">rotor</text>',
    ]
    for place, at in zip(one["bearings"], one["positions"]):
        parts.append(_bearing(LEFT + at * scale, y, place, at, place == one["locating"]))
    for at, mass in one["masses"]:
        x = LEFT + at * scale
        parts.append(
            f'<circle cx="{x:g}" cy="{y:g}" r="5" class="mass"/>'
            f'<text x="{x:g}" y="{y - 34:g}" text-anchor="middle">{mass / 1e3:.4g} t</text>'
            f'<line x1="{x:g}" y1="{y - 30:g}" x2="{x:g}" y2="{y - 7:g}" class="thin"/>'
        )
    return "".join(parts)


def _bearing(x: float, y: float, place: str, at: float, locating: bool) -> str:
    boxes = "".join(
        f'<rect x="{x - 9:g}" y="{y + side:g}" width="18" height="13" class="bearing"/>'
        f'<line x1="{x - 9:g}" y1="{y + side:g}" x2="{x + 9:g}" y2="{y + side + 13:g}" '
        'class="thin"/>'
        f'<line x1="{x - 9:g}" y1="{y + side + 13:g}" x2="{x + 9:g}" y2="{y + side:g}" '
        'class="thin"/>'
        for side in (-20.0, 7.0)
    )
    role = "locates" if locating else "floats"
    return (
        f'{boxes}<text x="{x:g}" y="{y + 36:g}" text-anchor="middle" class="strong">'
        f"{escape(place)}</text>"
        f'<text x="{x:g}" y="{y + 51:g}" text-anchor="middle">{at:.3g} m, {role}</text>'
    )


def _axes(x: float, y: float) -> str:
    return (
        '<g class="axes">'
        f'<line x1="{x:g}" y1="{y:g}" x2="{x + 48:g}" y2="{y:g}"/>'
        f'<path d="M {x + 48:g} {y - 4:g} l 9 4 l -9 4 z"/>'
        f'<line x1="{x:g}" y1="{y:g}" x2="{x:g}" y2="{y - 42:g}"/>'
        f'<path d="M {x - 4:g} {y - 42:g} l 4 -9 l 4 9 z"/>'
        f'<circle cx="{x:g}" cy="{y:g}" r="6"/>'
        f'<line x1="{x - 4:g}" y1="{y - 4:g}" x2="{x + 4:g}" y2="{y + 4:g}"/>'
        f'<line x1="{x - 4:g}" y1="{y + 4:g}" x2="{x + 4:g}" y2="{y - 4:g}"/>'
        f'<text x="{x + 36:g}" y="{y + 18:g}">x, wind</text>'
        f'<text x="{x - 22:g}" y="{y - 44:g}">z</text>'
        f'<text x="{x - 22:g}" y="{y + 16:g}">y</text></g>'
    )
