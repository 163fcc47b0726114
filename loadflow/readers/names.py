"""Which load case a file holds: from its name, or from a list of cases."""

from __future__ import annotations

import csv
import math
import os
import re
from dataclasses import dataclass, replace
from functools import lru_cache
from io import StringIO
from pathlib import Path

from loadflow.errors import InputError
from loadflow.readers.text import read_text

NUMBER = r"\d+(?:\.\d+)?"
FIELDS = {"dlc": r"[A-Za-z0-9.]+?", "wind_speed": NUMBER, "seed": r"\d+"}

_FREE = r"(?<![A-Za-z0-9])"  # a word begins here
_END = r"(?![A-Za-z0-9])"
_SPEED = r"(\d+(?:[.,p]\d+)?)"
_GAP = r"[ _=-]?"
_NEXT = rf"(?={_END}|[vuws]\d)"  # an end, or the next field in one word: dlc12v10s1

DLC_FORMS = (
    rf"{_FREE}dlc{_GAP}(\d)[._p-](\d)([a-z]{{0,3}}){_NEXT}",
    rf"{_FREE}dlc{_GAP}(\d)(\d)([a-z]{{0,3}}){_NEXT}",
    rf"{_FREE}(?:lc|loadcase|load_case){_GAP}(\d)\.(\d)([a-z]{{0,3}}){_NEXT}",
    r"^(\d)\.(\d)([a-z]{0,3})(?=[ _-])",
    rf"(?:^|[ _-])(\d)\.?(\d)([a-z]?)(?=[ _-](?:v|u|ws|wsp){NUMBER})",
)
"""How names say the load case: ``dlc1.1``, ``DLC12``, ``dlc6.2a``, ``DLC1p1``, ``1.2a_…``."""

SPEED_FORMS = (
    rf"{_FREE}(?:wind[ _-]?speed|wsp|ws|[vu]hub|[vu]mean|[vu]ref|wind){_GAP}{_SPEED}"
    rf"(?:mps|ms)?{_NEXT}",
    rf"(?<![A-Za-z0-9.]){_SPEED}[ _-]?(?:mps|ms|m_s|m/s){_END}",
    rf"(?<![A-Za-z])[uv]{_GAP}{_SPEED}(?:mps|ms)?{_NEXT}",
)
"""How names say the wind speed, the clearest first: ``wsp08``, ``ws12.0``, ``12mps``, ``v04``."""

SEED_FORMS = (
    rf"(?<![A-Za-z])(?:rand(?:om)?)?{_GAP}(?:seed|sd){_GAP}(\d+){_END}",
    rf"(?<![A-Za-z])s=?(\d+){_END}",
)
"""How names say the seed: ``seed3``, ``Seed_3``, ``s1001``."""

DIRECTION = rf"{_FREE}wdir{_GAP}(\d+){_END}"
"""Wind direction in degrees, which load cases of DTU take several of with the same seed."""

IN_ORDER = rf"^[ _-]{_SPEED}[ _-](\d+)$"
"""What follows the load case where nothing is said: wind speed and seed, ``dlc1.2_12_3``."""

SITUATIONS = (
    "steady", "startup", "start", "shutdown", "stop", "emergency", "idling", "idle", "parked",
    "powercurve", "gridloss", "fault", "gust", "step", "steps", "ramp",
    "ntm", "etm", "nwp", "ewm", "ewm1", "ewm50", "eog", "ecd", "edc", "ews",
)  # fmt: skip
"""Words that stand for a load case without a number."""

WIND_MODELS = {"ntm", "etm", "nwp", "ewm", "eog", "ecd", "edc", "ews"}


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
    variant : str
        What else tells cases of one load case, wind speed and seed apart, such as ``wdir350``.
    """

    dlc: str | None = None
    wind_speed: float | None = None
    seed: int | None = None
    weight: float | None = None
    variant: str = ""

    @property
    def suffix(self) -> str:
        """End of the name of the case."""
        return f"_{self.variant}" if self.variant else ""


def label_from_name(path: Path, pattern: str | None = None) -> CaseLabel:
    """Return what the name of a file says.

    Parameters
    ----------
    path : pathlib.Path
        File; its name without suffix is searched. It need not exist.
    pattern : str, optional
        Regular expression with groups ``dlc``, ``wind_speed``, ``seed`` (each may be absent), or
        a template such as ``"{dlc}_{wind_speed}_{seed}"``, where ``*`` stands for anything.
        Default: the usual forms of OpenFAST scripts, WEIS, DTU and Bladed.

    Raises
    ------
    loadflow.errors.InputError
        The pattern is malformed, or was given and does not fit.

    Examples
    --------
    >>> label_from_name(Path("dlc12_wsp08_wdir000_s1001.sel"))
    CaseLabel(dlc='1.2', wind_speed=8.0, seed=1001, weight=None, variant='')
    """
    name = stem(path)
    direction = re.search(DIRECTION, name, re.IGNORECASE)
    variant = f"wdir{direction[1]}" if direction and int(direction[1]) else ""
    if pattern is None:
        return CaseLabel(*_said(name), variant=variant)
    match = compile_pattern(pattern).search(name)
    if match is None:
        raise InputError(f"{path}: the name does not fit the pattern {pattern!r}")
    return replace(_label(match.groupdict(), f"{path}, pattern {pattern!r}"), variant=variant)


def stem(path: Path) -> str:
    """Return the name without suffix; what begins with a digit is none (``…_ws12.5_seed3``)."""
    return re.sub(r"\.(?:[A-Za-z]\w*|[%$]\w+)$", "", path.name)


@lru_cache(maxsize=10_000)  # plans ask again and again which load cases the files are
def _said(name: str) -> tuple[str | None, float | None, int | None]:
    """Return load case, wind speed and seed as far as a name tells them."""
    dlc, end = _dlc(name)
    speed = _field(name, SPEED_FORMS, end)
    seed = _field(name, SEED_FORMS, end)
    if dlc and speed is None and seed is None and (rest := re.search(IN_ORDER, name[end:])):
        speed, seed = rest.groups()
    if dlc is None:
        words = re.findall(r"[a-z]+\d*", name.casefold())
        dlc = next((word for word in words if word in SITUATIONS), None)
    number = None if speed is None else float(re.sub("[p,]", ".", speed))
    return dlc, number, None if seed is None else int(seed)


def _dlc(name: str) -> tuple[str | None, int]:
    """Return the load case, and where it ends in the name."""
    for form in DLC_FORMS:
        if match := re.search(form, name, re.IGNORECASE):
            return _number(*match.groups()), match.end()
    return None, 0


def _number(first: str, second: str, letters: str) -> str:
    """Put a load case together: a wind model behind its number says nothing new."""
    variant = letters.casefold()
    return f"{first}.{second}{'' if variant in WIND_MODELS else variant}"


def _field(name: str, forms: tuple[str, ...], start: int) -> str | None:
    """Return the first field of the clearest form, rather behind the load case than before it."""
    for form in forms:
        found = [*re.finditer(form, name, re.IGNORECASE)]
        behind = [match for match in found if match.start() >= start]
        if found:
            return str((behind or found)[0][1])
    return None


def compile_pattern(pattern: str) -> re.Pattern[str]:
    """Return the regular expression of a pattern or template."""
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
    """Return the usual form of a load case: ``dlc11``, ``DLC1.1`` and ``11 NTM`` become ``1.1``."""
    form = r"(?:dlc|lc|load case)?[ _-]*(\d)[._p-]?(\d)[ _-]*([a-z]{0,3})"
    match = re.fullmatch(form, text.strip(), re.IGNORECASE)
    return _number(*match.groups()) if match else text.strip()


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
    rows = csv.DictReader(StringIO(read_text(path), newline=""), skipinitialspace=True)
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
