"""Speed and error of every rung: what `loadflow plan` decides with."""
