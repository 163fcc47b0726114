"""What the bearing rooms share: Hertz, lubricants, film formulas, asperities, traction.

===============  ==============================================================================
module           responsibility
===============  ==============================================================================
hertz            point and line contacts
lubricant_laws   viscosity, density, pressure, heat of liquids
lubricants       oils and greases as objects; the library `loadflow/data/lubricants.toml`
contact_film     film of rolling contacts: power laws, regimes, thermal and starvation factors
asperities       film against roughness, share of the load on asperities
traction         shear stress up to its limit, mixed friction
film             closed forms of the plain journal bearing
===============  ==============================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
