"""Hydrodynamic journal bearing: film, cavitation, supply, equilibrium, orbit.

===============  ====================================================================
`bearing`        `JournalBearing`: what the user calls
`options`        lubricant, laws of the ruptured film
`thrust`         thrust bearings; `cone`, `conical_pair`: conical bearings, two of them
`surfaces`       cone, plane ring, straight pad, profiles; `pads`: where pads sit and give way
`shapes`         shapes of the bore and their relief
`shells`         elastic shells; `contact`: asperities; `stribeck`: friction over speed
`supply`         grooves, pockets, restrictors, pump
`results`        what comes back
`heat`           oil and cooling: `Heat`, `FilmHeat`; `heat_results` what comes back
`thermal`        heat balance; `energy`: losses against the power of the shaft
`validity`       limits of the model: turbulence; `grid_error`: error of the cells
`dimensionless`  a bearing in numbers without dimension
`film`           the discrete film: mesh, gap, balance, grooves, elastic shells, kernels
`models`         the rungs: charts, mobility map, few unknowns across the width
`solvers`        statics, steps in time, closed orbits
===============  ====================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
