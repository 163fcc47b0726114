"""How the kernels of the rung "reduced" are compiled.

A film and its work arrays are tuples of some fifty arrays. To count references to each, to hand
each over from Python, and to raise where a number is divided by zero took half of the time, of
compiling and of running. So nothing here counts references (`_nrt`: it may not allocate), a
division by zero gives infinity or NaN, which Newton's loop looks for, and what compiled functions
alone call has no way in from Python. A function is compiled again in each that calls it, so levels
are few. Films with effects are handed on by their place, see `refer`; those without are small.
"""

from loadflow.numerics.linked import LINKED, contracted

outer = contracted(cache=True)
"""Of a function that Python calls; compiling it takes most of the time, so there are few."""

inner = contracted(**LINKED, forceinline=False)
"""Of a function that compiled ones alone call.

Unless it is said, numba lets a function become a part of each that calls it if the one for which it
is compiled first does so: what rubs in a thick shell took half a minute to compile.
"""

within = contracted(**LINKED, forceinline=True)
"""Of a function that takes another one: it becomes a part of each that calls it. Else the place of
the other one in memory would stay behind, with which numba keeps no kernel on the disk."""

once = contracted(inline="always")
"""Of a function that is called at one place alone, of which it becomes a part."""
