"""Models of the film behind one signature, from charts to few unknowns across the width.

`model` finds the one that is asked for. `composed` is the rung "reduced" where a film has effects.
"""
