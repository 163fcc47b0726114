"""Equality of seeds: location, spread and spectrum of series that should be alike.

Rank tests as [Jonuschies 2015] prints them, and tests that keep their stated false-alarm rate on
autocorrelated records; grouping of seeds; number of seeds needed; probability paper.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
