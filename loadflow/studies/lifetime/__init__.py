"""What bearings go through in a lifetime: fatigue, revolutions, extremes, energy."""
