"""The package beside finer or complete solutions of its own, and what parts of it cost."""
