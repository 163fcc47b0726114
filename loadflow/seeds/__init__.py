"""Room `seeds`."""
