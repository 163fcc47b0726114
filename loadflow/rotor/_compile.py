"""How the rotor's kernels are compiled.

A machine is a tuple of some forty arrays. Counting references to each of them, at each call for
each section, took two thirds of the time of a run, and handing them on, at each call for each
blade, a fifth of the rest; so what a step calls is inlined and counts none (`_nrt`: it may not
allocate, its `Room` comes with it), a machine is handed on by its place (`refer`), and division by
zero gives infinity or NaN, without a branch that raises. The loop is checked for finite results
afterwards.

What Python never calls, tests included, has no way in from there (`inner_section`, …).
"""

from functools import partial

from loadflow.numerics.linked import LINKED, njit

_REORDER = {"contract", "reassoc", "nsz", "arcp"}  # sums in any order; infinity and NaN are kept
_plain = partial(njit, nogil=True, error_model="numpy", fastmath=_REORDER)
_section = partial(_plain, forceinline=True, _nrt=False)
_once = partial(_plain, _nrt=False)

kernel = _plain(cache=True)
"""Of a function that is called from Python, or seldom, and may allocate."""

section = _section(cache=True)
"""Of a function that is called for each section or blade at each step."""

once = _once(cache=True)
"""Of a function that is too large to stand at each place that calls it, and allocates nothing."""

part = _plain(cache=True, inline="always")
"""Of a function that is called at one place alone, of which it becomes a part: it is neither
compiled by itself nor handed a machine. That place counts no references, either.
"""

inner_section, inner_once = _section(**LINKED), _once(**LINKED)
"""The same of functions that compiled ones alone call."""
