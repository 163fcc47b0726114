"""What centrifugal force and gyroscopic moment of the balls change, over wind speed and turbine.

Run with ``python -m benchmarks.references.ball_inertia [--json]``. Four-point bearings do not count
inertia: balls, pitch circle and contact angle are those of the one sized for each turbine, in two
rows of an angular contact bearing, under the estimated mean load and half of its largest swing.
"""

from __future__ import annotations

from benchmarks.common import arguments, show
from loadflow.rolling import BallBearing
from loadflow.scene.candidates import machine_names
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages.effects.situation import situation
from loadflow.stages.frames import to_rolling

WIND_SPEEDS = (4.0, 8.0, 12.0, 18.0, 24.0)
SWING = 0.5  # of the largest tilting moment beside its mean


def change(turbine: str, wind_speed: float) -> dict[str, float | str]:
    """Change of largest force, pressure and rating life by inertia, shares."""
    scene = make_scene(
        {
            "name": "inertia", "turbine": {"name": turbine}, "bearings": "four-point",
            "shaft": {"moment": {}}, "results": ["rolling.life"],
            "loads": {"wind_speeds": [wind_speed], "seeds": 1, "duration": 60.0},
        }
    )  # fmt: skip
    at, sized = situation(scene, list_cases(scene)), scene.rolling.geometry
    names = "balls", "ball_diameter", "pitch_diameter", "groove_radius", "contact_angle"
    sizes = {name: getattr(sized, name) for name in (*names, "row_spacing")}
    bearing, load, speed = BallBearing(**sizes, rows=2), at.bearings["M"], float(at.speed[0])
    force, moment = to_rolling(load.force[0]), to_rolling(load.moment[0])[:2]
    moment[0] += SWING * load.turn[0]
    still, turning = (bearing.equilibrium(force, moment, speed=omega) for omega in (0.0, speed))
    told = {"maximum_force": "force", "maximum_pressure": "pressure", "rating_life": "life"}
    return {"what": f"{turbine}, {wind_speed:g} m/s", "speed": speed} | {
        name: float(getattr(turning, key) / getattr(still, key)) - 1 for key, name in told.items()
    }


def main() -> None:
    """Print the changes."""
    parser = arguments(__doc__)
    parser.add_argument("--json", action="store_true", help="print JSON")
    as_json = parser.parse_args().json
    show([change(turbine, wind) for turbine in machine_names() for wind in WIND_SPEEDS], as_json)


if __name__ == "__main__":
    main()
