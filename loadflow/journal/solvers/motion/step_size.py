"""How long the next step of a path may be: one rule for every rung, compiled where loops are."""

from __future__ import annotations

SAFETY = 0.8  # of the step that the error would allow; the next one shorter: this one was too long
SMALLEST = 1.0 / 256  # of a given step, to which a step that fails may be cut
FINEST = 1.0 / 65536  # of a given step, to which one that is not accurate may be cut


def foreseen(step: float, before: float, earlier: float) -> tuple[float, float, float]:
    """Weights of the last positions in the polynomial through them, at the end of a step.

    Parameters
    ----------
    step, before, earlier : float
        This step and the two before it, s; 0 where there is none.

    Returns
    -------
    tuple
        Of the last position, the one before it, and the one before that.

    Examples
    --------
    >>> foreseen(1.0, 1.0, 1.0)
    (3.0, -3.0, 1.0)
    """
    one, two, three = step, step + before, step + before + earlier
    if before == 0.0:
        return 1.0, 0.0, 0.0
    if earlier == 0.0:
        return two / before, -one / before, 0.0
    return (
        two * three / (before * (before + earlier)),
        -one * three / (before * earlier),
        one * two / ((before + earlier) * earlier),
    )


def growth(
    left: float, narrow: float, step: float, before: float, earlier: float, accuracy: float
) -> float:
    """How much longer the next step may be; below `SAFETY` this one was too long.

    The error of the step follows from how far the corrector left the polynomial through the last
    positions.

    Parameters
    ----------
    left : float
        That distance, clearances.
    narrow : float
        Narrowest gap, clearances.
    step, before, earlier : float
        As of `foreseen`.
    accuracy : float
        Error allowed, share of the narrowest gap; without limit where steps are given.

    Examples
    --------
    >>> growth(1e-6, 0.5, 0.1, 0.1, 0.1, 1e-3)
    2.0
    """
    share = 1.0
    if before > 0.0 and earlier > 0.0:
        ratio = step / before
        known = step * (1.0 + ratio) / (1.0 + 2.0 * ratio)
        share = known / (known + step + before + earlier)
    error = share * left / max(narrow, 1e-300)
    return min(2.0, max(0.2, SAFETY * (accuracy / max(error, 1e-300)) ** (1.0 / 3.0)))
