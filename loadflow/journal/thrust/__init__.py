"""Films that carry a force along the shaft: thrust collars, cones, and the pads around a shaft."""
