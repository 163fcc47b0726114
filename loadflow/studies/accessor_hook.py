"""Gives xarray's Datasets their accessor ``lf`` as soon as both packages are there.

xarray takes a third of a second to import, which a command that needs none of it does not pay: so
nothing is imported here, and the accessor is registered right after whoever needs xarray has
imported it.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any


class _AfterXarray(MetaPathFinder):
    """Finds xarray as all others do, and has the accessor placed when it is loaded."""

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name != "xarray":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        if spec is not None and spec.loader is not None:
            loader: Any = spec.loader
            execute = loader.exec_module

            def then_place(module: ModuleType) -> None:
                execute(module)
                place(module)

            loader.exec_module = then_place
        return spec


class _Lazy:
    """In place of the accessor until it is asked for the first time."""

    def __get__(self, cube: Any, owner: Any) -> Any:
        from loadflow.studies.accessor import LoadflowAccessor

        return LoadflowAccessor if cube is None else LoadflowAccessor(cube)


def place(xarray: Any) -> None:
    """Give the Datasets of xarray their accessor."""
    if "lf" not in vars(xarray.Dataset):
        xarray.Dataset.lf = _Lazy()


def register() -> None:
    """Place it now, if xarray is loaded, or when it will be."""
    if "xarray" in sys.modules and hasattr(sys.modules["xarray"], "Dataset"):
        place(sys.modules["xarray"])
    elif not any(isinstance(one, _AfterXarray) for one in sys.meta_path):
        sys.meta_path.insert(0, _AfterXarray())
