"""Tilting pads: where each pad comes to rest under the film."""
