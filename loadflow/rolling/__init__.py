"""Room `rolling`."""
