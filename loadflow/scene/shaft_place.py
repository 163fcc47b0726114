"""How far a shaft may tilt in the clearances of its journal bearings."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from loadflow.scene.journal import Journal
from loadflow.scene.shaft import Shaft


def left_in_clearances(shaft: Shaft, journal: Journal) -> Iterator[str]:
    """Say which films do not know that the shaft tilts in the clearances of its bearings.

    Loads lift a shaft in one bearing and press it down in the other, so that it tilts by up to
    both clearances over their distance; films whose stiffness is not fed back to the shaft lie
    where rigid bearings hold it.

    Parameters
    ----------
    shaft : Shaft
        The suspensions.
    journal : Journal
        The bearings.
    """
    for kind, concept in shaft.suspensions.items():
        places = dict(zip(concept.bearings, concept.positions))
        films = [name for name in concept.bearings if name in journal.bearings]
        for one, other in pairwise(films):
            if one in shaft.coupled and other in shaft.coupled:
                continue
            first, second = (journal.at(name).geometry for name in (one, other))
            most = (first.clearance + second.clearance) / abs(places[one] - places[other])
            end = 0.5 * max(first.width, second.width) * most
            yield (
                f"shaft.{kind}: films of {one} and {other} lie where rigid bearings hold the "
                f"shaft; in their clearances it tilts by up to {1e3 * most:.2g} mrad, "
                f"{1e3 * end:.2g} mm at a bearing end, which no answer counts: supports with "
                'stiffness = "journal" do, and alignment of the bores takes back what stands still'
            )
