"""Physics that a run can include or leave out; one file for each room."""
