"""Film and heat together: at rest, and by the mean heat of a series."""
