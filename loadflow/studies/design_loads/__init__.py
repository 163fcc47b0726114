"""Load series → fewer loads to calculate with, and what that costs."""
