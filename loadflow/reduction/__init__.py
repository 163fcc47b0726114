"""Room `reduction`."""
