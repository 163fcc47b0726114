"""The film on a plane ring, a cone or a straight pad."""
