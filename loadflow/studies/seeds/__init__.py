"""Random seeds: which are equal, which belong together, whether they are enough."""
