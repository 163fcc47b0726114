"""Reading a turbine from its TOML file, or from a windIO file."""

from __future__ import annotations

import hashlib
import math
import tomllib
from functools import cache, lru_cache
from importlib import resources
from pathlib import Path
from typing import Any

from loadflow.errors import InputError
from loadflow.numerics.fields import meant, unknown_key

from .description import turbine_from
from .schema import Turbine
from .similarity import factor_of_power, scaled
from .windio import from_windio

_WINDIO = (".yaml", ".yml")


def turbine_names() -> list[str]:
    """Names of the turbines that come with the package.

    Returns
    -------
    list of str
        The names.

    Examples
    --------
    >>> "nrel-5mw" in turbine_names()
    True
    """
    return list(_names())


@cache
def _names() -> tuple[str, ...]:
    folder = resources.files(__package__)
    return tuple(sorted(f.name[:-5] for f in folder.iterdir() if f.name.endswith(".toml")))


def load_turbine(turbine: str | Path | Turbine) -> Turbine:
    """Read a turbine.

    Parameters
    ----------
    turbine : str, Path or Turbine
        Name of a turbine of the package (see `turbine_names`), path of a TOML file of the same
        form, of a windIO file (.yaml), or of a TOML file that completes a windIO file (``windio =
        "….yaml"`` beside the tables that the file lacks), or a turbine already read, which is
        handed back. A name followed by ``@`` and a rated power in W, such as
        ``"nrel-5mw@8e6"``, is that turbine scaled by similarity (`loadflow.turbines.scaled`).

    Returns
    -------
    Turbine

    Raises
    ------
    InputError
        Unknown name, unreadable file, or all keys that are missing, unknown or out of range, one
        on a line.

    Examples
    --------
    >>> round(load_turbine("nrel-5mw").rotor_mass)
    109390
    """
    if isinstance(turbine, Turbine):
        return turbine
    base, power = scaled_name(turbine)
    if power is not None:
        return _scaled(base, power)
    path = Path(turbine)
    if path.suffix not in (".toml", *_WINDIO):
        if str(turbine) not in _names():
            known = turbine_names()
            raise InputError(
                f"unknown turbine {str(turbine)!r}{meant(str(turbine), known)}; known are "
                f"{', '.join(known)}, or give the path of a .toml or a windIO .yaml file"
            )
        return _shipped(str(turbine))
    return _unchanged(path.absolute(), _stamps(path))


SCALED_POWERS = 5e4, 5e7
"""Rated powers, W, to which turbines are scaled: from small ones, whose control and structure are
others, to twice the largest that are built."""


def scaled_name(turbine: str | Path) -> tuple[str, float | None]:
    """Name of a turbine and the power (W) that it is scaled to; None if it is not.

    Raises
    ------
    InputError
        What stands behind ``@`` is no power, or none of a wind turbine, `SCALED_POWERS`.

    Examples
    --------
    >>> from loadflow.turbines.files import scaled_name
    >>> scaled_name("nrel-5mw@8e6"), scaled_name("nrel-5mw")
    (('nrel-5mw', 8000000.0), ('nrel-5mw', None))
    """
    name, mark, power = Path(turbine).name.rpartition("@")
    if not mark or Path(turbine).suffix in (".toml", *_WINDIO):
        return str(turbine), None
    base = str(Path(turbine).with_name(name)) if name else ""
    try:
        number = float(power)
    except ValueError:
        number = math.nan
    if not name or not (math.isfinite(number) and number > 0):
        raise InputError(
            f"turbine {str(turbine)!r}: a rated power in W is needed behind @, such as nrel-5mw@8e6"
        )
    least, most = SCALED_POWERS
    if not least <= number <= most:
        raise InputError(
            f"turbine {str(turbine)!r}: the rated power behind @ is {number:g} W, must be "
            f"{least:.0e} … {most:.0e} W, such as {name}@8e6"
        )
    return base, number


@cache
def _scaled(base: str, power: float) -> Turbine:
    """A turbine of another power, made once."""
    known = load_turbine(base)
    return scaled(known, factor_of_power(power, known.rated_power))


def turbine_digest(name: str) -> str:
    """SHA-256 of the file of a turbine and of that which it completes; empty for a shipped one.

    Parameters
    ----------
    name : str
        Of a shipped turbine, or of a file.

    Returns
    -------
    str
        64 hexadecimal digits, or nothing.

    Examples
    --------
    >>> turbine_digest("nrel-5mw")
    ''
    """
    base, _ = scaled_name(name)
    if base in turbine_names():
        return ""
    found = hashlib.sha256()
    for path in _files(Path(base)):
        found.update(path.read_bytes())
    return found.hexdigest()


@cache
def _shipped(name: str) -> Turbine:
    """A turbine of the package, read once, so that what is derived from it is made once too."""
    return read_turbine(Path(str(resources.files(__package__))) / f"{name}.toml")


@lru_cache(maxsize=8)
def _unchanged(path: Path, stamps: tuple[tuple[int, int], ...]) -> Turbine:
    """A file that has not changed since it was read; `stamps` are its times and lengths."""
    return read_turbine(path)


def _stamps(path: Path) -> tuple[tuple[int, int], ...]:
    """Time and length of a file and of that on which it is based."""
    return tuple((s.st_mtime_ns, s.st_size) for s in (p.stat() for p in _files(path)))


def _files(path: Path) -> list[Path]:
    """A file and that on which it is based, those that are there."""
    found = [path, *([path.parent / base] if (base := _base_of(path)) else [])]
    return [file for file in found if file.is_file()]


def _base_of(path: Path) -> str | None:
    if path.suffix in _WINDIO or not path.is_file():
        return None
    base = _toml(path).get("windio")
    return base if isinstance(base, str) else None


def read_turbine(path: Path) -> Turbine:
    """Read a file: TOML, windIO, or TOML that completes a windIO file which it names.

    Raises
    ------
    InputError
        As `load_turbine`.
    """
    if not path.is_file():
        raise InputError(f"turbine file {path} does not exist")
    if path.suffix in _WINDIO:
        return from_windio(path)
    document = _toml(path)
    try:
        if "windio" in document:
            return _completed(document, path.parent)
        return turbine_from(document, path.parent)
    except InputError as error:
        lines = str(error).split("\n")
        raise InputError("\n".join(f"{path}: {line}" for line in lines)) from error


def _completed(document: dict[str, Any], folder: Path) -> Turbine:
    """A turbine of windIO with what stands beside it."""
    beside = dict(document)
    file, options = beside.pop("windio"), beside.pop("windio_options", {})
    if not isinstance(file, str):
        raise InputError(f"windio = {file!r:.200}: must be the path of a windIO file")
    return from_windio(folder / file, beside=beside, folder=folder, **_options(options))


def _options(options: Any) -> dict[str, Any]:
    known = {"sections", "damping", "tower_damping", "seabed"}
    if not isinstance(options, dict):
        raise InputError(f"windio_options = {options!r:.200}: must be a table")
    if unknown := sorted(set(options) - known):
        raise InputError(f"windio_options.{unknown[0]}: {unknown_key(unknown[0], known)}")
    return options


def _toml(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a TOML file: {error}") from error
