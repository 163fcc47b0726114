from . import cube as cube
from . import journal as journal
from . import plots as plots
from . import readers as readers
from . import reduction as reduction
from . import rolling as rolling
from . import rotor as rotor
from . import scene as scene
from . import seeds as seeds
from . import shaft as shaft
from . import tribology as tribology
from . import turbines as turbines
from . import wind as wind
from .cube import open_cube as open_cube
from .cube import save_cube as save_cube
from .readers import read_loads as read_loads
from .running.runner import run as run
from .scene.scene import read_scene as read_scene

__version__: str
