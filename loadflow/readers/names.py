"""Which load case a file holds: from its name, or from a list of cases."""

from __future__ import annotations

import csv
import math
import os
import re
from dataclasses import dataclass
from pathlib import Path

from loadflow.errors import InputError

NUMBER = r"\d+(?:\.\d+)?"
FIELDS = {"dlc": r"[A-Za-z0-9.]+?", "wind_speed": NUMBER, "seed": r"\d+"}
DEFAULT_PATTERN = (
    rf"(?:^|_)(?P<dlc>[A-Za-z]+|(?:dlc)?[\d.]+[a-z]?)_(?:v|ws|wsp)(?P<wind_speed>{NUMBER})"
    r"(?:_(?:s|seed)(?P<seed>\d+))?(?:$|_)"
)
"""Understands ``nrel5mw_dlc11_v04_s1``, ``dlc1.1_v4_s1`` and ``nrel5mw_steady_v12``."""


@dataclass(frozen=True)
class CaseLabel:
    """What is known of a case; None where nothing is.

    Attributes
    ----------
    dlc : str or None
        Design load case, ``"1.1"``, or a word.
    wind_speed : float or None
        Mean wind speed, m/s.
    seed : int or None
        Seed of the turbulence.
    weight : float or None
        Share of the lifetime.
    """

    dlc: str | None = None
    wind_speed: float | None = None
    seed: int | None = None
    weight: float | None = None


def label_from_name(path: Path, pattern: str | None = None) -> CaseLabel:
    """Return what the name of a file says.

    Parameters
    ----------
    path : pathlib.Path
        File; its name without suffix is searched.
    pattern : str, optional
        Regular expression with groups ``dlc``, ``wind_speed``, ``seed`` (each may be absent), or
        a template such as ``"{dlc}_{wind_speed}_{seed}"``, where ``*`` stands for anything.
        Default: `DEFAULT_PATTERN`.

    Raises
    ------
    loadflow.errors.InputError
        The pattern is malformed, or was given and does not fit.
    """
    match = compile_pattern(pattern).search(path.stem)
    if match is None:
        if pattern is not None:
            raise InputError(f"{path}: the name does not fit the pattern {pattern!r}")
        return CaseLabel()
    found = match.groupdict()
    return _label(found, f"{path}, pattern {pattern!r}")


def compile_pattern(pattern: str | None) -> re.Pattern[str]:
    """Return the regular expression of a pattern or template."""
    if pattern is None:
        return re.compile(DEFAULT_PATTERN, re.IGNORECASE)
    expression = pattern
    if "(?P<" not in pattern:
        expression = re.escape(pattern).replace(r"\*", ".*")
        for field, form in FIELDS.items():
            expression = expression.replace(rf"\{{{field}\}}", f"(?P<{field}>{form})")
        expression = f"^{expression}$"
    try:
        compiled = re.compile(expression, re.IGNORECASE)
    except re.error as error:
        raise InputError(f"pattern {pattern!r} is no regular expression: {error}") from None
    if not compiled.groupindex or set(compiled.groupindex) - set(FIELDS):
        raise InputError(
            f"pattern {pattern!r} names {sorted(compiled.groupindex)}; it must name one or more "
            f"of {list(FIELDS)}"
        )
    return compiled


def plain_dlc(text: str) -> str:
    """Return the usual form of a load case: ``dlc11``, ``DLC1.1`` and ``11`` become ``1.1``."""
    match = re.fullmatch(r"(?:dlc[ _-]?)?(\d)\.?(\d)([a-z]?)", text.strip(), re.IGNORECASE)
    return f"{match[1]}.{match[2]}{match[3].lower()}" if match else text.strip()


def read_case_list(path: str | os.PathLike[str]) -> dict[str, CaseLabel]:
    """Read a list of cases: CSV with columns file, dlc, wind_speed, seed and weight.

    Parameters
    ----------
    path : path
        The list. Only ``file`` must be there; columns and fields may be left out.

    Returns
    -------
    dict of str to CaseLabel
        By name of file, without folder.

    Raises
    ------
    loadflow.errors.InputError
        No such file, unknown column, file named twice, or a field that is no number.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError(f"{path}: no such list of cases")
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = csv.DictReader(file, skipinitialspace=True)
        columns = list(rows.fieldnames or [])
        known = ["file", "dlc", "wind_speed", "seed", "weight"]
        if "file" not in columns or set(columns) - set(known):
            raise InputError(f"{path}: columns are {columns}; known are {known}, 'file' is needed")
        labels: dict[str, CaseLabel] = {}
        for number, row in enumerate(rows, 2):
            if None in row or None in row.values():
                raise InputError(f"{path}, line {number}: must have {len(columns)} fields")
            name = Path(row.pop("file").strip()).name
            if name in labels:
                raise InputError(f"{path}, line {number}: {name} is listed twice")
            labels[name] = _label(row, f"{path}, line {number}")
    return labels


def _label(found: dict[str, str | None], where: str) -> CaseLabel:
    given = {key: value.strip() for key, value in found.items() if value and value.strip()}
    try:
        label = CaseLabel(
            dlc=plain_dlc(given["dlc"]) if "dlc" in given else None,
            wind_speed=float(given["wind_speed"]) if "wind_speed" in given else None,
            seed=int(given["seed"]) if "seed" in given else None,
            weight=float(given["weight"]) if "weight" in given else None,
        )
    except ValueError as error:
        raise InputError(f"{where}: {error}") from None
    for key in ("wind_speed", "weight"):
        value = getattr(label, key)
        if value is not None and not (math.isfinite(value) and value >= 0):
            raise InputError(f"{where}: {key} = {value:g} must be finite and ≥ 0")
    return label
