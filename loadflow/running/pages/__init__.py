"""Pages of a run: the report, section by section, and its profile."""
