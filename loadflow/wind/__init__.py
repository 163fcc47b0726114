"""Wind of IEC 61400-1: classes, steady and gust conditions, turbulence, load cases."""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
