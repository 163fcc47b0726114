"""Room `tribology`."""
