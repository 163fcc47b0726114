from .options import RUNGS as RUNGS
from .options import RotorOptions as RotorOptions
from .options import Rung as Rung
from .simulation import simulate as simulate
from .simulation import simulate_condition as simulate_condition
from .steady import steady_state as steady_state
