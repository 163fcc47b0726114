"""Heat in the film: energy of its cells, temperatures and growth of what encloses it."""
