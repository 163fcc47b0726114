"""Room `turbines`."""
