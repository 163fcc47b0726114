"""What a command makes of a load cube or of one bearing, without running a scene."""
