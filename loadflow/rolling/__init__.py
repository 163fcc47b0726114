"""Rolling bearings: load on every element, stiffness, static safety, life, friction.

===============  ==============================================================================
module           responsibility
===============  ==============================================================================
slewing          four-point slewing bearing: geometry and entry point; slewing_result: verdicts
contact          table of contacts that the solver takes
equilibrium      rigid rings in five degrees of freedom, for arrays of load cases
_kernels         the compiled loops
life             capacity, equivalent load, spectra, oscillation, raceway capacities
safety           hardness factor, static safety
friction         friction torque after both formulas of the source
===============  ==============================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
