"""Motion of the blades and of what carries the rotor."""
