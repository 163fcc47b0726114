"""Numbers of a run beside their limits: what holds, what governs, and who says so."""
