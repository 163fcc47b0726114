from .cases import Case as Case
from .cases import list_cases as list_cases
from .changed import with_loads as with_loads
from .journal import Journal as Journal
from .scene import Scene as Scene
from .scene import make_scene as make_scene
from .scene import read_scene as read_scene
