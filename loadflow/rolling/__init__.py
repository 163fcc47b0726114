"""Rolling bearings: load on every element, stiffness, static safety, life, friction.

=============  ================================================================================
`bearings`     kinds of bearings, and arrangements of two of them
`contacts`     table of contacts that the solver takes; `raceways`: what all ball bearings share
`equilibrium`  rigid rings in five degrees of freedom, for arrays of load cases; `_kernels`,
               `_forces`: its compiled loops
`results`      what comes back; `slewing_result`, `roller_result`: of these kinds
`edge_contact` edge stress of rollers
`rings`        flexible rings: beams, finite elements, given matrices, condensed; their dynamics
`rating`       capacities, rating life, modified life, static safety
`friction`     components of friction with an energy audit, catalogues, slewing bearings
`motion`       kinematics, slip and inertia of rolling elements, crank drive, cage
`stiffness`    6 × 6 stiffness in closed form, films and damping, coefficients for rotor dynamics
=============  ================================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
