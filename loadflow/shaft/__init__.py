"""Room `shaft`."""
