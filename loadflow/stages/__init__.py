"""Stages of a run: each joins rooms, changes frame and units, and labels what comes back."""
