"""Candidates for the same places, side by side: one comparison, its bands, its words."""
