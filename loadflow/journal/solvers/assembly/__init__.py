"""One shaft on several films: pads of a thrust bearing, segments of a cone, two cones."""
