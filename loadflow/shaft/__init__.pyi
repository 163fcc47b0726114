from .options import Concept as Concept
from .options import MomentBearing as MomentBearing
from .options import ThreePoint as ThreePoint
from .options import TwoPoint as TwoPoint
from .reactions import bearing_loads as bearing_loads
