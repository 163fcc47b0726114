"""Numbers that kernels of films hand on."""

import ast
import importlib
from collections import defaultdict
from pathlib import Path

import loadflow.journal.models as models

COMPILED = {"inner", "within", "njit"}
"""Decorators of functions that kernels call and that are compiled by themselves."""

SMALL = {"_at", "lighter", "of_table", "spare_state"}
"""Compiled in a moment."""

KNOWN = {"carry", "carry_on_pads", "condense", "correct", "load_of", "slow_heat", "substitute",
         "turn_pads"}  # fmt: skip
"""Kinds for a shaft of four coordinates, for one column, or for films without effects."""


def written_out(node, module):
    """A number of a call that numba knows when it compiles, or None."""
    if not isinstance(node, ast.Constant | ast.Name | ast.Attribute | ast.UnaryOp):
        return None
    try:
        value = eval(ast.unparse(node), dict(vars(module)))
    except (AttributeError, NameError):  # of the function itself
        return None
    return value if type(value) in (int, bool) else None


def test_no_function_is_compiled_again_for_a_number_that_is_written_out():
    """numba compiles a kind for each; of the balance of grooves it took four seconds a film."""
    functions, given = set(), defaultdict(set)
    room = Path(models.__file__).parent
    for file in sorted(room.rglob("*.py")):
        if not (file.name.startswith("_") or file.stem == "slow_heat") or file.stem == "__init__":
            continue
        within = ".".join(file.relative_to(room).with_suffix("").parts)
        module = importlib.import_module(f"{models.__name__}.{within}")
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.FunctionDef):
                made = {
                    n.id
                    for d in node.decorator_list
                    for n in ast.walk(d)
                    if isinstance(n, ast.Name)
                }
                if made & COMPILED:
                    functions.add(node.name)
            elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                for place, one in enumerate(node.args):
                    given[node.func.id, place].add(repr(written_out(one, module)))
    again = {name for (name, _), kinds in given.items() if name in functions and len(kinds) > 1}
    assert {"hold_points", "follow_grooves"} < functions
    assert again - SMALL == KNOWN
