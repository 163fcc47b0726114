"""Room `readers`."""
