"""Capacities, rating lives and static safety (ISO 76, ISO 281, ISO/TS 16281)."""
