"""Flexible rings: sections, beams, finite elements, given matrices, condensation, dynamics."""
