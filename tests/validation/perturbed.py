"""Rows of validation tables with the arithmetic of the package put slightly wrong.

Run as ``python perturbed.py TABLE ... [-ROOM ...]``; prints the rows as JSON, a list of name,
expected and got for each table. Every product, quotient and power in plain Python of the package,
those of its validation aside, and every returned real number is off by a share of 1e-11. Whole
numbers, which count something, stay; so do functions that numba compiles (with
``NUMBA_DISABLE_JIT=1`` they are plain Python, too), slices of rollers: of one slice off its middle
nothing resists the moment, and rooms that are given with a hyphen before them.
What is only read from data, or calculated in the table itself, does not move.
"""

import ast
import builtins
import importlib.machinery
import json
import os
import re
import sys

import numpy as np

SHARE = 1e-11
RETURNED = 2.718e-11  # another share: with the same one, factors above and below a line cancel
COMPILED = re.compile(
    r"^from numba|^import numba|_compile import|linked import|Cells\b", re.MULTILINE
)
EXACT = ["loadflow.rolling.roller_raceways"]
"""What stays as it is: slices of rollers, and the rooms given."""


def off(value, share):
    """A value, larger by `share` where it is a real number or an array or tuple of them."""
    if type(value) is float or isinstance(value, np.floating):
        return value if value % 1 == 0 else value * (1 + share)
    if type(value) is np.ndarray and value.dtype == float:
        return value if (value % 1 == 0).all() else value * (1 + share)
    if type(value) is tuple:
        return tuple(off(one, share) for one in value)
    return value


class Arithmetic(ast.NodeTransformer):
    """Sends products, quotients, powers and what is returned through `off`."""

    def visit_AnnAssign(self, node):
        return node  # of dataclasses and tables: numbers that are stated

    def visit_BinOp(self, node):
        self.generic_visit(node)
        reals = isinstance(node.op, ast.Mult | ast.Div | ast.Pow)
        return sent(node, "_product_off") if reals else node

    def visit_Return(self, node):
        self.generic_visit(node)
        if node.value is not None:
            node.value = sent(node.value, "_return_off")
        return node


def sent(node, function):
    """The call of a function on an expression."""
    call = ast.Call(func=ast.Name(function, ast.Load()), args=[node], keywords=[])
    return ast.copy_location(call, node)


class Loader(importlib.machinery.SourceFileLoader):
    """Loads a module of the package from its source, changed."""

    def get_code(self, fullname):
        path = self.get_filename(fullname)
        text = self.get_data(path).decode("utf-8")
        tree = ast.parse(text, path)
        plain = os.environ.get("NUMBA_DISABLE_JIT") or not COMPILED.search(text)
        exact = any(f"{fullname}.".startswith(f"{room}.") for room in EXACT)
        if plain and ".validation" not in fullname and not exact:
            tree = ast.fix_missing_locations(Arithmetic().visit(tree))
        return compile(tree, path, "exec", dont_inherit=True)


class Finder(importlib.machinery.PathFinder):
    """Finds the package's modules for `Loader`."""

    @classmethod
    def find_spec(cls, fullname, path=None, target=None):
        if fullname.partition(".")[0] != "loadflow":
            return None
        spec = super().find_spec(fullname, path, target)
        if spec is not None and (spec.origin or "").endswith(".py"):
            spec.loader = Loader(fullname, spec.origin)
        return spec


if __name__ == "__main__":
    builtins._product_off = lambda value: off(value, SHARE)
    builtins._return_off = lambda value: off(value, RETURNED)
    EXACT += [one[1:] for one in sys.argv[1:] if one.startswith("-")]
    sys.meta_path.insert(0, Finder)

    from loadflow import validation

    rows = {
        name: [
            [row.name, float(row.expected), float(row.got)] for row in validation.all_checks(name)
        ]
        for name in sys.argv[1:]
        if not name.startswith("-")
    }
    json.dump(rows, sys.stdout)
