"""How kernels are compiled that other kernels alone call.

numba makes machine code of every function and, once more, of each function that calls it, as these
have it inside them. The first of the two nobody runs where Python does not call the function, and
it takes a fifth of the time of compiling. `LINKED` leaves it out: such a function is kept as LLVM's
code, optimised as ever, from which its callers are linked.
"""

from __future__ import annotations

import weakref
from typing import Any

from llvmlite import binding
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import FunctionPass, register_pass
from numba.core.typed_passes import NopythonTypeInference


class _Library(JITCodeLibrary):
    """Code for linking; the engine gets of it where the environment of the function is kept."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        names = [one.name for one in self._final_module.global_variables]
        places = [name for name in names if name.startswith("_ZN08NumbaEnv")]
        lines = [f'@"{name}" = common global i8* null' for name in places]
        head = f'target triple = "{binding.get_process_triple()}"'
        module = binding.parse_assembly("\n".join([head, *lines]))
        module.name = self._final_module.name
        # by this name, mangled in numba's class, its hooks find the library of an object
        module._CPUCodeLibrary__library = weakref.proxy(self)
        self._codegen._add_module(module)
        self._codegen._engine.finalize_object()
        self._finalized = True


@register_pass(mutates_CFG=False, analysis_only=False)
class _KeepForLinking(FunctionPass):
    """Give the lowering that follows a library that makes no machine code."""

    _name = "keep_for_linking"

    def __init__(self) -> None:
        super().__init__()

    def run_pass(self, state: Any) -> bool:
        codegen = state.targetctx.codegen()
        state.library = _Library(codegen, state.func_id.func_qualname)
        state.library.enable_object_caching()
        return True


class Linked(CompilerBase):
    """Compiler of a function that compiled ones alone call."""

    def define_pipelines(self) -> list[Any]:
        """Return numba's own passes, before the lowering of which the library is exchanged."""
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.add_pass_after(_KeepForLinking, NopythonTypeInference)
        passes.finalize()
        return [passes]


LINKED: dict[str, Any] = {
    "cache": True,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
    "pipeline_class": Linked,
}
"""Options of numba for it: ``njit(nogil=True, **LINKED)``; it has no way in from Python."""
