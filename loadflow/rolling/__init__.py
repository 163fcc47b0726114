"""Rolling bearings: load on every element, stiffness, static safety, life, friction.

================  ============================================================================
`bearings`        kinds of bearings (`kinds`: the list of them), their verbs (`base`), and
                  arrangements of two of them
`geometry`        what a kind says of itself; `raceways`, `roller_raceways`: what those of balls and
                  of rollers share
`contacts`        table of contacts that the solver takes; `contact_forces`: their forces
`equilibrium`     rigid rings in five degrees of freedom, for arrays of load cases; `_kernels`,
                  `_forces`: its compiled loops
`results`         what follows from the forces of all contacts
`edge_contact`    edge stress of rollers
`mounting`        fits and temperatures of the rings: clearance at work
`rings`           flexible rings: beams, finite elements, given matrices, condensed; dynamics
`rating`          capacities, rating life, modified life, static safety
`friction`        components of friction, catalogues, slewing bearings
`kinematics`      speeds of elements and cage; `motion`: their slip and inertia, crank drive, cage
`stiffness`       6 × 6 stiffness in closed form, films and damping, rotor coefficients
================  ============================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
