"""Input that is hard, random, damaged or of other programs: answered or refused with a reason."""
