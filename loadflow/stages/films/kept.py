"""What is kept of every film of a series: units and meaning by name."""

from __future__ import annotations

from loadflow.quantities import table
from loadflow.scene.journal import Journal

KEPT = table(
    "eccentricity_ratio",
    "attitude_angle",
    "minimum_film",
    "maximum_pressure",
    "sommerfeld_number",
    "friction_power",
    "side_flow",
    "supply_flow",
    "supply_power",
    "converged",
    "residual",
    "iterations",
)
"""What is kept of every sample: units and meaning."""
WARM = table("temperature")
"""What is kept too where there is a heat balance."""

GROWN = table("clearance")
"""What is kept too where shaft and shell grow with the temperature."""

ELASTIC = table("shell_deformation")
"""What is kept too of an elastic shell."""

CONTACT = table("contact_pressure", "contact_area", "contact_power", "contact_share")
"""What is kept too of asperities."""

RESOLVED = table("minimum_film_grid_error", "maximum_pressure_grid_error", "resolved")
"""What is kept too of films at rest on the grid: bounds of what its cells do."""


def kept_of(options: Journal, at_rest: bool = False) -> dict[str, tuple[str, str]]:
    """What is kept of every sample of a scene's bearing, in time or `at_rest`."""
    more = ELASTIC if options.shell is not None else {}
    more = more | (CONTACT if options.contact is not None else {})
    more = more | (GROWN if getattr(options.heat, "growth", None) is not None else {})
    if at_rest and options.film_model.rung == "grid":
        more = more | RESOLVED
    return KEPT | more | (WARM if options.heat is not None else {})
