"""Models of the film behind one signature, from charts to few unknowns across the width."""
