"""Friction of rolling bearings, component by component, and as catalogues have it.

==================  ===========================================================================
module              responsibility
==================  ===========================================================================
rolling_resistance  hysteresis and hydrodynamic rolling resistance of a contact
roller_drag         viscous drag in cage pocket and at ribs (Hampp)
coulomb             roller and cage with Coulomb friction: forces, moments, losses
guides              cage sides and rim, thrust washers, lip seals
churning            churning with two constants, fitted to a run without load
contact_films       film of every roller and ball contact; `options`: lubricant, surfaces, ribs
roller_losses       film, Λ and losses of a whole roller bearing in ideal rolling
ball_losses         the same of ball and slewing bearings; `bearing`: what both share
differential_slip   sliding in curved contacts: mean speed along barrels, friction coefficient
heat                temperature at which losses and cooling balance
catalogue           Stribeck, Palmgren; `skf`: rolling, sliding, drag of each series of bearings
catalogued          those of a bearing under its loads
slewing_torque      slewing bearings, from loads and from ball forces
==================  ===========================================================================
"""

import lazy_loader as _lazy

__getattr__, __dir__, __all__ = _lazy.attach_stub(__name__, __file__)
