"""What the library can be told a scene can be told, too; what it cannot is listed, with why."""

import importlib
import inspect
import typing
from dataclasses import fields, is_dataclass

import pytest

from loadflow.journal.cavitation import LAWS
from loadflow.rolling import FrictionOptions
from loadflow.rotor import RotorOptions
from loadflow.scene.friction import Friction
from loadflow.scene.loads import Loads
from loadflow.scene.scene import Scene
from loadflow.wind import WindOptions

ROOMS = (
    *("wind", "rotor", "turbines", "readers", "shaft", "seeds", "reduction"),
    *("tribology", "journal", "rolling"),
)

FOUND = {
    "journal": "BestCrown ConicalResult DoubleThrustResult EnergyBalance Equilibrium FieldError "
    "FilmField FilmHeatEquilibrium FilmHeatField GridError PadError PadResult "
    "PairResult ThrustResult WarmEquilibrium WarmFilm WarmThrustResult Wear",
    "rolling": "BallBearingResult BearingLife BoltLoads EdgeContact ExpansionResult FlexibleResult "
    "LifeModification LineContact PointContact RollerResult RollingEquilibrium SlewingResult "
    "SpectrumLife SpinningResult ThreeRowResult Transient Verdict",
    "tribology": "FlowFactors ShaftImprint WornArc",
    "wind": "Box Condition Field LoadCase",
    "seeds": "AveragedSpectrum Equivalence Grouping JointEquality ProbabilityPaper RankTest "
    "SeedEquality SeedsNeeded SpectralDifference Stage",
    "reduction": "ClosingPeriod ExtremeValue FrequencyBounds Harmonic LoadDuration "
    "LongTermExtreme MarkovMatrix PeriodicLoad Phase Rainflow Reduced StationaryLoad "
    "StationaryLoads Tail",
}
"""What the rooms answer with: nobody states it."""

BUILT = {
    "journal": "Control Cycle DoubleThrustBearing Film JournalGeometry WornBearing",
    "rolling": "CompliantRing FiniteElementRing FlexibleRings FrictionOptions Inertia Lubrication "
    "RingProfile RingSections SolidRing",
    "shaft": "CoupledBearing Disc LineSupport Seated ShaftLine",
    "tribology": "ConformalWear FrictionPair",
    "rotor": "RotorOptions",
    "wind": "Machine PointGrid PolarGrid WindOptions",
    "turbines": "Airfoil Blade Control Drivetrain Mode RotorGeometry Supervision Tower "
    "TowerBending Turbine",
    "readers": "Reader",
}
"""What stages build of the keys of a scene, of the turbine's file or of a load file."""

LIBRARY_ONLY = {
    "RectangularThrustBearing": "the plane slider of the literature, no bearing of a rotor shaft",
    "UnitBearing": "the dimensionless film, for studies of the Sommerfeld number",
    "ConductingCouette": "closed form of a warm film, a reference",
}
"""What only Python reaches, and why."""


def stated(annotation, found):
    """All classes of the package that an annotation names, at any depth."""
    annotation = getattr(annotation, "__value__", annotation)
    for part in typing.get_args(annotation):
        stated(part, found)
    ours = inspect.isclass(annotation) and annotation.__module__.startswith("loadflow")
    if ours and annotation not in found:
        found.add(annotation)
        for hint in typing.get_type_hints(annotation, include_extras=True).values():
            stated(hint, found)
    return found


@pytest.mark.parametrize("name", ROOMS)
def test_every_public_class_is_stated_built_found_or_listed(name):
    room = importlib.import_module(f"loadflow.{name}")
    public = {one for one in dir(room) if is_dataclass(getattr(room, one))}
    known = stated(Scene, set()) | set(LAWS.values())
    in_scenes = {one for one in public if getattr(room, one) in known}
    told = [set(table.get(name, "").split()) for table in (FOUND, BUILT)]
    library = public & set(LIBRARY_ONLY)
    assert public - in_scenes - library == set.union(*told)
    assert not told[0] & told[1]
    assert not library & in_scenes, "a scene reaches it now: take it off the list"


ROTOR = {
    **dict.fromkeys(
        ("modes", "tabulated", "tower_motion", "drivetrain_torsion"), "`loads.rung` chooses it"
    ),
    "air_density": "`environment.air_density`",
    **dict.fromkeys(
        ("skew_factor", "drag_in_induction", "shed_wake", "tower_dam"),
        "constants of the methods, set for comparisons with other codes",
    ),
}
WIND = {
    **dict.fromkeys(("radii", "angles"), "`loads.wind_grid` chooses them"),
    "speed_step": "`loads.wind_speeds` lists the bins",
}
FRICTION = {
    "oil": "`friction.lubricant`",
    "film": "the formula of the film, set for comparisons with other methods",
}


@pytest.mark.parametrize(
    ("options", "section", "elsewhere"),
    [
        (RotorOptions, Loads, ROTOR),
        (WindOptions, Loads, WIND),
        (FrictionOptions, Friction, FRICTION),
    ],
)
def test_every_option_is_a_key_or_chosen_elsewhere(options, section, elsewhere):
    names = {one.name for one in fields(options)}
    assert names - set(section.model_fields) == set(elsewhere)
