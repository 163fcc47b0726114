from .parameter_file import read_parameter_file as read_parameter_file
from .parameter_file import write_parameter_file as write_parameter_file
from .quasistatic import Reduced as Reduced
from .quasistatic import class_edges as class_edges
from .quasistatic import histogram as histogram
from .quasistatic import number_of_classes as number_of_classes
