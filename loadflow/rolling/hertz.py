"""Hertzian contacts, which live with tribology, offered here too."""

from loadflow.tribology.hertz import hertz_line as hertz_line
from loadflow.tribology.hertz import hertz_point as hertz_point
from loadflow.tribology.hertz_contact import LineContact as LineContact
from loadflow.tribology.hertz_contact import PointContact as PointContact
