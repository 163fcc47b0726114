"""One bearing arrangement: its numbers, how far they are from their limits, and how sure."""
