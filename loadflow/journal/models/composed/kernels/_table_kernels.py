"""Compiled: values of tables at equal distances, by cubics through values and slopes."""

from __future__ import annotations

from loadflow.journal.models._compile import inner


@inner
def of_table(tabulated, row, place):
    """A value at a `place` and its derivative; straight on before the first and behind the last.

    `tabulated` has the `first` place, the `step` between two, and a `table` of values in `row`,
    slopes in the next one.
    """
    table, place_in = tabulated.table, (place - tabulated.first) / tabulated.step
    if not place_in > 0.0:  # nor where a place is no number
        slope = table[row + 1, 0]
        return table[row, 0] + (place - tabulated.first) * slope, slope
    i = min(int(place_in), table.shape[1] - 2)
    return between(table[row], table[row + 1], i, place_in - i, tabulated.step)


@inner
def between(values, slopes, i, t, step):
    """Cubic through values and slopes at i and i + 1, and its slope; straight on beyond."""
    if t > 1.0:
        return values[i + 1] + (t - 1.0) * step * slopes[i + 1], slopes[i + 1]
    a, b = values[i], values[i + 1]
    u, v = step * slopes[i], step * slopes[i + 1]
    second, third = 3.0 * (b - a) - 2.0 * u - v, 2.0 * (a - b) + u + v
    value = a + t * (u + t * (second + t * third))
    return value, (u + t * (2.0 * second + 3.0 * t * third)) / step
