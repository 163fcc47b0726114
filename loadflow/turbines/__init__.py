"""Turbines: what a rotor and its control are, one readable file per machine, with sources.

The files are TOML and lie beside this module; `load_turbine` takes the name of one of them or the
path of the user's own file of the same shape.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
