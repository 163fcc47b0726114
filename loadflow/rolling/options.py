"""Checks of fields, which live with numerics, offered here too."""

from loadflow.numerics.fields import check_choice as check_choice
from loadflow.numerics.fields import check_fields as check_fields
