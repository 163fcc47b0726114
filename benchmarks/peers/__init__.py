"""The package beside other packages and plain implementations of the same."""
