"""Hydrodynamic journal bearing: film, cavitation, supply, equilibrium, orbit.

========================  ==========================================================
`options`                 lubricant, laws of the ruptured film
`supply`                  grooves, pockets, restrictors, pump
`bearing`                 `JournalBearing`: what the user calls
`rungs`                   the table of models behind the same signature
`setup`                   from the user's words to the discrete film
`shapes`                  shapes of the bore and their relief
`shells`, `compliance`    elastic shells: as stated, and on the cells of a film
`cylinder`                influence numbers of a thick-walled cylinder
`mesh`, `gap_mesh`        cells of the film: of a plain cylinder, of a shaped bore
`gap`, `gap_shaped`       the discrete gap: of a plain cylinder; of any shape, shaft tilted or bent
`gap_elastic`             the same in a shell that gives way
`grooves`                 cells of grooves and pockets
`feed`                    flow against pressure of what feeds them
`pockets`                 their unknown pressures in the film
`film_elastic`            film and elastic shell in one Newton matrix
`film`                    balance, linearisation and integrals of the discrete film
`equilibrium`             Newton for film, and for film and shaft together
`softly`                  soft shells, step by step
`shaped`                  statics of shaped bores, tilted shafts and tilting pads
`orbit`                   implicit steps of film and shaft in time
`chart`, `superposed`     charts of ISO 7902, historical methods
`mapped`                  the rung "map": `mobility` tabulated from `moving` films
`periodic`                the closed orbit under a load that repeats
`energy`                  losses against the power of the shaft
`laminar`, `two_grids`    limits of the model: turbulence, error of the cells
`result`                  what comes back
`_kernels`                compiled loops
========================  ==========================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
