"""Friction torque of the crank rig over speed, calculated and as a rig has measured it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.rolling.motion.crank import CrankDrive
from loadflow.rolling.motion.torque import measured_torque
from loadflow.studies.one_bearing.crank_rig import CrankRig, Stage

Floats = NDArray[np.float64]

_UNEVEN = 0.05
"""Share of a step by which samples of the crank's angle may lie off."""

_DRIFT = 0.01
"""Share of the largest velocity that its mean may have over whole turns."""


def rig_torques(
    rig: CrankRig, speeds: tuple[float, ...], stage: Stage, measured: Path | None = None
) -> list[dict[str, float]]:
    """Return torques of each speed: rpm, of all and of each part, N m, and what is measured.

    Parameters
    ----------
    rig : CrankRig
        The rig.
    speeds : tuple of float
        1/min, 0 for the torque at rest; none: those that are measured.
    stage : str
        Of `CrankRig.friction_torque`.
    measured : Path, optional
        Series of a rig; as `measured_torques`. What was measured at a speed stands beside it, with
        how far the calculated torque is off as a share of it.

    Raises
    ------
    loadflow.errors.InputError
        No speed; a speed that was not measured; as `measured_torques` and `CrankRig`.
    loadflow.errors.SolverError
        As `CrankRig.friction_torque`.

    Examples
    --------
    >>> from loadflow.studies.one_bearing.crank_rig import CrankRig
    >>> rows = rig_torques(CrankRig(drive=None), (1000.0, 2000.0), "coulomb")
    >>> [round(row["torque"], 2) for row in rows]
    [0.13, 0.19]
    """
    known = {} if measured is None else measured_torques(measured, rig.drive)
    for rpm in speeds:
        if known and rpm not in known:
            there = ", ".join(f"{one:g}" for one in known)
            raise InputError(f"{measured}: no series at {rpm:g} 1/min; there are {there}")
    if not (speeds or known):
        raise InputError("no speed: give some, or a file that was measured")
    rows = []
    for rpm in speeds or known:
        found = rig.friction_torque(rpm, stage)
        row = {"rpm": rpm, "torque": found.torque}
        if known:
            row |= {"measured": known[rpm], "off": found.torque / known[rpm] - 1}
        rows.append(row | found.torques)
    return rows


def measured_torques(file: str | Path, drive: CrankDrive | None) -> dict[float, float]:
    r"""Friction torque at each speed of series that a crank rig has measured, (7.1), (7.2).

    Parameters
    ----------
    file : path-like
        CSV with a line of heads: ``rpm``, speed of the crank, 1/min, the same in all lines of a
        series; ``force`` on the piston along its travel, N; and its ``velocity``, m/s, or the
        ``angle`` of the crank from top dead centre, °, at even steps. Each series has whole turns.
        Lines that begin with # are comments.
    drive : CrankDrive, optional
        Gives the velocity of the piston from the angle.

    Returns
    -------
    dict
        1/min → N m, in the order of the file; > 0 where the rig takes power.

    Raises
    ------
    InputError
        No such file, heads that are missing, what is no number, turns that are not whole, a series
        without friction, an angle without a drive.

    Examples
    --------
    >>> import tempfile
    >>> import numpy as np
    >>> from loadflow.studies.one_bearing.crank_rig import CrankRig
    >>> angle = np.arange(720.0)  # two turns, a sample each degree
    >>> drive = CrankRig().drive
    >>> velocity = drive.piston(np.radians(angle), 100.0).speed
    >>> lines = [f"954.93,{a},{3.0 * v}" for a, v in zip(angle, velocity)]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "rig.csv"
    ...     _ = file.write_text("\n".join(["rpm,angle,force", *lines]))
    ...     found = measured_torques(file, drive)
    >>> {rpm: round(torque, 3) for rpm, torque in found.items()}  # 3 N s/m, r²ω²/2 and more
    {954.93: 0.277}
    """
    table = _read(Path(file))
    found = {}
    for rpm, one in table.groupby("rpm", sort=False):
        where, speed = f"{file}, {rpm:g} 1/min", float(rpm) * np.pi / 30  # type: ignore[arg-type]
        if not speed > 0:
            raise InputError(f"{where}: rpm must be > 0")
        velocity = _velocity(one, drive, speed, where)
        torque = measured_torque(one["force"].to_numpy(), velocity, speed)
        if not torque > 0:
            raise InputError(
                f"{where}: the mean power of the force is {torque * speed:.3g} W, not a loss; "
                "force and travel must have the same sense"
            )
        found[float(rpm)] = torque  # type: ignore[arg-type]
    return found


def _read(file: Path) -> pd.DataFrame:
    try:
        table = pd.read_csv(file, comment="#", skipinitialspace=True)
    except (OSError, ValueError) as error:
        raise InputError(f"{file}: {getattr(error, 'strerror', None) or error}") from error
    table.columns = table.columns.str.strip()
    missing = [name for name in ("rpm", "force") if name not in table]
    if missing or not {"velocity", "angle"} & {*table.columns}:
        missing = missing or ["velocity (or angle)"]
        raise InputError(
            f"{file}: no column {', '.join(missing)}; there are {', '.join(table.columns)}"
        )
    wanted = [name for name in ("rpm", "force", "velocity", "angle") if name in table]
    numbers = table[wanted].apply(pd.to_numeric, errors="coerce")
    if not len(numbers):
        raise InputError(f"{file}: no samples below the heads")
    bad = ~np.isfinite(numbers.to_numpy(float))
    if bad.any():
        line, column = np.argwhere(bad)[0]
        raise InputError(f"{file}: line {line + 1} of the series, {wanted[column]}: not a number")
    return numbers


def _velocity(one: pd.DataFrame, drive: CrankDrive | None, speed: float, where: str) -> Floats:
    """Velocity of the piston, m/s, over whole turns."""
    if "velocity" in one:
        velocity = one["velocity"].to_numpy(float)
        if abs(velocity.mean()) > _DRIFT * np.abs(velocity).max():
            raise InputError(
                f"{where}: the mean velocity is {velocity.mean():.3g} m/s; turns must be whole"
            )
        return velocity
    if drive is None:
        raise InputError(f"{where}: a straight shaft has no piston; give its velocity")
    angle = one["angle"].to_numpy(float)
    steps = np.diff(angle)
    step = steps.mean() if steps.size else np.nan
    if not (step > 0 and np.abs(steps - step).max() <= _UNEVEN * step):
        raise InputError(f"{where}: angle must rise in even steps")
    turns = angle.size * step / 360
    if round(turns) < 1 or abs(turns - round(turns)) * 360 > 0.5 * step:
        raise InputError(f"{where}: {turns:.4g} turns of the crank; they must be whole")
    return drive.piston(np.radians(angle), speed).speed
