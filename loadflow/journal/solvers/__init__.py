"""Newton's method at rest, over time and on closed orbits, for film and shaft together."""
