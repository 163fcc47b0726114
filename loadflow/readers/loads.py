"""Load series of any number of files into one cube."""

from __future__ import annotations

import glob
import hashlib
import logging
import os
import warnings
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

import xarray as xr

from loadflow.cube import CASE_COORDS, case_name, make_cube
from loadflow.errors import InputError, ValidityWarning
from loadflow.readers.aliases import Channels, Frame, read_channels
from loadflow.readers.doubts import with_doubts
from loadflow.readers.names import CaseLabel, compile_pattern, label_from_name, read_case_list
from loadflow.readers.registry import READERS, find_reader

log = logging.getLogger("loadflow.run")

Files = str | os.PathLike[str] | Iterable[str | os.PathLike[str]]


def read_loads(
    files: Files,
    turbine: str = "nrel-5mw",
    cases: str | os.PathLike[str] | None = None,
    pattern: str | None = None,
    channels: Channels | str | os.PathLike[str] | None = None,
    gauge_distance: float | None = None,
    frame: Frame = "auto",
    quiet: bool = False,
) -> xr.Dataset | xr.DataTree:
    r"""Read load series of OpenFAST, HAWC2, Bladed or CSV files into a load cube.

    Parameters
    ----------
    files : path, str or iterable of these
        Files, folders, or shell patterns such as ``"runs/*.outb"``.
    turbine : str
        Turbine the series belong to, kept as an attribute. Weight, power and speed are compared
        with it.
    cases : path, optional
        List of cases, CSV with columns file, dlc, wind_speed, seed, weight; it must name every
        file. What it leaves open is left open, whatever the names say.
    pattern : str, optional
        How names of files tell the case: a regular expression with groups ``dlc``,
        ``wind_speed`` and ``seed``, or a template such as ``"run_{dlc}_{wind_speed}_{seed}"``.
        The default understands the usual forms; `list_names` shows what it understands. What
        remains unknown becomes load case ``unknown``, the mean wind of the series, and a running
        seed.
    channels : mapping, path or str, optional
        Component of the cube (``speed``, ``hub_force_x``, …), or ``time`` of CSV files → channel
        of the files, where a leading minus turns the sign; or a TOML file of them, see
        `read_channels`. Needed for HAWC2, whose files do not tell the frame.
    gauge_distance : float, optional
        Distance from the rotor apex to the shaft strain gauge, m; see `read_openfast`.
    frame : {"auto", "fixed", "rotating"}
        Whether y and z channels turn with blade 1 and are to be turned back with the azimuth.
        "auto" goes by the names of the channels where they tell it (OpenFAST, Bladed).
    quiet : bool
        Whether doubts are only kept in the coordinate ``doubts``, and not warned of.

    Returns
    -------
    xarray.Dataset or xarray.DataTree
        The cube: a Dataset where all series have one length and step, else one for each. On
        ``case`` stand ``doubts`` (text, a line each: what does not fit turbine, frame, unit or
        step) and ``standing_share`` (share of the time standing or idling).

    Raises
    ------
    loadflow.errors.InputError
        No file, a file that is not sound or not in the list, or two files that hold one case.

    Warns
    -----
    loadflow.errors.ValidityWarning
        For each file with doubts.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.readers import read_loads
    >>> head = "time [s], speed [rpm], hub_force_x [kN], hub_force_y [kN], hub_force_z [kN], "
    >>> head += "hub_moment_x [kN m], hub_moment_y [kN m], hub_moment_z [kN m]"
    >>> row = ", 9, 350, 0, -1070, 2000, 500, 300"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for seed in (1, 2):
    ...         text = "\n".join([head, *(f"{0.1 * k:g}{row}" for k in range(20))])
    ...         _ = (Path(folder) / f"dlc1.1_v8_s{seed}.csv").write_text(text)
    ...     cube = read_loads(f"{folder}/*.csv", quiet=True).load()
    >>> cube["case"].values.tolist()
    ['dlc1.1_v8_s1', 'dlc1.1_v8_s2']
    """
    paths = find_files(files)
    listed = read_case_list(cases) if cases is not None else {}
    own = None if channels is None else read_channels(channels)
    register = _Register()
    labelled = []
    for path in paths:
        read = find_reader(path).load()
        series = read(path, channels=own, gauge_distance=gauge_distance, frame=frame)
        label = _label(path, pattern, listed, cases)
        case = _labelled(series, register.complete(label, series, path))
        case = with_doubts(case, turbine)
        doubts = str(case["doubts"].item())
        if doubts and not quiet:
            warnings.warn(f"{path}: {doubts}", ValidityWarning, stacklevel=2)
        log.info("%s: %d samples", path, case.sizes["time"])
        labelled.append(case.assign_attrs(turbine=turbine))
    return make_cube(labelled)


def list_names(
    files: Files,
    pattern: str | None = None,
    cases: str | os.PathLike[str] | None = None,
) -> list[tuple[str, CaseLabel]]:
    """Return what the names of files say of their load cases; nothing is read.

    Parameters
    ----------
    files : path, str or iterable of these
        Files, which need not exist; folders and shell patterns stand for what they hold.
    pattern : str, optional
        As in `read_loads`; a name that does not fit says nothing.
    cases : path, optional
        List of cases that stands above the names; a file that it does not name says nothing.

    Returns
    -------
    list of (str, CaseLabel)
        File, and what is known of it: None where nothing is.

    Raises
    ------
    loadflow.errors.InputError
        No file, a malformed pattern or list, a folder without load files, or a pattern or list
        that says nothing of any file.

    Examples
    --------
    >>> [(file, label)] = list_names("DLC1.3_ws11.4_seed3.outb")
    >>> label.dlc, label.wind_speed, label.seed
    ('1.3', 11.4, 3)
    """
    entries = [files] if isinstance(files, str | os.PathLike) else list(files)
    if not entries:
        raise InputError("no load file was given")
    if pattern is not None:
        compile_pattern(pattern)
    listed = read_case_list(cases) if cases is not None else {}
    found, unfit = [], []
    for path in (path for entry in entries for path in _meant(Path(entry))):
        try:
            label = _label(path, pattern, listed, cases)
        except InputError as error:
            label = CaseLabel()
            unfit.append(error)
        found.append((str(path), label))
    if len(unfit) == len(found):
        more = f"; nor does any other of {len(unfit)} files" if unfit[1:] else ""
        raise InputError(f"{unfit[0]}{more}")
    return found


def _meant(entry: Path) -> list[Path]:
    """Return what an entry stands for, or itself where nothing is there."""
    if entry.is_dir() or (glob.has_magic(str(entry)) and not entry.exists()):
        try:
            inside = _expand(entry)
        except InputError:
            if entry.is_dir():
                raise
            return [entry]
        runs = {p.with_suffix("") if find_reader(p).several_files else p: p for p in inside}
        return sorted(runs.values())
    return [entry]


def find_files(files: Files) -> list[Path]:
    """Return the files meant by paths, folders and shell patterns, one for each run.

    Raises
    ------
    loadflow.errors.InputError
        Nothing matches, a file is absent, or is given twice.
    """
    entries = [files] if isinstance(files, str | os.PathLike) else list(files)
    found = [path for entry in entries for path in _expand(Path(entry))]
    if not found:
        raise InputError("no load file was given")
    runs: dict[Path, Path] = {}
    for path in found:
        several = find_reader(path).several_files
        key = path.with_suffix("").resolve() if several else path.resolve()
        if key in runs and not several:
            raise InputError(f"{path}: the file is given twice")
        runs.setdefault(key, path)
    return list(runs.values())


def _expand(entry: Path) -> list[Path]:
    if entry.is_dir():
        fitting = sorted(p for p in entry.iterdir() if any(r.matches(p) for r in READERS))
        inside = [p for p in fitting if find_reader(p).recognises(p)]
        others = sorted({p.name for p in fitting} - {p.name for p in inside})
        told = ", ".join(others[:10]) + (", …" if len(others) > 10 else "")
        if not inside:
            more = f"; to read them all the same, name them or a pattern: {told}" if told else ""
            raise InputError(f"{entry}: the folder holds no load file that is known as such{more}")
        if others:
            message = f"{entry}: {len(others)} files are no load series, and left out: {told}"
            warnings.warn(message, ValidityWarning, stacklevel=3)
        return inside
    if entry.exists():
        return [entry]
    if not glob.has_magic(str(entry)):
        raise InputError(f"{entry}: no such file")
    matches = sorted(Path(name) for name in glob.glob(str(entry.expanduser())))
    if not matches:
        raise InputError(f"{entry}: no file matches")
    return matches


def _label(
    path: Path,
    pattern: str | None,
    listed: dict[str, CaseLabel],
    cases: str | os.PathLike[str] | None,
) -> CaseLabel:
    """Return what the list says of a file, or its name where there is no list."""
    return label_from_name(path, pattern) if cases is None else _listed(path, listed, cases)


def _listed(path: Path, listed: dict[str, CaseLabel], cases: str | os.PathLike[str]) -> CaseLabel:
    """Return what the list says of a file; of a run with several files it may name any."""
    if path.name in listed:
        return listed[path.name]
    if find_reader(path).several_files:
        for name, label in listed.items():
            if Path(name).stem == path.stem:
                return label
    raise InputError(f"{path}: the list of cases {cases} does not name this file")


class _Register:
    """Cases met so far: completes labels, and sees that no two files hold the same."""

    def __init__(self) -> None:
        self._names: dict[str, Path] = {}
        self._series: dict[bytes, Path] = {}

    def complete(self, label: CaseLabel, series: xr.Dataset, path: Path) -> CaseLabel:
        """Return the label with load case, wind speed and seed, which no other file has."""
        dlc = label.dlc or "unknown"
        wind_speed = label.wind_speed
        if wind_speed is None:
            wind_speed = _mean_wind(series, path)
        seed = label.seed
        if seed is None:
            self._refuse_copy(series, path)
            seed = 1
            while label.wind_speed is None and case_name(dlc, wind_speed, seed) in self._names:
                seed += 1
        name = case_name(dlc, wind_speed, seed) + label.suffix
        if name in self._names:
            raise InputError(
                f"{path}: case {name!r} is already in {self._names[name]}; tell them apart by "
                "name, by a pattern of names or by a list of cases"
            )
        self._names[name] = path
        return CaseLabel(dlc, wind_speed, seed, label.weight, label.variant)

    def _refuse_copy(self, series: xr.Dataset, path: Path) -> None:
        """A file without a seed of its own must not bring the same series as a new seed."""
        digest = hashlib.sha256(series["hub_force"].values.tobytes()).digest()
        if digest in self._series:
            raise InputError(f"{path}: the series are those of {self._series[digest]}")
        self._series[digest] = path


def _mean_wind(series: xr.Dataset, path: Path) -> float:
    if "wind" not in series:
        raise InputError(
            f"{path}: the wind speed is neither in the name nor in a list of cases, and the file "
            "has no wind"
        )
    return round(float(series["wind"].mean()), 2)


def _labelled(series: xr.Dataset, label: CaseLabel) -> xr.Dataset:
    values = {key: value for key, value in asdict(label).items() if key != "variant"}
    scalars = {key: value for key, value in values.items() if value is not None}
    attrs = {key: {k: v for k, v in CASE_COORDS[key].attrs.items() if v} for key in scalars}
    if label.suffix:
        name = case_name(scalars["dlc"], scalars["wind_speed"], scalars["seed"])
        series = series.assign_coords(case=name + label.suffix)
    return series.assign_coords({k: ((), v, attrs[k]) for k, v in scalars.items()})
