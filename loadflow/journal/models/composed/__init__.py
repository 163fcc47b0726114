"""The rung "reduced" with effects: at rest, at positions, through time, with and without heat."""
