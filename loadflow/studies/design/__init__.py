"""The best design of a bearing: the space of its keys, single designs, what a search gives."""
