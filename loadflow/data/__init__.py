"""Package data: polars, reference tables, speed and error of the rungs."""
