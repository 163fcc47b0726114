"""One bearing under one load or one series, without a scene."""
