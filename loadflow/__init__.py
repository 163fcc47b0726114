"""loadflow: from wind and load series to the main bearing of a wind turbine."""

import lazy_loader as _lazy

from loadflow.studies.accessor_hook import register as _register

__version__ = "0.1.0"

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)

_register()
