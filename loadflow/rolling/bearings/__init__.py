"""Kinds of rolling bearings, and arrangements of two of them on a shaft."""
