"""Suspension of the rotor shaft: hub loads → what the shaft applies to each bearing."""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
