"""The rotor: wind over the swept disc in, loads of the rotor on the shaft out.

Blade-element momentum at every section, blades rigid or bending, variable speed and pitch control.
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
