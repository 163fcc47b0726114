"""Rolling bearings: load on every element, stiffness, static safety, life, friction.

===============  ==============================================================================
module           responsibility
===============  ==============================================================================
slewing          four-point slewing bearing; `slewing_result`: life and friction from its forces
ball             deep groove and angular contact ball bearing
roller           cylindrical and tapered roller bearing; `roller_result`: pressure, safety, life
raceway, result  what all ball bearings share
patches          points where raceways ride on the rings
contact          table of contacts that the solver takes
equilibrium      rigid rings in five degrees of freedom, for arrays of load cases
rings            flexible rings, condensed to few modes; `slewing_flexible`: their equilibrium,
                 `slewing_transient`: their way to it, `slewing_reference`: without condensation
ring_beam        ring as a curved beam on its supports; `ring_section`: their constants
ring_fem         rings of finite elements, in harmonics (`ring_harmonics`); `ring_solid`: meshed all
                 round; `ring_local`: what Hertz counts already and is taken off them
ring_dynamics    natural frequencies of rings, and their Craig–Bampton form
ring_profile     sections with raceway grooves, as grids
ring_given       ring by a given compliance or stiffness; Guyan condensation
expansion        rings that widen under axial load, closed form
_kernels         the compiled loops of the solver; `_forces`: of all contact forces
capacity, life   dynamic capacities; equivalent load, spectra, oscillation
safety           hardness factor, static safety
crank            crank drive: motion, loads, inertia of the pin bearing's rollers
kinematics       speeds of cage, rollers and surfaces; `radial_load`: one row, one plane
friction         components of friction with an energy audit, catalogues, slewing bearings
lim_singh        6 × 6 stiffness in closed form; `film_dynamics`: films and damping of a contact
roller_history   loads, speeds, inertia and weight of all rollers over time
roller_motion    their spin and slip over such histories, compiled in `_coulomb_kernels` and
                 `_motion_kernels`
skidding         slip of a main bearing's rollers over a load series, and its friction
cage_rim         cage guided by a ring, as a dynamically loaded journal bearing
rotor_dynamics   stiffness and damping of a bearing over load and frequency
===============  ==============================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
