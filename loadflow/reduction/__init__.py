"""Design loads from load series: stationary, periodic and quasi-static; fatigue and duration.

What needs a bearing takes a callable ``response(mean, amplitude, frequency)``; nothing here knows
one.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
