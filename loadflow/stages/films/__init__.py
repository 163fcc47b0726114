"""Films of the journal bearings of a run: how each is built, what it does, what is told of it."""
