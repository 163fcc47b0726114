"""How the rotor's kernels are compiled.

A machine is a tuple of some forty arrays. Counting references to each of them, at each call for
each section, took two thirds of the time of a run; so what works on one section is inlined and
counts none (`_nrt`: it may not allocate), and division by zero gives infinity or NaN, without a
branch that raises. The loop is checked for finite results afterwards.

What Python never calls, tests included, has no machine code of its own (`inner_kernel`, …).
"""

from functools import partial

from numba import njit

from loadflow.numerics.linked import LINKED

kernel = partial(njit, cache=True, nogil=True, error_model="numpy")()
"""Of a function that is called once for each blade, or less, and allocates."""

section = partial(njit, cache=True, nogil=True, error_model="numpy", forceinline=True, _nrt=False)()
"""Of a function that is called for each section at each step."""

once = partial(njit, cache=True, nogil=True, error_model="numpy", _nrt=False)()
"""Of a function that is called once for each blade, or less, and allocates nothing."""

inner_kernel = partial(njit, nogil=True, error_model="numpy", **LINKED)()
inner_section = partial(
    njit, nogil=True, error_model="numpy", forceinline=True, _nrt=False, **LINKED
)()
inner_once = partial(njit, nogil=True, error_model="numpy", _nrt=False, **LINKED)()
"""The same of functions that compiled ones alone call."""
