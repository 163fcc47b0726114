"""Scenes that the walks over all keys go through, with the sections or tables whose keys they walk.

Every class that a scene can hold stands in one of them (`test_every_key.py` checks it); small and
cheap ones do, as each key costs a solution. Words in capitals are files that `files` writes.
"""

import numpy as np
from synthetic import cube_file

WIND = {"wind_speeds": [12.0, 14.0], "duration": 3.0, "step": 0.1, "wind_grid": [3, 8]}
BALLS = {"balls": 60, "rows": 1, "ball_diameter": 0.06, "pitch_diameter": 2.0,
         "groove_radius": 0.0312, "contact_angle": 0.8, "shoulder_angle": 1.2}  # fmt: skip
TAPERED = {"kind": "roller", "rollers": 20, "slices": 6, "roller_diameter": 0.07,
           "roller_length": 0.12, "pitch_diameter": 1.2, "rows": 2, "row_spacing": 0.25,
           "contact_angle": 0.35, "clearance": -5e-5}  # fmt: skip
BARRELS = {"kind": "spherical", "rollers": 20, "slices": 6, "roller_diameter": 0.07,
           "roller_length": 0.12, "pitch_diameter": 1.2, "contact_angle": 0.2}  # fmt: skip
FILM = {"grid": [16, 6], "bearings": ["N"]}
FEW = {"size": 0.03, "classes": 2}  # samples; some touch, some have a film

BASES = {
    "turbulence": {"loads": WIND | {"seeds": 1, "rung": "flap"}},
    "gust": {"loads": WIND | {"dlc": "1.5", "rung": "flap"}},
    "tables": {"loads": WIND | {"seeds": 1, "rung": "tables"}},
    "stop": {"loads": WIND | {"dlc": "4.1", "rung": "tables"}},
    "parked": {
        "loads": {"dlc": "6.1", "seeds": 1, "duration": 3.0, "step": 0.1, "wind_grid": [3, 8]},
    },
    "class S": {
        "loads": WIND | {"seeds": 1, "rung": "tables", "wind_class": "S", "v_ref": 45.0,
                         "v_ave": 9.0, "category": "S", "reference_intensity": 0.15},
    },
    "files": {"loads": {"source": "files", "files": ["CUBE"]}},
    "bearings": {
        "shaft": {"two_point": {}, "moment": {}},
        "journal": FILM | {"supply": {"grooves": [{"angle": 1.57, "arc": 0.2, "length": 1.5,
                                                   "pressure": 6e5}]}},
        "rolling": {"bearing": "M", "geometry": BALLS}, "reduction": FEW,
    },
    "warm film": {"journal": FILM | {"heat": {"transfer": 100.0}}, "reduction": FEW},
    "cold": {
        "loads": WIND | {"seeds": 1, "rung": "tables"}, "environment": {"temperature": 263.15},
        "journal": FILM | {"heat": {"transfer": 100.0}}, "reduction": FEW,
        "results": ["journal.film", "rolling.friction"],
    },
    "rough film": {
        "journal": FILM | {"contact": {"pattern": 3.0, "asperities": {
            "roughness": 1e-6, "contact_modulus": 1e11, "factor": 1e-3}}},
        "reduction": FEW,
    },
    "elastic film": {
        "journal": FILM | {"shell": {"kind": "local", "compliance": 1e-12}}, "reduction": FEW,
    },
    "turbulent film": {
        "journal": FILM | {"turbulence": {"begin": 0.002, "end": 0.1}}, "reduction": FEW,
    },
    "film in motion": {
        "journal": FILM | {"motion": "transient", "rung": "reduced"},
        "results": ["journal.film"],
    },
    "periodic loads": {
        "journal": FILM, "reduction": {"method": "periodic", "bounds": [0.05, 0.3]},
    },
    "periodic loads, tilted": {
        "journal": FILM | {"tilt": True, "rung": "reduced"}, "shaft": {"two_point": {"beam": {}}},
        "reduction": {"method": "periodic", "bounds": [0.05, 0.3]}, "results": ["journal.film"],
    },
    "stationary loads": {"journal": FILM, "reduction": {"method": "stationary"}},
    "tilted film": {
        "journal": FILM | {"tilt": True}, "shaft": {"two_point": {"beam": {}}}, "reduction": FEW,
    },
    "rotor dynamics": {"journal": FILM, "shaft": {"two_point": {"beam": {}}},
                       "dynamics": {"unbalance": 50.0}, "results": ["journal.dynamics"]},
    "rotor dynamics, rigid": {"journal": FILM, "shaft": {"two_point": {}},
                              "results": ["journal.dynamics"]},
    "rolling dynamics": {
        "shaft": {"two_point": {"beam": {"supports": [{}, {"takes_moment": True}]}}},
        "rolling": {"bearing": "N2", "geometry": TAPERED, "mounting": {
            "inner_share": 1.1}},
        "dynamics": {"unbalance": 50.0, "modes": 2}, "reduction": FEW,
        "results": ["rolling.dynamics"]},
    "rolling dynamics, dry": {
        "shaft": {"moment": {}}, "rolling": {"bearing": "M", "geometry": BALLS},
        "dynamics": {"contact_model": "dry"}, "results": ["rolling.dynamics"]},
    "rolling dynamics, proportional": {
        "shaft": {"two_point": {"beam": {}}}, "rolling": {"bearing": "N", "geometry": BARRELS},
        "dynamics": {"contact_model": "proportional"}, "results": ["rolling.dynamics"]},
    "rigid and tilted": {
        "journal": FILM | {"tilt": True}, "shaft": {"two_point": {}}, "reduction": FEW,
    },
    "worn bores": {
        "journal": FILM | {"grid": [12, 4], "contact": {"asperities": {
            "roughness": 2e-6, "contact_modulus": 1e11, "factor": 1e-3}}},
        "reduction": {"size": 0.1}, "results": ["journal.film", "journal.wear"],
        "wear": {"law": {"coefficient": 1e-13}, "events": 20.0, "samples": 10, "around": 36,
                 "running_in": {"initial_roughness": 2e-6, "final_roughness": 1.8e-6,
                                "depth": 1e-6}},
    },
    "tapered rollers": {
        "shaft": {"two_point": {}},
        "rolling": {"bearing": "N2", "geometry": {
            "kind": "roller", "rollers": 20, "slices": 6, "roller_diameter": 0.07,
            "roller_length": 0.12, "pitch_diameter": 1.2, "rows": 2, "row_spacing": 0.25,
            "contact_angle": 0.35,
            "clearance": -5e-5}, "rings": "flexible", "outer_ring": {
            "section": {"width": 0.1, "height": 0.3}, "radius": 0.7, "harmonics": 8}},
        "friction": {"conductance": 50.0}, "reduction": FEW,
    },
    "bolted ring": {
        "shaft": {"moment": {}}, "reduction": FEW,
        "rolling": {"bearing": "M", "geometry": BALLS, "rings": "flexible", "outer_ring": {
            "section": {"width": 0.1, "height": 0.12}, "radius": 1.06, "harmonics": 8,
            "supports": [{"radius": 1.08, "height": -0.06, "count": 72, "diameter": 0.03,
                          "pitch": 3.5e-3, "grip": 0.16}]}},
    },
    **{
        f"catalogue of {rollers}": {
            "shaft": {"two_point": {}}, "results": ["rolling.friction"],
            "rolling": {"bearing": "N2", "geometry": geometry, "catalogue": {
                "bore": 0.9, "outside_diameter": 1.5} | entry},
            "friction": {"lubricant": "mineral-vg-320"}, "reduction": FEW}
        for rollers, geometry, entry in (
            ("a series", TAPERED, {
                "series": "320 X", "axial_factor": 1.5, "oil_level": 0.2, "width": 0.15}),
            ("constants", TAPERED, {"constants": {
                "kind": "tapered", "r1": 2e-6, "r2": 11.0, "s1": 0.02, "s2": 2.0,
                "axial_factor": 1.5, "geometry": 6.0}}),
            ("barrels", BARRELS, {"constants": {
                "kind": "spherical", "r1": 2e-6, "r2": 5.0, "r3": 4e-6, "r4": 5.0, "s1": 4e-3,
                "s2": 500.0, "s3": 0.01, "s4": 100.0, "geometry": 5.5, "roller_geometry": 0.8},
                "oil_level": 0.2, "width": 0.3}),
        )
    },
    "catalogue of balls": {
        "shaft": {"moment": {}}, "results": ["rolling.friction"],
        "rolling": {"bearing": "M", "geometry": BALLS, "catalogue": {
            "bore": 1.8, "outside_diameter": 2.2, "oil_level": 0.2, "constants": {
                "kind": "four-point", "r1": 5e-7, "r2": 2.4, "r3": 1.4e-12, "s1": 0.012, "s2": 0.9,
                "s3": 1.4e-12, "geometry": 3.1}}},
        "friction": {"lubricant": "mineral-vg-320"}},
    "mounted rollers": {
        "environment": {"temperature": 263.15}, "shaft": {"two_point": {}},
        "rolling": {"bearing": "N2", "geometry": {
            "kind": "roller", "rollers": 20, "slices": 6, "roller_diameter": 0.07,
            "roller_length": 0.12, "pitch_diameter": 1.2, "rows": 2, "row_spacing": 0.25,
            "contact_angle": 0.35,
            "clearance": 1e-4}, "mounting": {
            "inner_share": 1.1, "bore": 1.0, "outside": 1.4, "inner_interference": 2e-4,
            "outer_interference": 1e-4, "shaft_bore": 0.5, "housing_outside": 2.0}},
        "reduction": FEW, "friction": {"cooling": {"N2": {"area": 2.5, "transfer": 20.0}}},
        "results": ["rolling.life"],
    },
    "mounted rollers, loose": {
        "loads": WIND | {"seeds": 1, "rung": "tables"},
        "environment": {"temperature": 263.15}, "shaft": {"two_point": {}},
        "rolling": {"bearing": "N2", "geometry": {
            "kind": "roller", "rollers": 20, "slices": 6, "roller_diameter": 0.07,
            "roller_length": 0.12, "pitch_diameter": 1.2, "rows": 2, "row_spacing": 0.25,
            "contact_angle": 0.35,
            "clearance": 1e-4}, "mounting": {"inner_temperature": 300.0, "outer_share": 1.1}},
        "reduction": FEW, "results": ["rolling.life"],
    },
    "thrust collar": {
        "shaft": {"two_point": {}}, "results": ["thrust.film"],
        "reduction": {"size": 0.02, "classes": 2},
        "thrust": {"grid": [12, 6], "bearings": {"N2": {"kind": "thrust", "geometry": {
            "pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7,
            "taper": 1e-4}}}},
    },
    "warm collar": {
        "shaft": {"two_point": {"beam": {"sections": [
            {"outer_diameter": 1.6, "inner_diameter": 0.8}]}}},
        "results": ["thrust.film"],
        "thrust": {"rung": "curve", "motion": "transient", "tilt": True, "grid": [8, 4],
                   "bearings": {"N2": {"kind": "thrust", "heat": {"oil": "iso-vg-220"},
            "geometry": {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7,
                         "taper": 1e-4}}}},
    },
    "pair of cones": {
        "shaft": {"moment": {}}, "results": ["thrust.film"],
        "reduction": {"size": 0.02, "classes": 2},
        "thrust": {"bearings": {"M": {"kind": "conical-pair", "grid": [8, 4],
            "lubricant": {"viscosity": 0.2}, "geometry": {"distance": 3.2, "left": {
                "half_angle": 0.5, "slant": [1.59, 2.59], "clearance": 2e-4, "pads": 3,
                "pad_angle": 1.9, "profile": {"kind": "taper", "taper": 8e-5}}}}}},
    },
    "bearings on seats": {
        "shaft": {"two_point": {"beam": {}}}, "results": ["journal.film", "thrust.film"],
        "bearings": {
            "N": {"kind": "journal", "self_aligning": True, "seat": {
                "kind": "spherical", "friction": 0.02, "radius": 1.9}},
            "N2": {"kind": "thrust", "self_aligning": True, "seat": {
                "kind": "elastic", "stiffness": 1e6}, "geometry": {
                "pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7,
                "taper": 1e-4}}},
    },
    "three points": {"shaft": {"three_point": {}}, "journal": FILM},
    "integrated": {"shaft": {"integrated": {}}, "journal": FILM},
    "yaw": {
        "shaft": {"two_point": {}, "yaw": {}}, "results": ["rolling.life"],
        "rolling": {"bearing": "Y", "geometry": BALLS, "oscillation": {
            "amplitude": 0.5, "frequency": 0.01, "idle_torque": 10.0}},
    },
    "pitch": {
        "shaft": {"two_point": {}, "pitch": {}}, "results": ["rolling.life"],
        "rolling": {"bearing": "P", "geometry": BALLS, "oscillation": {
            "kind": "pitch", "idle_torque": 10.0}},
    },
    "direct drive": {"shaft": {"direct_drive": {}}, "journal": FILM},
}  # fmt: skip

BASES["worn bores, deep"] = BASES["worn bores"] | {
    "journal": BASES["worn bores"]["journal"] | {"grid": [24, 8]}, "reduction": {"size": 0.5},
    "wear": BASES["worn bores"]["wear"] | {"events": 2e4, "samples": 12, "around": 90},
}  # fmt: skip
BASES["worn bores, events counted"] = BASES["worn bores"] | {
    "loads": {"dlc": ["1.2", "3.1"]}, "lifetime": {"per_year": {"3.1": 1.0}},
}  # fmt: skip

RIGID = {"shaft": {"two_point": {}}}
TWENTY_FOUR = BALLS | {"balls": 24}
ROLLER = {"rollers": 20, "roller_diameter": 0.05, "roller_length": 0.05, "pitch_diameter": 1.0,
          "slices": 6}  # fmt: skip
OIL = {"viscosities": [3e-4, 2.5e-5], "base": "pao"}
THIN = {"reference_viscosity": 0.05, "constant_steepness": 0.03}
GROOVES = [{"angle": 1.57, "arc": 0.3, "length": 1.5, "pressure": 6e5},
           {"angle": 4.71, "arc": 0.3, "length": 1.5, "pressure": 6e5}]  # fmt: skip
FED = [{"angle": 1.57, "arc": 0.3, "length": 1.5}, {"angle": 4.71, "arc": 0.3, "length": 1.5}]
COLLAR = {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7}


def rolling(place, kind, geometry, **more):
    """A scene of one rolling bearing."""
    part = {"bearing": place, "geometry": {"kind": kind} | geometry} | more
    shaft = {"moment": {}} if place == "M" else {"two_point": {}}
    return {"shaft": shaft, "rolling": part, "reduction": FEW, "results": ["rolling.life"]}


def film(**more):
    """A scene of one film, in four samples."""
    few = {"size": 0.01, "classes": 2}
    return RIGID | {"journal": FILM | more, "reduction": few, "results": ["journal.film"]}


def bore(shape, *relief):
    return {"geometry": {"diameter": 3.0, "width": 2.25, "relative_clearance": 5e-4,
                         "shape": shape, "relief": list(relief)}}  # fmt: skip


def collar(geometry, **more):
    """A scene of a thrust bearing."""
    one = {"kind": "thrust", "grid": [12, 6], "geometry": COLLAR | geometry} | more
    return RIGID | {"results": ["thrust.film"], "reduction": {"size": 0.02, "classes": 2},
                    "thrust": {"bearings": {"N2": one}}}  # fmt: skip


BASES |= {
    "balls in one row": rolling("N2", "ball", {
        "balls": 24, "pitch_diameter": 1.0, "ball_diameter": 0.08, "groove_radius": 0.0416,
        "contact_angle": 0.6, "shoulder_angle": 1.3}),
    "balls in two rows": rolling("N2", "ball", {
        "balls": 24, "pitch_diameter": 1.0, "ball_diameter": 0.08, "groove_radius": 0.0416,
        "contact_angle": 0.6, "rows": 2, "row_spacing": 0.2}),
    "rollers in one row": rolling("N", "roller", ROLLER),
    "barrels": rolling("N2", "spherical", ROLLER | {"contact_angle": 0.2}),
    "toroidal barrels": rolling("N", "toroidal", ROLLER | {"raceway_radius": 1.2, "shift": 0.01}),
    "crossed rollers": rolling("M", "crossed", ROLLER | {"rollers": 60, "roller_length": 0.045,
                                                         "pitch_diameter": 2.0}),
    "three rows": rolling("M", "three-row", {
        "support": ROLLER | {"rollers": 60, "pitch_diameter": 2.0},
        "retaining": ROLLER | {"rollers": 60, "pitch_diameter": 2.0},
        "radial": ROLLER | {"rollers": 60, "pitch_diameter": 2.0}, "axial_clearance": 2e-5}),
    "further bearing": rolling("N", "roller", ROLLER, further=[
        {"bearing": "N2", "geometry": {"kind": "spherical"} | ROLLER | {"contact_angle": 0.2},
         "limits": {"life": 1e5}}]),
    "ring on legs": rolling("M", "slewing", TWENTY_FOUR, rings="flexible", outer_ring={
        "section": {"width": 0.1, "height": 0.15}, "radius": 1.08, "harmonics": 8, "supports": [{
            "radius": 1.08, "height": -0.075, "radial": 1e10, "tangential": 1e10, "axial": 2e10,
            "tilt": 1e8, "sectors": [[0.3, 0.8], [3.4, 0.8]]}]}),
    "ring of a file": rolling("M", "slewing", TWENTY_FOUR, rings="flexible", outer_ring={
        "kind": "matrix", "file": "RING"}),
    "meshed ring": rolling("M", "slewing", TWENTY_FOUR, rings="flexible", outer_ring={
        "kind": "finite-element", "inside": 2.014, "outside": 2.25, "bottom": -0.08, "top": 0.08,
        "held": "bottom", "bed": 1e12, "grip": 1e12, "across": 2, "resolution": 2.0}),
    "beam on bearings": {
        "shaft": {"two_point": {"beam": {"supports": [
            {"radial": 5e9, "tilt": 1e9, "housing_lateral": 4e9, "housing_vertical": 6e9,
             "housing_tilt": 1e10, "takes_moment": True},
            {"stiffness": "journal", "housing_lateral": 4e9}]}}},
        "journal": FILM | {"bearings": ["N2"]}, "reduction": FEW, "results": ["journal.film"],
    },
    "beam on a frame": {
        "shaft": {"two_point": {"beam": {
            "frame": {"file": "FRAME", "form": "compliance"},
            "supports": [{"housing": {"file": "FOOT"}}, {}]}}},
        "results": ["loads.statistics"],
    },
    "heat over the film": film(grid=[12, 4], supply={"grooves": GROOVES}, heat={
        "kind": "film", "oil": OIL, "points": 3, "shell_transfer": 20.0, "shaft_transfer": 10.0,
        "growth": {"outer_diameter": 3.6, "held": True}}),
    "heat over the film, closed": film(grid=[12, 4], heat={
        "kind": "film", "oil": THIN, "growth": {"outer_diameter": 3.6}}),
    "heat and growth": film(heat={"oil": THIN, "growth": {"shell_share": 0.9}}),
    "heat of an oil": film(heat={"oil": OIL, "growth": {"shaft_temperature": 330.0}}),
    "heat of a sump": film(heat={"sump_transfer": 3000.0}),
    "heat in motion": RIGID | {
        "journal": FILM | {"motion": "transient", "rung": "reduced",
                           "heat": {"capacity": 1e7, "start_temperature": 310.0}},
        "results": ["journal.film"]},
    "two lobes": film(**bore({"kind": "lobes", "count": 2, "preload": 0.3})),
    "partial arc": film(**bore({"kind": "arc", "angle": 0.0, "span": 2.4})),
    "pads": film(grid=[12, 4], **bore({"kind": "tilting pads", "count": 4, "arc": 1.2,
                                       "preload": 0.2})),
    "reliefs": film(**bore(
        {"kind": "cylindrical"}, {"kind": "crown", "height": 2e-5, "length": 0.8},
        {"kind": "recess", "angle": 3.0, "arc": 0.8, "depth": 5e-5, "length": 1.0, "z": 0.1},
        {"kind": "contour", "angle": [0.0, 1.5, 3.0, 4.5], "z": [-1.0, 1.0],
         "height": [[0.0, 1e-6], [2e-5, 1e-5], [0.0, 0.0], [1e-5, 2e-5]]})),
    "recess across": film(**bore(
        {"kind": "cylindrical"}, {"kind": "recess", "angle": 3.0, "arc": 0.8, "depth": 5e-5},
        {"kind": "crown", "height": 2e-5})),
    "pump": film(grid=[12, 4], supply={"grooves": [FED[0] | {"restrictor": {"diameter": 0.01}},
                                     FED[1] | {"restrictor": {"diameter": 0.02, "length": 0.2}}],
                         "pump": {"flow": [0.0, 0.004], "pressure": [1.2e6, 8e5],
                                  "line": {"diameter": 0.03, "length": 2.0}}}),
    "flow in pockets": film(grid=[12, 4], supply={"grooves": [
        FED[0] | {"length": 0.6, "axial": 0.4, "restrictor": {"flow": 2e-4}}, GROOVES[1]]}),
    "lined shell": film(shell={"kind": "lined", "thickness": 0.005, "modulus": 2e9}),
    "thick shell": film(
        grid=[12, 4], shell={"kind": "thick", "outer_diameter": 3.4, "modulus": 2e10}),
    "shell of a matrix": film(grid=[12, 4], shell={"kind": "matrix", "matrix": "SHELL"}),
    "housing on feet": film(grid=[12, 4], shell={
        "kind": "housed", "outer_diameter": 3.4, "elements": [16, 1, 2], "length": 2.4,
        "modulus": 2e10, "shell_thickness": 0.05, "shell_modulus": 1e10,
        "support": {"kind": "feet", "height": 2.0, "width": 3.2, "length": 2.0}}),
    "housing on a flange": film(grid=[12, 4], shell={
        "kind": "housed", "outer_diameter": 3.4, "elements": [16, 1, 2], "modulus": 2e10,
        "support": {"kind": "flange", "bolt_circle": 4.4, "thickness": 0.15, "axial": 0.9}}),
    "shell of a file": film(grid=[12, 4], shell={"kind": "influence", "file": "BORE"}),
    "own places": RIGID | {
        "bearings": {
            "N": {"kind": "journal", "grid": [12, 4], "geometry": {
                "diameter": 3.0, "width": 2.25, "relative_clearance": 5e-4}},
            "N2": {"kind": "journal", "grid": [12, 4], "geometry": {
                "diameter": 3.0, "width": 2.0, "relative_clearance": 6e-4}}},
        "reduction": FEW, "results": ["journal.film"]},
    **{
        f"law {law}": film(cavitation={"kind": law} | ({"cavitation_pressure": 1e4} if at else {}))
        for law, at in (("sommerfeld", False), ("guembel", True), ("reynolds", True),
                        ("mass-conserving", True))
    },
    "thrust steps": collar(
        {"profile": {"kind": "step", "height": 1e-4},
         "pivot": {"stiffness": 1e10, "tilt_stiffness": 1e9}},
        back=COLLAR | {"profile": {"kind": "taper", "taper": 1e-4}}),
    "thrust against the motion": collar(
        {"profile": {"kind": "reversed", "profile": {"kind": "taper", "taper": 1e-4}}},
        back=COLLAR | {"profile": {"kind": "flat"}}),
    "wear by energy": BASES["worn bores"] | {"loads": {"dlc": ["1.2", "3.1"]}, "wear": {
        "law": {"energy_density": 1e15}, "samples": 10, "around": 36, "counts": {"3.1": 20.0}}},
    "design": {"candidates": {"one": {"N": {"kind": "journal"}, "N2": {"kind": "journal"}},
                              "two": {"N": {"kind": "journal"}, "N2": {"kind": "journal"}}},
               "design": {"candidate": "one", "sweep": 8, "levels": 2, "generations": 1,
                          "population": 6, "cells": 3, "checks": 2, "keys": {
                   "geometry.width": {"low": 1.0, "high": 2.0},
                   "lubricant.viscosity": {"values": [0.05, 0.1, 0.2]}}}},
    "design of a crown": {
        "shaft": {"two_point": {"beam": {}}}, "design": {"candidate": "one", "crown": {}},
        "candidates": {"one": {"N": {"kind": "journal", "tilt": True, "grid": [24, 8]}},
                       "two": {"N": {"kind": "journal", "tilt": True, "grid": [36, 8]}}}},
    "candidates": {"candidates": {
        "films": {"title": "films", "source": "assumed", "N": {"kind": "journal"},
                  "N2": [{"kind": "journal"},
                         {"kind": "thrust", "geometry": COLLAR | {"taper": 1e-4}}],
                  "tolerances": {"N": {"geometry.width": 0.01}}},
        "rollers": {"N": {"kind": "roller", "geometry": ROLLER},
                    "N2": {"kind": "roller", "geometry": ROLLER}}}},
    "as built": film() | {"as_built": {}, "tolerances": {"N": {"geometry.width": 0.01}}},
}  # fmt: skip

WALKED = {
    "turbulence": ("loads", "turbine"),
    "gust": ("loads",),
    "tables": ("loads",),
    "stop": ("loads",),
    "parked": ("loads",),
    "class S": ("loads",),
    "files": ("loads", "seeds", "reduction"),
    "bearings": ("shaft", "journal", "rolling", "friction"),
    "warm film": ("journal.heat",),
    "cold": ("environment",),
    "rough film": ("journal.contact",),
    "elastic film": ("journal.shell",),
    "turbulent film": ("journal.turbulence",),
    "film in motion": ("journal.motion", "journal.rung", "journal.grid", "reduction"),
    "periodic loads": ("reduction",),
    "periodic loads, tilted": ("journal.tilt", "journal.alignment", "reduction"),
    "stationary loads": ("reduction",),
    "tilted film": ("shaft", "journal"),
    "rotor dynamics": ("dynamics",),
    "rotor dynamics, rigid": ("dynamics",),
    "rolling dynamics": ("dynamics", "rolling.limits", "rolling.rings"),
    "rolling dynamics, dry": ("dynamics", "friction"),
    "rolling dynamics, proportional": ("dynamics",),
    "rigid and tilted": ("journal.tilt", "journal.alignment"),
    "worn bores": tuple(
        f"wear.{key}"
        for key in ("law", "running_in", "events", "counts", "samples", "around", "across")
    ),
    "worn bores, deep": ("wear.step", "wear.renewal"),
    "worn bores, events counted": ("lifetime",),
    "tapered rollers": ("rolling", "friction"),
    "bolted ring": ("rolling.outer_ring.supports",),
    "mounted rollers": ("rolling.mounting", "friction.cooling"),
    "catalogue of a series": ("rolling.catalogue",),
    "catalogue of constants": ("rolling.catalogue",),
    "catalogue of barrels": ("rolling.catalogue",),
    "catalogue of balls": ("rolling.catalogue",),
    "mounted rollers, loose": ("rolling.mounting", "environment"),
    "thrust collar": ("thrust",),
    "warm collar": ("thrust.motion", "thrust.tilt", "thrust.bearings.N2.heat"),
    "pair of cones": ("thrust",),
    "bearings on seats": ("journal.seat", "thrust.bearings.N2.seat"),
    "three points": ("shaft",),
    "integrated": ("shaft",),
    "yaw": ("shaft.yaw", "rolling.oscillation"),
    "pitch": ("shaft.pitch", "rolling.oscillation"),
    "direct drive": ("shaft",),
    **dict.fromkeys(
        ("balls in one row", "balls in two rows", "rollers in one row", "barrels",
         "toroidal barrels", "crossed rollers", "three rows"), ("rolling.geometry",)
    ),
    "further bearing": ("rolling.further",),
    **dict.fromkeys(("ring on legs", "ring of a file", "meshed ring"), ("rolling.outer_ring",)),
    "beam on bearings": ("shaft.two_point.beam",),
    "beam on a frame": ("shaft.two_point.beam.frame", "shaft.two_point.beam.supports"),
    **dict.fromkeys(
        ("heat over the film", "heat over the film, closed", "heat and growth", "heat of an oil",
         "heat of a sump", "heat in motion"), ("journal.heat",)
    ),
    **dict.fromkeys(
        ("two lobes", "partial arc", "pads", "reliefs", "recess across"), ("journal.geometry",)
    ),
    "pump": ("journal.supply",),
    "flow in pockets": ("journal.supply",),
    **dict.fromkeys(
        ("lined shell", "thick shell", "shell of a matrix", "housing on feet",
         "housing on a flange", "shell of a file"), ("journal.shell",)
    ),
    "own places": tuple(
        f"journal.own.N2.{key}"
        for key in ("limits", "grading", "alignment", "inlet", "motion", "heat")
    ),
    **dict.fromkeys(
        ("law sommerfeld", "law guembel", "law reynolds", "law mass-conserving"),
        ("journal.cavitation",)
    ),
    "thrust steps": ("thrust.bearings.N2.geometry", "thrust.bearings.N2.back"),
    "thrust against the motion": ("thrust.bearings.N2.geometry", "thrust.bearings.N2.back"),
    "wear by energy": ("wear.law", "wear.counts"),
    "design": ("design",),
    "design of a crown": ("design",),
    "candidates": tuple(f"candidates.films.{key}" for key in ("tolerances", "title", "source")),
    "as built": ("as_built", "tolerances"),
}  # fmt: skip

"""What is walked over of each scene: sections, or parts of them."""

WHOLE = {
    **dict.fromkeys(
        (
            "warm film",
            "rough film",
            "elastic film",
            "turbulent film",
            "film in motion",
            "rigid and tilted",
        ),
        ("journal",),
    ),
    **dict.fromkeys(("mounted rollers", "mounted rollers, loose"), ("rolling",)),
    **dict.fromkeys(("yaw", "pitch"), ("shaft", "rolling")),
    "rolling dynamics": ("friction", "rolling.inner_ring", "rolling.outer_ring"),
}
"""What is walked over, too, in the slow tests: keys that other scenes walk, beside an effect."""


def files(folder):
    """Write the files that the scenes name; their paths by the words that stand for them."""
    cube_file(folder / "loads.h5", wind_speeds=(8.0, 9.0), seeds=(1, 2), steps=200)
    cube_file(folder / "other.h5", wind_speeds=(10.0, 11.0), seeds=(1, 2), steps=200)
    rng = np.random.default_rng(0)
    for name, size, scale in (
        ("ring", 144, 1e-11),
        ("shell", 48, 1e-14),
        ("frame", 12, 1e-10),
        ("foot", 6, 1e10),
    ):
        for number in ("", "_other"):
            part = rng.standard_normal((size, size))
            np.save(folder / f"{name}{number}.npy", scale * (part @ part.T / size + np.eye(size)))
    angle, axial = np.linspace(0.0, 2 * np.pi, 16, endpoint=False), np.linspace(-1.125, 1.125, 3)
    apart = np.abs(angle[:, None] - angle)
    around = np.exp(-(np.minimum(apart, 2 * np.pi - apart) ** 2))
    near = np.exp(-((axial[:, None] - axial) ** 2))
    for number, scale in (("", 1e-11), ("_other", 2e-11)):
        influence = scale * np.kron(around, near)
        np.savez(folder / f"bore{number}.npz", angle=angle, axial=axial, influence=influence)
    words = {"CUBE": "loads.h5", "OTHER": "other.h5", "RING": "ring.npy", "SHELL": "shell.npy",
             "BORE": "bore.npz", "FRAME": "frame.npy", "FOOT": "foot.npy"}  # fmt: skip
    alike = [word for word in words if word not in ("CUBE", "OTHER")]
    others = {f"OTHER {word}": words[word].replace(".", "_other.") for word in alike}
    return {word: str(folder / file) for word, file in (words | others).items()}


OTHERS = {
    "friction.cooling": [{place: {"conductance": 20.0}} for place in ("N", "N2", "M")],
    "journal.heat.points": [3],
    "rolling.outer_ring.supports.0.strength": ["8.8"],
    "rolling.outer_ring.supports.0.hole": [0.034],
    "rolling.outer_ring.supports.0.head": [0.045],
    "rolling.outer_ring.supports.0.sectors": [[[0.3, 0.9], [3.4, 0.8]]],
    "design.keys": [{"geometry.width": [1.0, 2.0]}],
    "journal.own.N2.alignment": [[2e-5, 0.0]],
    "journal.own.N2.limits.sommerfeld_range": [[0.5, 5.0]],
    "journal.own.N2.limits.material": [[[400.0, 5e6]]],
    "journal.own.N2.heat": [{"oil": "mineral-vg-320"}],
    "design.crown": [{}],
    "design.keys.geometry.width.values": [[1.0, 2.0]],
    "….seat": [{"kind": "elastic", "stiffness": 1e7}],
    "….cooling": [{"conductance": 20.0}],
    "….catalogue": [{"bore": 0.9, "outside_diameter": 1.5}, {"bore": 0.9, "outside_diameter": 2.2}],
    "rolling.further.0.mounting": [{"inner_temperature": 300.0}],
    "rolling.further.0.oscillation": [{"amplitude": 0.1, "frequency": 0.1}],
    "rolling.further.0.inner_ring": [{"section": {"width": 0.05, "height": 0.1}, "radius": 0.45}],
    "rolling.further.0.outer_ring": [{"section": {"width": 0.05, "height": 0.1}, "radius": 0.55}],
    "journal.supply.grooves.1.restrictor": [{"diameter": 0.004, "length": 0.05}],
    "journal.geometry.relief.2.height": [
        [[0.0, 2e-6], [2e-5, 2e-5], [0.0, 0.0], [1e-5, 2e-5]],
    ],
    "design.candidate": ["two"],
    "design.maps": [[["lubricant.viscosity", "geometry.width"]]],
    "design.margin": [2.5],
    "design.keys.lubricant.viscosity.values": [[0.05, 0.2]],
    "journal.own": [
        {"N2": {"geometry": {"diameter": 3.0, "width": 2.0, "relative_clearance": 5e-4}}}
    ],
    "wear.counts": [{"1.1": 5.0}],
    "rolling.outer_ring.file": ["OTHER RING"],
    "rolling.outer_ring.first_angle": [0.2617993877991494],
    "rolling.outer_ring.axes": ["cartesian"],
    "rolling.outer_ring.held": ["back"],
    "journal.shell.file": ["OTHER BORE"],
    "journal.shell.matrix": ["OTHER SHELL"],
    "journal.shell.elements": [[18, 1, 2]],
    "turbine.name": ["iea-15mw"],
    "loads.files": [["OTHER"]],
    "seeds.alpha": [0.99],
    "seeds.methods": [["calibrated"]],
    "loads.rung": ["bem", "flap"],
    "loads.wind_class": ["II"],
    "friction.step": [0.5],
    "friction.follow_every": [4],
    "loads.winds": [["none.bts"]],
    "loads.cases": ["none.csv"],
    "loads.channels": [{"speed": ["RotSpeed"]}],
    "loads.gauge_distance": [1.5],
    "loads.frame": ["fixed", "rotating"],
    "journal.cavitation.kind": ["mass-conserving", "reynolds"],
    "journal.rung": ["reduced", "map"],
    "loads.pattern": [r"v(?P<wind_speed>\d+)"],
    "loads.dlc": ["1.3", "6.4"],
    "loads.wind_speeds": [[14.0], [60.0]],
    "loads.azimuths": [[1.0], [1.0, 2.0]],
    "loads.yaw_errors": [[0.2]],
    "loads.wind_grid": [[9, 36]],
    "rolling.catalogue.series": ["329"],
    "rolling.catalogue.constants": [{"kind": "tapered", "r1": 1e-6, "s1": 0.02, "s2": 2.0}],
    "rolling.catalogue.constants.s4": [0.0],
    "friction.lubricant": ["lgwm-2"],
    "friction.cleanliness": ["grease, severe contamination"],
    "journal.bearings": [["N2"], ["N", "N2"]],
    "journal.alignment": [[2e-5, 0.0]],
    "journal.grid": [[36, 12]],
    "journal.supply": [{"grooves": [{"angle": 1.0, "arc": 0.2, "pressure": 6e5}]}],
    "journal.heat": [{"oil": "mineral-vg-320"}],
    "journal.heat.growth": [{"shell_expansion": 12e-6}],
    "journal.heat.oil": ["mineral-vg-460", "iso-vg-68"],
    "journal.contact": [
        {"asperities": {"roughness": 1e-6, "contact_modulus": 1e11, "factor": 1e-3}}
    ],
    "journal.contact.friction": [0.3, "bronze"],
    "journal.turbulence": [{"begin": 0.0, "end": 0.0}],
    "journal.shell": [{"kind": "local", "compliance": 1e-12}],
    "journal.limits.sommerfeld_range": [[0.5, 5.0]],
    "journal.limits.material": [[[400.0, 5e6]]],
    "shaft.two_point": [{"span": 3.0}],
    "shaft.three_point": [{}],
    "shaft.integrated": [{}],
    "shaft.direct_drive": [{}],
    "shaft.moment": [{}],
    "shaft.yaw": [{}],
    "shaft.pitch": [{}],
    "rolling.oscillation": [{"amplitude": 0.1, "frequency": 0.1}],
    "rolling.oscillation.idle_torque": ["first row", ["first row", "first seal"]],
    "rolling.oscillation.mounting": ["pitch", "yaw, four-leg tower"],
    "shaft.two_point.beam": [{}],
    "shaft.two_point.beam.supports": [[{"radial": 1e9}, {}]],
    "….housing": [{"file": "FOOT"}],
    "….frame": [{"file": "FRAME"}, {"file": "FOOT"}],
    "shaft.two_point.beam.frame.file": ["OTHER FRAME"],
    "shaft.two_point.beam.supports.0.housing.file": ["OTHER FOOT"],
    "shaft.three_point.beam": [{}],
    "shaft.integrated.beam": [{}],
    "shaft.direct_drive.beam": [{}],
    "shaft.moment.beam": [{}],
    "journal.geometry.relief": [[{"kind": "crown", "height": 2e-5}]],
    "journal.supply.grooves.0.shape": ["circle"],
    "journal.supply.grooves.0.restrictor": [{"diameter": 0.004, "length": 0.05}],
    "journal.supply.pump": [{"flow": [0.0, 0.01], "pressure": [8e5, 2e5]}],
    "dynamics.speed_range": [[0.8, 1.6]],
    "dynamics.whirl": [0.5],
    "wear.running_in.initial_roughness": [1.0000001e-6],
    "thrust.rung": ["curve"],
    "thrust.grid": [[16, 8]],
    "thrust.bearings.N2.geometry.profile": [{"kind": "step", "height": 1e-4}],
    "….outer_groove_radius": [0.031],
    "….pivot": [{"share": 0.6}],
    "….pressure_coefficient": [2e-8],
    "thrust.bearings.N2.geometry.first_pad": [0.1],
    "thrust.bearings.N2.back": [
        {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.3, "pad_angle": 0.7, "taper": 1e-4}
    ],
    "thrust.bearings.N2.grid": [[16, 8]],
    "thrust.bearings.N2.heat": [{"oil": "iso-vg-68"}],
    "thrust.bearings.N2.heat.oil": ["iso-vg-68"],
    "thrust.bearings.M.grid": [[12, 6]],
    "thrust.bearings.N2.cavitation.kind": ["gas-mixture"],
    "thrust.bearings.M.cavitation.kind": ["gas-mixture"],
    "thrust.bearings.N2.cavitation.cavitation_pressure": [2e5],
    "thrust.bearings.M.cavitation.cavitation_pressure": [9.9e4],
    "thrust.bearings.N2.limits.material": [[[400.0, 5e6]]],
    "thrust.bearings.M.limits.material": [[[400.0, 5e6]]],
    "thrust.bearings.M.geometry.arrangement": ["X"],
    "thrust.bearings.M.geometry.clearance": [2.5e-4],
    "reduction.method": ["stationary", "histogram"],
    "reduction.bounds": [[0.02, 0.2]],
    "reduction.orders": [[1.0]],
    "reduction.between": [[5.0, 20.0]],
    "rolling.geometry.profile": ["straight"],
    "rolling.geometry.crown_radius": [18.0],
    "rolling.geometry.law": ["palmgren"],
    "rolling.geometry.arrangement": ["face-to-face"],
    "rolling.geometry.kind": ["ball", "roller"],
    "rolling.further": [[{"bearing": "N", "geometry": BALLS}]],
    "rolling.bearing": ["N2", "N"],
    "rolling.inner_ring": [
        {"section": {"width": 0.1, "height": 0.15}, "radius": 0.9},
        {"section": {"width": 0.1, "height": 0.3}, "radius": 0.5},
        {"section": {"width": 0.07, "height": 0.3}, "radius": 0.535},
    ],
    "rolling.mounting": [{"inner_share": 1.2}],
    "rolling.mounting.row_distance": ["seats"],
    "rolling.mounting.inner_temperature": [290.0],
    "rolling.mounting.outer_temperature": [310.0],
    "rolling.mounting.shaft_temperature": [310.0],
    "rolling.mounting.housing_temperature": [310.0],
    "rolling.mounting.inner_interference": [1e-4],
    "rolling.mounting.outer_interference": [5e-5],
    "rolling.mounting.bore": [0.95],
    "rolling.mounting.outside": [1.5],
    "rolling.mounting.shaft_bore": [0.1],
    "rolling.mounting.housing_outside": [2.5],
    "rolling.outer_ring.supports": [
        [{"radius": 0.7, "height": -0.15, "thickness": 0.05, "length": 0.3}],
    ],
    "rolling.outer_ring": [
        {"section": {"width": 0.1, "height": 0.15}, "radius": 1.1},
        {"section": {"width": 0.07, "height": 0.3}, "radius": 0.665},
    ],
}
"""Values that no rule finds: names, files, tables."""

OPTIONAL = (0.3, 2e-5, 3.0, 380.0, 1e6, 2, "graded", True)
"""Tried for a key that has no value yet."""
