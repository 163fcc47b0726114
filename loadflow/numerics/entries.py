"""Compiled functions that others call by their place in memory.

numba puts what a compiled function calls into it, and compiles that again with it. A large function
that is called once in a step gains nothing by that, and what calls it would have to wait until it
is compiled. Called by its place it stands by itself: two processes compile the two at once.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import (
    NativeValue,
    intrinsic,
    models,
    register_model,
    typeof_impl,
    unbox,
)


@dataclass(frozen=True)
class Entry:
    """A compiled function that returns nothing, to be handed to another one, which calls `enter`.

    Attributes
    ----------
    kernel : numba dispatcher
        The function.
    kinds : tuple of numba types
        Those of its arguments.
    """

    kernel: Any
    kinds: tuple[types.Type, ...]

    @property
    def address(self) -> int:
        """Its place; it is compiled where it is not on the disk.

        Asked when the other one begins, which is compiled by then.
        """
        self.kernel.compile(self.kinds)
        found = self.kernel.overloads[self.kinds]
        return int(found.library.get_pointer_to_function(found.fndesc.llvm_func_name))


class _EntryKind(types.Type):
    """Type of an entry in compiled code."""

    def __init__(self, kinds: tuple[types.Type, ...]) -> None:
        self.kinds = kinds
        told = hashlib.sha256(str(kinds).encode()).hexdigest()[:16]
        super().__init__(name=f"Entry({told})")


@typeof_impl.register(Entry)
def _kind_of_entry(entry: Entry, context: Any) -> _EntryKind:
    return _EntryKind(entry.kinds)


@register_model(_EntryKind)
class _EntryModel(models.PrimitiveModel):
    """An address."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, ir.IntType(8).as_pointer())


@unbox(_EntryKind)
def _taken(kind: Any, entry: Any, c: Any) -> NativeValue:
    """The address of an entry; what its compilation raises is raised."""
    address = c.pyapi.object_getattr_string(entry, "address")
    failed = cgutils.is_null(c.builder, address)
    place = cgutils.alloca_once_value(c.builder, c.context.get_constant_null(types.voidptr))
    with c.builder.if_then(c.builder.not_(failed)):
        c.builder.store(c.pyapi.long_as_voidptr(address), place)
        c.pyapi.decref(address)
    return NativeValue(c.builder.load(place), is_error=failed)


@intrinsic
def enter(typing_context: Any, entry: Any, given: Any) -> Any:
    """Call an entry with a tuple of arguments, whose types must be its own."""
    if not isinstance(entry, _EntryKind) or tuple(given) != entry.kinds:
        return None

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        place, packed = args
        convention, kinds = context.call_conv, entry.kinds
        called = builder.bitcast(
            place, convention.get_function_type(types.none, kinds).as_pointer()
        )
        values = [builder.extract_value(packed, k) for k in range(len(kinds))]
        status, _ = convention.call_function(builder, called, types.none, kinds, values)
        with cgutils.if_unlikely(builder, status.is_error):
            convention.return_status_propagate(builder, status)
        return context.get_dummy_value()

    return types.none(entry, given), code
