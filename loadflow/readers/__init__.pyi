from .bladed import read_bladed as read_bladed
from .csv_text import read_csv as read_csv
from .hawc2 import read_hawc2 as read_hawc2
from .loads import read_loads as read_loads
from .openfast import read_openfast as read_openfast
from .registry import READERS as READERS
from .registry import Reader as Reader
