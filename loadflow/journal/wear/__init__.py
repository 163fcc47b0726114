"""Wear of a bore: events that come back, the contour that they leave, the bearing after it."""
