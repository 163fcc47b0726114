"""The examples in all docstrings are true, and public names without one only become fewer."""

import ast
import doctest
import inspect
from importlib import import_module
from pathlib import Path

import pytest

import loadflow

ROOT = Path(loadflow.__file__).parent


def module_name(path):
    parts = path.relative_to(ROOT.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def with_examples():
    """Modules in whose text an example stands."""
    paths = sorted(ROOT.rglob("*.py"))
    return [module_name(path) for path in paths if ">>>" in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("name", with_examples())
def test_the_examples_of_a_module_are_true(name):
    outcome = doctest.testmod(import_module(name))
    assert outcome.attempted > 0
    assert outcome.failed == 0


def test_an_example_that_is_wrong_is_seen():
    """The runner must be able to fail: a sum that is not so."""
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, 0)
    assert doctest.DocTestRunner(verbose=False).run(wrong, out=lambda text: None).failed == 1


def public():
    """Functions and classes that rooms offer by name: those of the stubs of lazy loading."""
    for stub in sorted(ROOT.rglob("__init__.pyi")):
        room = module_name(stub)
        for node in ast.parse(stub.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    entry = getattr(import_module(room), alias.name)
                    if inspect.isfunction(entry) or inspect.isclass(entry):
                        yield (
                            f"{entry.__module__.removeprefix('loadflow.')}.{entry.__name__}",
                            entry,
                        )


def without_example():
    return {name for name, entry in public() if ">>>" not in (inspect.getdoc(entry) or "")}


def test_a_new_public_name_has_an_example():
    assert without_example() - WITHOUT == set()


def test_the_list_of_names_without_an_example_only_becomes_shorter():
    assert WITHOUT - without_example() == set(), "take these out of the list"


WITHOUT: set[str] = {
    "cube.checks.check_case",
    "cube.export.export_cube",
    "cube.files.open_cube",
    "cube.schema.Variable",
    "journal.aliases.WarmFilm",
    "journal.aliases.warm_equilibrium",
    "journal.grid_error.GridError",
    "journal.pad_results.ConicalResult",
    "journal.pad_results.PadResult",
    "journal.pad_results.PairResult",
    "journal.pad_results.ThrustResult",
    "journal.results.WarmEquilibrium",
    "readers.bladed.read_bladed",
    "readers.csv_text.read_csv",
    "readers.doubts.find_doubts",
    "readers.gtsdf.read_gtsdf",
    "readers.hawc2.read_hawc2",
    "readers.loads.read_loads",
    "readers.openfast.read_openfast",
    "readers.registry.Reader",
    "report.page.Picture",
    "report.page.Section",
    "report.page.Table",
    "report.page.write_page",
    "rolling.bearings.arrangements.BearingLife",
    "rolling.bearings.arrangements.SpectrumLife",
    "rolling.bearings.arrangements.arrangement_lives",
    "rolling.bearings.arrangements.modified_spectrum_life",
    "rolling.bearings.base.RollingBearing",
    "rolling.edge_contact.EdgeContact",
    "rolling.former_names.bearing_modification",
    "rolling.former_names.static_capacity",
    "rolling.friction.bearing.BearingFriction",
    "rolling.friction.catalogue.SkfConstants",
    "rolling.friction.catalogue.skf_torque",
    "rolling.friction.contact_films.ContactFilm",
    "rolling.friction.contact_films.groove_film",
    "rolling.friction.contact_films.line_film",
    "rolling.friction.contact_films.sphere_film",
    "rolling.friction.energy.EnergyAudit",
    "rolling.friction.energy.RollerState",
    "rolling.friction.energy.roller_torques",
    "rolling.friction.heat.HeatBalance",
    "rolling.friction.heat.balanced_temperature",
    "rolling.friction.roller_drag.DragConstants",
    "rolling.friction.roller_drag.RibShear",
    "rolling.friction.roller_drag.RollerGaps",
    "rolling.friction.roller_drag.coulomb_drag_constants",
    "rolling.friction.roller_drag.drag_constants",
    "rolling.friction.roller_drag.rib_shear",
    "rolling.friction.rolling_resistance.elastic_force",
    "rolling.friction.rolling_resistance.hydrodynamic_force",
    "rolling.rating.modified_life.LifeModification",
    "rolling.rating.static.verdicts",
    "rolling.rings.beam.RingBeam",
    "rolling.rings.condensed.FlexibleRings",
    "rolling.rings.dynamics.craig_bampton",
    "rolling.rings.dynamics.natural_frequencies",
    "rolling.rings.expansion.ExpansionResult",
    "rolling.rings.expansion.RingSections",
    "rolling.rings.expansion.axial_expansion",
    "rolling.rings.finite_element.FiniteElementRing",
    "rolling.rings.given.CompliantRing",
    "rolling.rings.given.guyan",
    "rolling.rings.patches.patch_points",
    "rolling.rings.patches.raceway_points",
    "rolling.rings.profile.RingProfile",
    "rolling.rings.reference.reference_equilibrium",
    "rolling.rings.section.RingSection",
    "rolling.rings.section.Support",
    "rolling.rings.section.legs",
    "rolling.rings.solid.SolidRing",
    "rolling.rings.transient.Inertia",
    "rolling.rings.transient.Transient",
    "rolling.rings.transient.settle",
    "rotor.options.RotorOptions",
    "rotor.simulation.simulate_condition",
    "running.runner.run",
    "scene.cases.Case",
    "scene.journal.Journal",
    "scene.scene.Scene",
    "scene.scene.with_loads",
    "seeds.grouping.Grouping",
    "seeds.joint.JointEquality",
    "seeds.spectra.SpectralDifference",
    "seeds.sufficiency.Equivalence",
    "seeds.verdict.Stage",
    "shaft.coupled.CoupledBearing",
    "shaft.coupled.coupled_loads",
    "tribology.hertz.LineContact",
    "tribology.hertz.PointContact",
    "tribology.wear.WearLaw",
    "turbines.schema.Airfoil",
    "turbines.schema.Blade",
    "turbines.schema.Control",
    "turbines.schema.Drivetrain",
    "turbines.schema.Mode",
    "turbines.schema.RotorGeometry",
    "turbines.schema.Supervision",
    "turbines.schema.Turbine",
    "turbines.tower.Tower",
    "turbines.tower.TowerBending",
    "wind.bladed_box.read_bladed_box",
    "wind.box.Box",
    "wind.bts.read_bts",
    "wind.bts.write_bts",
    "wind.coherence.PointGrid",
    "wind.coherence.PolarGrid",
    "wind.expansion.Condition",
    "wind.field.Field",
    "wind.hawc2_box.read_hawc2_box",
    "wind.inflow.coherence_factors",
    "wind.inflow.inflow",
    "wind.inflow.transient",
    "wind.mann.mann_box",
}
"""Known ones. Take out what gets an example; add none."""
