from . import iec as iec
from .field import Field as Field
from .field import polar_angles as polar_angles
