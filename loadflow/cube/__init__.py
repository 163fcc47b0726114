"""The load cube: the one form in which load series pass from stage to stage."""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
