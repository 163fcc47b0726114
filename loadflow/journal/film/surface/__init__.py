"""The film on a plane ring or a cone."""
