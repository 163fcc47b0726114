"""The shaft in motion: orbits over given and adaptive steps, and closed orbits."""
