"""Room `rotor`."""
