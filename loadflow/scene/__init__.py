"""The description of a run: sections, bearings, loads and load cases; knows no physics."""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
