"""Hydrodynamic journal bearing: film, cavitation, supply, equilibrium, orbit.

===============  =========================================================================
`bearing`        `JournalBearing`: what the user calls
`film_model`     `Film`: one description of the film; `lubricant`, `cavitation`: its liquid and laws
`surfaces`       cone, plane ring, straight pad, profiles
`shapes`         how the bore runs around; `relief`: what is cut into it or deforms it
`seat`           seats on which shells and pads align themselves
`shells`         elastic shells; `housings`: those in a housing on feet or a flange
`contact`        asperities; `stribeck`: friction over speed
`crowning`       best crown for a spectrum of loads
`supply`         grooves, pockets, restrictors, pump
`results`        what comes back; `rows`: how solved films become results
`heat`           oil and cooling: `Heat`, `FilmHeat`; `heat_results`: answers; `pad_heat`: oil
                 of pads
`thermal`        heat balance; `energy`: losses against the power of the shaft
`turbulence`     turbulent flow in the film
`validity`       limits of the model: laminar flow, pressure that oil and shell bear
`grid_bounds`    bounds of the error of the cells; `grid_error`: from coarser grids
`dimensionless`  a bearing in numbers without dimension
`thrust`         thrust and conical bearings: pads and their supports, single or in pairs, in series
`wear`           wear of a bore over a lifetime of starts and stops
`film`           the discrete film: mesh, gap, balance, grooves, elastic shells, kernels
`models`         the rungs: charts, mobility map, few unknowns across the width
`solvers`        statics, steps in time, closed orbits
===============  =========================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
