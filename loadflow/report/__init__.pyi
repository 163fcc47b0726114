from .page import Picture as Picture
from .page import Section as Section
from .page import Table as Table
from .page import write_page as write_page
