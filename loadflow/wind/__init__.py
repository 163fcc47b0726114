"""Room `wind`."""
