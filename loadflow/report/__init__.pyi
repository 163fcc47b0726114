from .charts import Chart as Chart
from .charts import Panel as Panel
from .mark import mark_of as mark_of
from .page import Drawing as Drawing
from .page import Picture as Picture
from .page import Section as Section
from .page import Table as Table
from .page import write_page as write_page
