"""Figures of results, as the report draws them: matplotlib, SI units in, units of drawings shown.

==================  ==============================================================
`journal`           pressure, gap, clearance circle, K and C, Stribeck curve
`rolling`           forces on the rolling elements, contact pressure
`style`             one look for all of them, units of drawings
==================  ==============================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
