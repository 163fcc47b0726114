ConicalBearing = ConicalPair = None
