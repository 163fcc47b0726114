"""Eight numbers side by side in compiled code, worked on by one instruction where there is one.

A compiler sees by itself that a long loop may go several numbers at a time, but not that one over
six or eight of them may. Kernels with such short rows say so: rows of arrays are as long as a
multiple of `LANES`, `take` reads one, and sums and products of what it gives are those of all of
its numbers. On a processor without such instructions they are done in several steps.
"""

from __future__ import annotations

import operator
from typing import Any, ClassVar

import numpy as np
from llvmlite import ir
from numba import types
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, register_model
from numpy.typing import NDArray

LANES = 8
"""Numbers side by side."""

_LINE = 64  # bytes of a line of the processor's cache, those of a row of lanes
_REAL = ir.DoubleType()
_ROW = ir.VectorType(_REAL, LANES)


class _Lanes(types.Type):
    """Type of such a row in compiled code."""

    def __init__(self) -> None:
        super().__init__(name="Lanes")


_lanes = _Lanes()


@register_model(_Lanes)
class _LanesModel(models.PrimitiveModel):
    """Its numbers are a vector of the processor."""

    def __init__(self, manager: Any, kind: Any) -> None:
        super().__init__(manager, kind, _ROW)


def lanes_for(count: int) -> int:
    """Least multiple of `LANES` that holds `count` numbers.

    Examples
    --------
    >>> from loadflow.numerics.lanes import lanes_for
    >>> lanes_for(8), lanes_for(14)
    (8, 16)
    """
    return LANES * -(-count // LANES)


def aligned(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Copy of `values` (…, L) of which each row of lanes lies in one line of the processor's cache.

    numpy begins arrays at any multiple of 16 bytes: most of them have every row across two lines,
    which a loop over films takes a tenth longer to read.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.numerics.lanes import aligned
    >>> aligned(np.ones((60, 8))).ctypes.data % 64
    0
    """
    room = np.empty(values.size + LANES)
    begin = -room.ctypes.data % _LINE // room.itemsize
    copy = room[begin : begin + values.size].reshape(values.shape)
    copy[...] = values
    return copy


def _spread(builder: Any, value: Any) -> Any:
    """The same number in every lane."""
    first = builder.insert_element(ir.Constant(_ROW, ir.Undefined), value, ir.IntType(32)(0))
    none = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(first, first, none)


def _defined(operation: Any, name: str) -> None:
    """Give compiled code an operation of rows, and of a row and a number."""
    pairs = [(_lanes, _lanes), (_lanes, types.float64), (types.float64, _lanes)]

    class Signatures(ConcreteTemplate):
        cases: ClassVar = [signature(_lanes, *pair) for pair in pairs]

    infer_global(operation)(Signatures)

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        rows = [
            value if kind == _lanes else _spread(builder, value)
            for kind, value in zip(made.args, args)
        ]
        return getattr(builder, name)(*rows)

    for pair in pairs:
        lower_builtin(operation, *pair)(code)


_defined(operator.add, "fadd")
_defined(operator.sub, "fsub")
_defined(operator.mul, "fmul")
_defined(operator.truediv, "fdiv")


def _place(context: Any, builder: Any, kind: Any, array: Any, offset: Any) -> Any:
    """Pointer to a row that begins `offset` numbers after the first one of an array."""
    data = context.make_array(kind)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [offset]), _ROW.as_pointer())


@intrinsic
def take(typing_context: Any, array: Any, offset: Any) -> Any:
    """Row of a contiguous `array`, `offset` numbers after its first."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        return builder.load(_place(context, builder, made.args[0], *args), align=8)

    return _lanes(array, types.intp), code


@intrinsic
def put(typing_context: Any, array: Any, offset: Any, row: Any) -> Any:
    """Put a `row` into a contiguous `array`, `offset` numbers after its first."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        builder.store(args[2], _place(context, builder, made.args[0], *args[:2]), align=8)
        return context.get_dummy_value()

    return types.void(array, types.intp, _lanes), code


@intrinsic
def spread(typing_context: Any, value: Any) -> Any:
    """Row of the same number."""
    return _lanes(types.float64), lambda context, builder, made, args: _spread(builder, args[0])


@intrinsic
def with_lane(typing_context: Any, row: Any, lane: Any, value: Any) -> Any:
    """The `row` with another number in one `lane`."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        return builder.insert_element(args[0], args[2], args[1])

    return _lanes(_lanes, types.intp, types.float64), code


@intrinsic
def magnitude(typing_context: Any, row: Any) -> Any:
    """Lane by lane, the magnitude."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        zero = ir.Constant(_ROW, [0.0] * LANES)
        negative = builder.fcmp_ordered("<", args[0], zero)
        return builder.select(negative, builder.fsub(zero, args[0]), args[0])

    return _lanes(_lanes), code


@intrinsic
def larger(typing_context: Any, row: Any, other: Any) -> Any:
    """Lane by lane, the larger one; `row` where the other is no number."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        return builder.select(builder.fcmp_ordered(">", args[1], args[0]), args[1], args[0])

    return _lanes(_lanes, _lanes), code


@intrinsic
def largest(typing_context: Any, row: Any) -> Any:
    """Largest number of a `row`; one that is no number counts for none, but in the first lane."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        most = builder.extract_element(args[0], ir.IntType(32)(0))
        for lane in range(1, LANES):
            other = builder.extract_element(args[0], ir.IntType(32)(lane))
            most = builder.select(builder.fcmp_ordered(">", other, most), other, most)
        return most

    return types.float64(_lanes), code


@intrinsic
def total(typing_context: Any, row: Any) -> Any:
    """Sum of the numbers of a `row`, by halves."""

    def code(context: Any, builder: Any, made: Any, args: Any) -> Any:
        whole, size = args[0], LANES
        while size > 1:
            size //= 2
            none = ir.Constant(whole.type, ir.Undefined)
            low, high = (
                ir.Constant(ir.VectorType(ir.IntType(32), size), [*range(first, first + size)])
                for first in (0, size)
            )
            whole = builder.fadd(
                builder.shuffle_vector(whole, none, low), builder.shuffle_vector(whole, none, high)
            )
        return builder.extract_element(whole, ir.IntType(32)(0))

    return types.float64(_lanes), code
