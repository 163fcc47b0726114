"""Loads and films of a scene, estimated before anything is solved: the basis of indicators.

For simulated loads these are closed forms: thrust after [Frandsen 2007], c_T = 7/V; the rotor's
weight; moments that swing with the turbulence, three standard deviations either way. A rotor that
is parked stands, one that idles turns as slowly as its feathered blades have it, and the wind finds
little hold on either. Given series are read. Films of journal bearings are those of the closed
charts of ISO 7902, those of thrust collars are solved on few cells.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import LoadflowError
from loadflow.journal import DoubleThrustBearing, DoubleThrustResult
from loadflow.journal import Film as PadFilm
from loadflow.scene.cases import Case, wind_of
from loadflow.scene.scene import Scene
from loadflow.shaft import Beam, bearing_loads, pitch_loads, yaw_loads
from loadflow.shaft.beam import ShaftSection
from loadflow.stages.effects.chart_films import charted
from loadflow.stages.effects.shared_loads import fed_back, held
from loadflow.stages.films.turning import SLOWEST, is_parked
from loadflow.stages.frames import to_film, to_rolling
from loadflow.stages.swinging import root_loads
from loadflow.turbines import Turbine, load_turbine
from loadflow.wind.cases import STANDING, event_of

Floats = np.ndarray

SWING = 0.045
"""Standard deviation of the hub's tilt and yaw moment over ρ A R V σ_u; NREL 5 MW, 12 m/s."""

SURGE = 0.5
"""Standard deviation of the thrust over its mean, over that of the wind at a point; NREL 5 MW."""

HOLLOW = 0.9
"""Bore over diameter of a shaft as wide as the bearing, where no beam is stated."""

FEW = (12, 6)
"""Cells of a pad: the film is within 1 % of that of the finest grid."""

TIP_SPEED_RATIO = 7.5
IDLING = 0.6
"""Share of the radius whose section sees no lift as the rotor idles, so that its speed is
V/(share R tan(pitch)): within a fifth of series of the NREL 5 MW and the IEA 15 MW turbine at 2 to
34 m/s."""
FEATHERED_THRUST = 0.0015
"""Thrust coefficient of a rotor with feathered blades; NREL 5 MW, idling at 34 and parked at 50
m/s."""
FEATHERED_SWING = 1.0 / 12.0
"""`SWING` of a rotor with feathered blades over that of one that runs; NREL 5 MW, 8 to 50 m/s."""
AIR_DENSITY = 1.225  # kg/m³
GRAVITY = 9.80665  # m/s²
DEVIATIONS = 3.0
GUST = 0.15
"""Turbulence that stands for a gust, or for a wind that is given."""
SAMPLES = 200
"""Samples that are taken of a given series."""


@dataclass(frozen=True)
class BearingLoad:
    """Load of a bearing at each of the points.

    Attributes
    ----------
    force, moment : ndarray, shape (n, 3)
        Mean, in the frame of the cube; N, N m.
    swing, turn : ndarray, shape (n,)
        Largest deviation of radial force and tilting moment from their mean; N, N m.
    surge : ndarray, shape (n,)
        Largest deviation of the force along the shaft from its mean, N.
    slope : ndarray, shape (n,)
        Largest slope of the bent shaft, rad, in a thrust collar or a film that it may tilt in; 0
        elsewhere.
    held : ndarray, shape (n,)
        Largest radial force with bearings that are rigid where they take a moment, over that with
        bearings that take none, less 1; 0 where the suspension is statically determinate.
    fed_back : ndarray, shape (n,)
        The same over that of a shaft on its own bearings, where their stiffness is fed back to it.
    """

    force: Floats
    moment: Floats
    swing: Floats
    turn: Floats
    surge: Floats
    slope: Floats
    held: Floats
    fed_back: Floats

    @property
    def radial(self) -> Floats:
        """Mean radial force (n,), N."""
        return np.asarray(np.hypot(self.force[:, 1], self.force[:, 2]))


@dataclass(frozen=True)
class Film:
    """Film of a journal bearing at each of the points (n,), by closed charts.

    Where no point turns, the shaft rests on its shell: the gap is that at which surfaces touch, the
    load is spread as a cosine over half of the bore, and nothing flows or rubs. Beside points that
    turn, those that stand have no film (NaN), and nothing is told of them.
    """

    eccentricity_ratio: Floats
    minimum_film: Floats
    maximum_pressure: Floats
    friction_power: Floats
    side_flow: Floats

    def warming(self, carried: float | Floats) -> Floats:
        """Rise of its temperature, K, by `carried` J/(m³ K); none where it stands."""
        rubs = self.friction_power > 0.0
        flow = carried * np.where(rubs, self.side_flow, 1.0)
        return np.asarray(np.where(rubs, self.friction_power, 0.0) / flow)


@dataclass(frozen=True)
class Situation:
    """Loads of a scene at a few points: of wind speeds and states of the rotor, or given series.

    Attributes
    ----------
    scene : Scene
        Whose loads these are.
    wind_speed, turbulence : ndarray, shape (n,)
        m/s; standard deviation over the mean.
    speed : ndarray, shape (n,)
        Of the rotor, rad/s; 0 of one that is parked.
    bearings : dict
        Loads of each bearing of the shaft.
    thrust_coefficient : ndarray, shape (n,)
        Of the rotor in the mean wind.
    """

    scene: Scene
    wind_speed: Floats
    turbulence: Floats
    speed: Floats
    bearings: dict[str, BearingLoad]
    thrust_coefficient: Floats

    @property
    def turns(self) -> NDArray[np.bool_]:
        """Whether the rotor turns, (n,)."""
        return np.asarray(self.speed != 0.0)

    @cached_property
    def turbine(self) -> Turbine:
        """The scene's turbine."""
        return load_turbine(self.scene.turbine.name)

    @cached_property
    def films(self) -> dict[str, Film]:
        """Films under the largest load, by bearing; those of a cylinder, whatever the bore."""
        return {name: self.film(name) for name in self.scene.journal.bearings}

    @cached_property
    def collars(self) -> dict[str, list[DoubleThrustResult | None]]:
        """Films of the thrust collars under their largest load, by place and point.

        None where no film carries it.
        """
        return {
            name: [self._collar(name, k) for k in range(self.speed.size)]
            for name in self.scene.thrust.collars
        }

    def _collar(self, name: str, point: int) -> DoubleThrustResult | None:
        few = self.scene.thrust.collars[name].on_cells(FEW).cool()
        load = self.bearings[name]
        force = to_rolling(load.force[point])
        force[2] += np.copysign(load.surge[point], force[2])
        return _carried(few.bearing, few.film_model, float(force[2]), float(self.speed[point]))

    def film(self, name: str, share: float = 1.0, thinner: Floats | float = 1.0) -> Film:
        """Film of a bearing under its mean load and a share of the largest deviation from it.

        With `thinner` its oil has that share of the viscosity with which it enters; (n,) or one.
        """
        journal, load = self.scene.journal.at(name), self.bearings[name]
        radial = load.radial + share * load.swing
        if not self.turns.any():
            return self._resting(name, radial)
        # charts know the load over the viscosity: a thinner oil is as a larger load
        radial, chart = (radial / thinner)[self.turns], charted(journal)
        force = np.stack([radial, np.zeros_like(radial)], axis=-1)
        film = chart.equilibrium(force, self.speed[self.turns])
        columns = {name: np.full(self.speed.shape, np.nan) for name in Film.__dataclass_fields__}
        for one, values in columns.items():
            values[self.turns] = getattr(film, one)
        columns["friction_power"] *= thinner / chart.share
        columns["maximum_pressure"] *= thinner
        columns["maximum_pressure"] += journal.edge_pressure  # that of charts is above it
        return Film(**columns)

    def _resting(self, name: str, radial: Floats) -> Film:
        """What a shaft rests on that stands at all points."""
        own = self.scene.journal.at(name)
        size = own.geometry
        gap, nothing = np.full(radial.shape, own.contact_film), np.zeros(radial.shape)
        pressed = own.edge_pressure + 4.0 / np.pi * radial / (size.diameter * size.width)
        return Film(1.0 - gap / size.clearance, gap, pressed, nothing, nothing.copy())


@lru_cache(maxsize=256)
def _carried(
    collar: DoubleThrustBearing, film: PadFilm, force: float, speed: float
) -> DoubleThrustResult | None:
    """Film of a collar under a force; a plan, its pilot and its refined self all ask for it."""
    try:
        return collar.equilibrium(force, speed, film)
    except LoadflowError:
        return None


def situation(scene: Scene, cases: Iterable[Case]) -> Situation:
    """Estimate the loads of the cases.

    Parameters
    ----------
    scene : Scene
        What is wanted.
    cases : iterable of Case
        Its load cases; those of `points` count, of given series the middle one.
    """
    found = points(cases)
    if scene.loads.source == "files":
        return _of_series(scene, found[len(found) // 2])
    return _of_wind(scene, found)


def points(cases: Iterable[Case]) -> list[Case]:
    """Return the first case of each wind speed and state of the rotor, by wind speed."""
    first = {(case.wind_speed, _state(case)): case for case in reversed([*cases])}
    return [first[place] for place in sorted(first)]


def _state(case: Case) -> str:
    """What the rotor does throughout: it is parked, has a blade stuck besides, idles; or none."""
    event = event_of(case.dlc)
    return event if event in STANDING else ""


def _of_wind(scene: Scene, cases: list[Case]) -> Situation:
    turbine = load_turbine(scene.turbine.name)
    wind = np.array([case.wind_speed for case in cases])
    turbulence = np.array([_turbulence(scene, case) for case in cases])
    rotor, control = turbine.rotor, turbine.control
    parked, idles = (
        np.array([of(case) for case in cases])
        for of in (is_parked, lambda case: _state(case) == "idling")
    )
    feathered = idles | np.array([_state(case) == "parked" for case in cases])
    rated = control.rated_speed / turbine.drivetrain.gear_ratio
    pitch = turbine.supervision.idling_pitch
    slow = wind / (IDLING * rotor.radius * np.tan(pitch))
    least = control.region_15_start / turbine.drivetrain.gear_ratio
    runs = np.maximum(TIP_SPEED_RATIO * wind / rotor.radius, least)
    speed = np.minimum(np.where(idles, slow, runs), rated)
    speed = np.where(parked, 0.0, speed)
    area = np.pi * rotor.radius**2
    coefficient = np.where(feathered, FEATHERED_THRUST, np.minimum(0.8, 7.0 / wind))
    thrust = 0.5 * AIR_DENSITY * area * wind**2 * coefficient
    deviation = SWING * AIR_DENSITY * area * rotor.radius * wind**2 * turbulence
    deviation = deviation * np.where(feathered, FEATHERED_SWING, 1.0)
    parts = [
        _on_bearings(
            scene,
            rotor.tilt,
            *_hub(force, turbine.rotor_mass, swing),
            turning,
            root=_root(turbine, force, swing, turning),
        )
        for force, swing, turning in zip(thrust, DEVIATIONS * deviation, speed)
    ]
    bearings = {
        name: BearingLoad(*(np.stack(values) for values in zip(*(part[name] for part in parts))))
        for name in parts[0]
    }
    bearings = {
        name: replace(load, surge=DEVIATIONS * SURGE * turbulence * np.abs(load.force[:, 0]))
        for name, load in bearings.items()
    }
    return Situation(scene, wind, turbulence, speed, bearings, coefficient)


def _turbulence(scene: Scene, case: Case) -> float:
    """Standard deviation of the wind over its mean; that of a gust where there is no turbulence."""
    return (wind_of(scene, case).sigma if not case.wind else 0.0) / case.wind_speed or GUST


def _hub(thrust: float, mass: float, swing: float) -> tuple[Floats, Floats]:
    """Hub loads (3, 5): their mean, then with tilt and yaw moment either way."""
    force = np.tile([[thrust], [0.0], [-mass * GRAVITY]], (1, 5))
    moment = np.zeros((3, 5))
    moment[1, 1:3] = moment[2, 3:5] = swing, -swing
    return force, moment


def _root(turbine: Turbine, thrust: float, swing: float, speed: float) -> tuple[Floats, Floats]:
    """Loads (3, 5) of a blade at its root: their mean, with its weight and turbulence either way.

    Thrust acts at two thirds of the radius; the tilting moment of a rotor is that of one and a half
    blades.
    """
    rotor, blade = turbine.rotor, turbine.blade
    out = np.trapezoid(blade.span * blade.mass_density, blade.span) / blade.mass
    flap, weight = thrust / rotor.blades, blade.mass * GRAVITY
    mean = np.array([blade.mass * speed**2 * (rotor.hub_radius + out), flap, 0.0])
    force, moment = np.tile(mean[:, None], (1, 5)), np.zeros((3, 5))
    force[2, 1:3] = weight, -weight
    moment[1, 1:3] = -weight * out, weight * out
    moment[2] = flap * (2 / 3 * rotor.radius - rotor.hub_radius)
    moment[2, 3:5] += np.array([swing, -swing]) / 1.5
    return force, moment


def _on_bearings(
    scene: Scene,
    tilt: float,
    force: Floats,
    moment: Floats,
    speed: float,
    root: tuple[Floats, Floats] | None = None,
) -> dict[str, tuple[Floats, ...]]:
    """Mean force, mean moment and their largest deviations, by bearing of a rigid shaft."""
    found = {}
    slopes, stiff = (of(scene, tilt, force, moment) for of in (_slopes, held))
    own = fed_back(scene, tilt, force, moment, speed)
    every = [
        bearing_loads(replace(concept, beam=None), force, moment, tilt=tilt)
        for concept in scene.shaft.concepts
    ]
    if scene.shaft.yaw is not None:
        every.append(yaw_loads(scene.shaft.yaw, force, moment, tilt=tilt))
    if scene.shaft.pitch is not None and root is not None:
        every.append(pitch_loads(scene.shaft.pitch, *root))
    for loads in every:
        for name in loads["bearing"].values:
            one = loads.sel(bearing=name)
            push, turn = (one[n].transpose(..., "axis").values for n in ("force", "moment"))
            away = (np.hypot(*to_film(v - v[0]).T).max() for v in (push, turn))
            along = np.abs(push[:, 0] - push[0, 0]).max()
            more = (of.get(str(name), 0.0) for of in (slopes, stiff, own))
            found[str(name)] = push[0], turn[0], *map(np.asarray, (*away, along, *more))
    return found


def _slopes(scene: Scene, tilt: float, force: Floats, moment: Floats) -> dict[str, float]:
    """Largest slope of the bent shaft, rad, in each thrust collar and journal bearing.

    Its bearings are rigid, and let it tilt. Where no beam is stated, it is as wide as the journal
    or the bore of the pads.
    """
    collars, journal = scene.thrust.collars, scene.journal
    widths = {name: 2.0 * collar.geometry.inner_radius for name, collar in collars.items()}
    widths |= {name: journal.at(name).geometry.diameter for name in journal.bearings}
    found: dict[str, float] = {}
    for concept in scene.shaft.concepts:
        bent: dict[Beam, xr.DataArray] = {}
        for name in set(concept.bearings) & {*widths}:
            beam = concept.beam or Beam((ShaftSection(widths[name], HOLLOW * widths[name]),))
            if beam not in bent:
                one = replace(concept, beam=beam.free_in_films().on_rigid_bearings())
                bent[beam] = bearing_loads(one, force, moment, tilt=tilt)["tilt"]
            slope = to_film(bent[beam].sel(bearing=name).transpose(..., "axis").values)
            found[name] = float(np.hypot(*slope.T).max())
    return found


def _of_series(scene: Scene, case: Case) -> Situation:
    """Loads of a given series."""
    from loadflow.stages.loads import hub_loads

    series = hub_loads(scene, case, {})
    some = np.unique(np.linspace(0, series.sizes["time"] - 1, SAMPLES).astype(int))

    def with_mean(load: Floats) -> Floats:
        return np.concatenate([load[:, some].mean(axis=1, keepdims=True), load[:, some]], axis=1)

    force, moment = (
        with_mean(series[name].transpose("axis", "time").values.astype(float))
        for name in ("hub_force", "hub_moment")
    )
    root = None
    if scene.shaft.pitch is not None:
        at_root = root_loads(series)
        root = with_mean(at_root[0]), with_mean(at_root[1])
    tilt = load_turbine(scene.turbine.name).rotor.tilt
    mean = float(np.abs(series["speed"]).mean())
    speed = 0.0 if is_parked(case) or mean < SLOWEST else mean
    parts = _on_bearings(scene, tilt, force, moment, speed, root)
    bearings = {name: BearingLoad(*(v[None] for v in part)) for name, part in parts.items()}
    wind = np.array([case.wind_speed])
    thrust = np.minimum(0.8, 7.0 / np.maximum(wind, 1e-3))
    return Situation(scene, wind, np.array([GUST]), np.array([speed]), bearings, thrust)
