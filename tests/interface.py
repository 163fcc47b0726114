"""The public interface in words, a line for each name, so that a change of it is seen as one.

    python tests/interface.py

rewrites the files of `tests/contract/`; `tests/test_contract.py` compares them with the package.
"""

import dataclasses
import inspect
import re
from functools import cache
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory

import typer.main
from synthetic import cube_file

import loadflow
from loadflow.cube import open_cube
from loadflow.cube.schema import CASE_COORDS, CUBE, VARIABLES
from loadflow.quantities import FILM, ROLLING
from loadflow.running.folder import MANIFEST
from loadflow.running.runner import run
from loadflow.scene import make_scene
from loadflow.scene.schema import json_schema
from loadflow.scene.written import SCENE

PACKAGE = Path(loadflow.__file__).parent
FOLDER = Path(__file__).parent / "contract"
EMPTY = inspect.Parameter.empty


def descriptions():
    """Lines of each file of the contract."""
    return {
        "names": names(),
        "scene": scene(),
        "quantities": quantities(),
        "results": results(),
        "commands": commands(),
        "versions": versions(),
    }


def write():
    FOLDER.mkdir(exist_ok=True)
    for name, lines in descriptions().items():
        (FOLDER / f"{name}.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


# --- names -------------------------------------------------------------------------------------


@cache
def rooms():
    """The package and its rooms that offer names, from the top."""
    found = ("loadflow", *sorted(p.parent for p in PACKAGE.rglob("__init__.pyi")))[1:]
    names = [".".join(path.relative_to(PACKAGE.parent).parts) for path in found]
    return {name: import_module(name) for name in names}


def names():
    """What each room offers: signatures, and of classes their fields, properties and methods."""
    lines = []
    for room, module in rooms().items():
        for name in sorted(module.__all__):
            lines += of_name(room, name, getattr(module, name))
    return lines


def of_name(room, name, entry):
    place = f"{room}.{name}"
    home = home_of(entry)
    if home and home != room:
        return [f"{place} = {home}.{entry.__name__}"]
    if inspect.isclass(entry):
        return of_class(place, entry)
    if inspect.isroutine(entry):
        return [f"{place}{signature(entry)}"]
    if inspect.ismodule(entry):
        return [f"{place}: module"]
    return [f"{place}: {type(entry).__name__}"]


def home_of(entry):
    """The deepest room above its module that offers an entry: others offer it again."""
    module = getattr(entry, "__module__", None) or ""
    offering = [
        room
        for room, found in rooms().items()
        if getattr(entry, "__name__", "") in found.__all__ and f"{module}.".startswith(f"{room}.")
    ]
    return max(offering, key=len, default="")


def of_class(place, entry):
    """A class and what it has, inherited or not, but of the package alone."""
    fields = {f.name: f for f in dataclasses.fields(entry)} if is_record(entry) else {}
    keys = getattr(entry, "model_fields", {})  # their types and ranges are those of the scene
    plain = keys or inspect.isabstract(entry) or getattr(entry, "_is_protocol", False)
    lines = [place if plain else f"{place}{signature(entry, fields)}"]
    members = {
        name: inspect.getattr_static(entry, name)
        for base in reversed(entry.__mro__)
        if base.__module__.startswith("loadflow")
        for name in vars(base)
    }
    for name in sorted({*fields, *keys, *members}):
        if name.startswith("_") or name in ("model_config", "model_fields"):
            continue
        member = members.get(name)
        if name in keys:
            lines.append(f"{place}.{name}: key")
        elif name in fields:
            lines.append(f"{place}.{name}: field {of_field(fields[name])}")
        elif name in getattr(entry, "_fields", ()):
            lines.append(f"{place}.{name}: field")
        elif isinstance(member, property) or hasattr(member, "attrname"):
            getter = getattr(member, "fget", None) or member.func
            given = inspect.signature(getter).return_annotation
            lines.append(f"{place}.{name}: property {shown(given)}".rstrip())
        elif isinstance(member, staticmethod | classmethod):
            lines.append(f"{place}.{name}{signature(member.__func__)}")
        elif inspect.isfunction(member):
            lines.append(f"{place}.{name}{signature(member)}")
        else:
            lines.append(f"{place}.{name}: {type(member).__name__}")
    return lines


def is_record(entry):
    return dataclasses.is_dataclass(entry)


def of_field(field):
    """Type of a field, and its default."""
    if field.default is not dataclasses.MISSING:
        return f"{shown(field.type)} = {value(field.default)}"
    return shown(field.type) + (" = …" if field.default_factory is not dataclasses.MISSING else "")


def signature(entry, fields=()):
    """Names, hints and defaults as they are written; of fields, which have lines, the names."""
    found = inspect.signature(entry)
    parameters = [p for p in found.parameters.values() if p.name not in ("self", "cls")]
    parts, told = [], False
    for p in parameters:
        if p.kind is p.KEYWORD_ONLY and not told:
            parts.append("*")
        told = told or p.kind in (p.KEYWORD_ONLY, p.VAR_POSITIONAL)
        star = {p.VAR_POSITIONAL: "*", p.VAR_KEYWORD: "**"}.get(p.kind, "")
        hint = "" if p.annotation is EMPTY or p.name in fields else f": {shown(p.annotation)}"
        default = "" if p.default is EMPTY or p.name in fields else f" = {value(p.default)}"
        parts.append(f"{star}{p.name}{hint}{default}")
        if p.kind is p.POSITIONAL_ONLY and p is last_positional(parameters):
            parts.append("/")
    gives = found.return_annotation
    if inspect.isclass(entry) or gives is EMPTY:
        return f"({', '.join(parts)})"
    return f"({', '.join(parts)}) -> {shown(gives)}"


def last_positional(parameters):
    return [p for p in parameters if p.kind is p.POSITIONAL_ONLY][-1]


def shown(hint):
    """A type hint as it is written, on one line."""
    if hint is EMPTY:
        return ""
    hint = getattr(hint, "__forward_arg__", hint)
    text = hint if isinstance(hint, str) else inspect.formatannotation(hint)
    return " ".join(text.split())


def value(default):
    """A default, without addresses in memory."""
    if inspect.isroutine(default) or inspect.isclass(default):
        return default.__name__
    return " ".join(re.sub(r" at 0x[0-9a-f]+", "", repr(default)).split())


# --- scenes ------------------------------------------------------------------------------------


def scene():
    """Keys of a scene by section: type, range, default."""
    whole = json_schema()
    lines = [f"{key}: {of_key(part)}" for key, part in whole["properties"].items()]
    for section, part in whole["$defs"].items():
        lines += [
            f"{section}.{key}: {of_key(one)}" for key, one in part.get("properties", {}).items()
        ]
        if "enum" in part:
            lines.append(f"{section}: {of_key(part)}")
    return sorted(lines)


RANGES = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
COUNTS = {"minItems": "≥", "maxItems": "≤"}


def of_key(part):
    """Type, range and default of a key."""
    default = f" = {part['default']!r}" if "default" in part else ""
    return kind_of(part) + default


def kind_of(part):
    """What may stand there."""
    if "$ref" in part:
        return part["$ref"].removeprefix("#/$defs/")
    for several in ("anyOf", "oneOf", "allOf"):
        if several in part:
            kinds = dict.fromkeys(kind_of(one) for one in part[several])
            return " | ".join(kind for kind in kinds if kind != "Toleranced")
    if "enum" in part:
        return " | ".join(repr(one) for one in part["enum"])
    if "const" in part:
        return repr(part["const"])
    kind = part.get("type", "any")
    bounds = [f"{sign} {part[key]:g}" for key, sign in RANGES.items() if key in part]
    if kind == "array":
        items = [kind_of(one) for one in part.get("prefixItems", [])] or [kind_of(part["items"])]
        counts = [f"{sign} {part[key]}" for key, sign in COUNTS.items() if key in part]
        of = f"[{', '.join(items)}]"
        return f"array of {of}" + (f" ({', '.join(counts)})" if counts else "")
    if kind == "object" and isinstance(part.get("additionalProperties"), dict):
        return f"table of {kind_of(part['additionalProperties'])}"
    return " ".join([str(kind), ", ".join(bounds)]).rstrip()


# --- results, commands, versions ---------------------------------------------------------------


def quantities():
    """Names, units and meaning of what results and cubes hold."""
    tables = {"film": FILM, "rolling": ROLLING}
    lines = [
        f"{table} {name}: {one.symbol or '-'} [{one.units}] {one.meaning}"
        for table, of in tables.items()
        for name, one in of.items()
    ]
    cube = {"cube": VARIABLES, "case": CASE_COORDS}
    return lines + [
        f"{table} {name} ({', '.join(one.dims)}) [{one.units}] {one.long_name}"
        for table, of in cube.items()
        for name, one in of.items()
    ]


def results():
    """Variables of the result of a run that gives all there is, with dimensions and units."""
    with TemporaryDirectory() as folder:
        loads = Path(folder) / "loads.h5"
        cube_file(loads, wind_speeds=(8.0, 12.0), seeds=(1, 2), steps=120)
        lines = {}
        for name, more in {
            "all": {},
            "rollers": {
                "bearings": "two-spherical",
                "results": ["rolling.friction"],
                "shaft": {"two_point": {}},
            },
        }.items():
            told = {"name": name, "accuracy": "given", "loads": {"files": [str(loads)]}}
            run(make_scene(told | more), out=folder, report=False)
            tree = open_cube(Path(folder) / name / "result.h5")
            lines |= dict.fromkeys(
                f"{leaf.path} {name} ({', '.join(map(str, one.dims))}) [{unit_of(one)}]"
                for leaf in tree.leaves
                for name, one in leaf.to_dataset(inherit=False).variables.items()
            )
        return [*lines]


def unit_of(variable):
    return "text" if variable.dtype.kind in "OUST" else variable.attrs.get("units", "-")


def commands():
    """Verbs of the command line, their arguments and options."""
    from loadflow.cli import app

    return sorted(of_command("loadflow", typer.main.get_command(app)))


def of_command(name, command):
    if verbs := getattr(command, "commands", {}):
        for key, one in verbs.items():
            yield from of_command(f"{name} {key}", one)
        return
    yield name
    for one in command.params:
        if one.name == "help":
            continue
        names = "/".join([*one.opts, *one.secondary_opts])
        many = " …" if one.nargs != 1 or getattr(one, "multiple", False) else ""
        needed = " (needed)" if one.required else ""
        simple = isinstance(one.default, bool | int | float | str | Path)
        default = f" = {one.default}" if simple else ""
        yield f"{name} {names}{many}{needed}{default}"


def versions():
    return [f"{one.what}: {one.key} = {one.version}" for one in (SCENE, CUBE, MANIFEST)]


if __name__ == "__main__":
    write()
