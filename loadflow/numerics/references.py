"""Named tuples of many arrays that compiled functions hand on by their place in memory.

numba hands a tuple on by value: one of fifty arrays is some four hundred numbers, which each call
copies, and which stand in the code of each call and of each look at a field. That took a third of
the time of compiling, and a fifth of that of running. So the function that Python calls lays its
tuples down once, `refer`, and others take references to them. Fields are read as those of the
tuple are, `film.ring.width[i]`; of a tuple within the tuple there is a reference, too.

A reference lasts as long as the function that has laid the tuple down. What is laid down stays as
it is; the numbers in its arrays may change.
"""

from __future__ import annotations

import hashlib
from typing import Any

from llvmlite import ir
from numba import typeof, types
from numba.core import cgutils
from numba.core.imputils import impl_ret_borrowed
from numba.core.typing.templates import AttributeTemplate
from numba.extending import (
    infer_getattr,
    intrinsic,
    lower_getattr_generic,
    models,
    register_model,
)

_SLOT = 8  # bytes that each number, address or truth value takes
_BYTES = ir.IntType(8).as_pointer()


class Reference(types.Type):
    """Type of a reference to a named tuple in compiled code."""

    def __init__(self, held: Any) -> None:
        self.held = held
        # the name of the tuple's type would make up most of the names of functions
        told = hashlib.sha256(str(held).encode()).hexdigest()[:16]
        super().__init__(name=f"Reference({held.instance_class.__name__}, {told})")


@register_model(Reference)
class _ReferenceModel(models.PrimitiveModel):
    """An address."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _BYTES)


@infer_getattr
class _Fields(AttributeTemplate):
    """Types of the fields."""

    key = Reference

    def generic_resolve(self, reference: Any, name: str) -> Any:  # type: ignore[override]
        held = reference.held
        if name not in held.fields:
            return None
        kind = held.types[held.fields.index(name)]
        return Reference(kind) if _is_named(kind) else kind


@lower_getattr_generic(Reference)
def _field(context: Any, builder: Any, reference: Any, place: Any, name: str) -> Any:
    """Code that reads a field."""
    held, at = reference.held, reference.held.fields.index(name)
    layouts = [context.get_value_type(kind) for kind in held.types[: at + 1]]
    place, kind = _slot(builder, place, sum(map(_slots, layouts[:at]))), held.types[at]
    if _is_named(kind):
        return place
    return impl_ret_borrowed(context, builder, kind, _take_up(builder, layouts[at], place))


@intrinsic
def refer(typing_context: Any, held: Any) -> Any:
    """Lay a named tuple down, and refer to it; a reference stays what it is."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        room = cgutils.alloca_once(builder, ir.ArrayType(ir.IntType(64), _slots(args[0].type)))
        place = builder.bitcast(room, _BYTES)
        _lay_down(builder, args[0], place, 0)
        # What is read there counts as constant, see `_take_up`: so the compiler is not to see that
        # it has just been written.
        hidden = ir.FunctionType(_BYTES, [_BYTES])
        return builder.asm(hidden, "", "=r,0,~{memory}", [place], side_effect=True)

    if isinstance(held, Reference):
        return held(held), lambda context, builder, made, args: args[0]
    return (Reference(held)(held), code) if _is_named(held) else None


def kind_of(value: Any) -> Any:
    """Type under which a value is handed on in compiled code: a named tuple by its reference."""
    kind = typeof(value)
    return Reference(kind) if _is_named(kind) else kind


def _is_named(kind: Any) -> bool:
    return isinstance(kind, types.BaseNamedTuple)


def _parts(layout: Any) -> list[Any] | None:
    """What a value consists of; None if it takes a slot."""
    if isinstance(layout, ir.ArrayType):
        return [layout.element] * int(layout.count)
    return list(layout.elements) if isinstance(layout, ir.BaseStructType) else None


def _slots(layout: Any) -> int:
    """How many slots a value takes."""
    parts = _parts(layout)
    return 1 if parts is None else sum(map(_slots, parts))


def _slot(builder: Any, place: Any, offset: int) -> Any:
    return builder.gep(place, [ir.IntType(64)(_SLOT * offset)])


def _lay_down(builder: Any, value: Any, place: Any, offset: int) -> int:
    """Store a value from a slot on, and return the slot after it."""
    parts = _parts(value.type)
    if parts is None:
        to = builder.bitcast(_slot(builder, place, offset), value.type.as_pointer())
        builder.store(value, to, align=_SLOT)
        return offset + 1
    for at in range(len(parts)):
        offset = _lay_down(builder, builder.extract_value(value, at), place, offset)
    return offset


def _take_up(builder: Any, layout: Any, place: Any) -> Any:
    """Load a value that was laid down; code in loops may take it before them."""
    parts = _parts(layout)
    if parts is None:
        value = builder.load(builder.bitcast(place, layout.as_pointer()), align=_SLOT)
        value.set_metadata("invariant.load", builder.module.add_metadata([]))
        return value
    value, offset = ir.Constant(layout, ir.Undefined), 0
    for at, part in enumerate(parts):
        number = _take_up(builder, part, _slot(builder, place, offset))
        value, offset = builder.insert_value(value, number, at), offset + _slots(part)
    return value
