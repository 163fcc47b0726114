"""What the bearing rooms share: Hertz, lubricants, rough surfaces, wear, closed forms of films.

================  =============================================================================
module            responsibility
================  =============================================================================
hertz             point and line contacts
contact_ellipse   elliptic integrals of point contacts, exact and approximate
lubricant_laws    viscosity, density, pressure, heat of liquids
lubricant_states  the same with derivatives, for the energy equation of a film; compilable
lubricants        oils and greases as objects; the library `loadflow/data/lubricants.toml`
contact_film      film of rolling contacts: power laws, regimes, thermal and starvation factors
asperities        film against roughness, contact of asperities, share of the load on them
flow_factors      flow and friction factors of films between rough surfaces, mean gap
boundary          boundary friction; the library `loadflow/data/friction_pairs.toml`
traction          shear stress up to its limit, mixed friction
wear              laws of wear, running-in, worn contours
film              closed forms of the cylindrical, aligned journal bearing
film_tables       tables of ISO 7902, interpolated
couette           heat of a sheared film in closed form
kernels           compiled scalar forms with derivatives, for the loops of film solvers
================  =============================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
