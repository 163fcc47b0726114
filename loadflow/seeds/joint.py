"""One verdict on several components of the same seeds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from loadflow.seeds.longrun import holm
from loadflow.seeds.verdict import SeedEquality


@dataclass(frozen=True)
class JointEquality:
    """Verdicts on speed and every load component, taken together.

    Attributes
    ----------
    parts : mapping of str to SeedEquality
        Verdict on each component by itself.
    alpha : float
        Level of significance; calibrated: of all components together.
    method : str
        ``"as-printed"`` or ``"calibrated"``.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.seeds import group_seeds_jointly
    >>> speed, force = np.random.default_rng(1).standard_normal((2, 3, 3000))
    >>> found = group_seeds_jointly({"speed": speed, "force": force}, dt=0.05).verdict
    >>> sorted(found.parts), found.equal
    (['force', 'speed'], True)
    """

    parts: Mapping[str, SeedEquality]
    alpha: float
    method: str

    @property
    def pvalue(self) -> float:
        """Smallest p value; calibrated: after Holm's correction for the number of components."""
        p = [part.pvalue for part in self.parts.values()]
        return float(holm(p).min()) if self.method == "calibrated" else min(p)

    @property
    def equal(self) -> bool:
        """Whether the seeds may be merged."""
        if self.method == "calibrated":
            return self.pvalue >= self.alpha
        return all(part.equal for part in self.parts.values())

    @property
    def text(self) -> str:
        """The verdict in words; which components differ, and in what."""
        if self.equal:
            return f"equal in {', '.join(self.parts)} (p = {self.pvalue:.2g})"
        apart = {n: p for n, p in self.parts.items() if not p.equal}
        return "; ".join(f"{name}: {part.text}" for name, part in apart.items())
