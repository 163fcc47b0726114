from .cube import open_cube as open_cube
from .cube import save_cube as save_cube
from .readers import read_loads as read_loads
from .running.runner import run as run
from .scene.scene import read_scene as read_scene

__version__: str
