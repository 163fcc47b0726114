"""What a load cube answers by itself: ``cube.lf.statistics()``, ``.del_(m=4)``, ``.spectrum()``."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from loadflow.cube import iter_cases, time_step
from loadflow.errors import InputError
from loadflow.numerics.shown import FEW
from loadflow.reduction import damage_equivalent_load
from loadflow.stages.statistics import STATISTICS, describe
from loadflow.studies.channels import channel, channel_names, choose_channels

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SEGMENTS = 8
"""Parts of a series whose spectra are averaged, half overlapping."""


class LoadflowAccessor:
    """Statistics, equivalent loads and spectra of the series of a load cube.

    Every method takes names of channels, such as ``hub_moment.y``, or of variables for all their
    channels; without names the rotor speed and all loads that are not zero.

    Parameters
    ----------
    cube : xarray.Dataset
        A load cube, or one case of it.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.cube import make_case, make_cube
    >>> time = np.arange(0, 60, 0.1)
    >>> moment = np.stack([0 * time, 1e6 * np.sin(time), 0 * time])
    >>> data = {"speed": 1.2 + 0 * time, "hub_force": 0 * moment, "hub_moment": moment}
    >>> cube = make_cube([make_case(time, data, dlc="1.1", wind_speed=8.0, seed=1)])
    >>> cube.lf.channels()
    ['speed', 'hub_moment.y']
    >>> largest = cube.lf.statistics("hub_moment.y").sel(statistic="max")
    >>> round(largest.item() / 1e6, 2)
    1.0
    """

    def __init__(self, cube: xr.Dataset) -> None:
        self._cube = cube

    def __repr__(self) -> str:
        _, first = next(iter_cases(self._cube))  # by its names alone: no series is read
        names = [name for parts in channel_names(first).values() for name in parts]
        few = ", ".join(names[:FEW]) + (", …" if len(names) > FEW else "")
        return f"<loadflow: {few}; .statistics(), .del_(m=4), .spectrum(), .plot()>"

    def channels(self, *wanted: str) -> list[str]:
        """Names of the wanted channels.

        Raises
        ------
        loadflow.errors.InputError
            The cube has no such channel.
        """
        if others := [name for name in wanted if not isinstance(name, str)]:
            raise InputError(
                f"channels are names, got {others[0]!r}; an exponent is m={others[0]!r}"
            )
        found = [choose_channels(case.load(), wanted) for _, case in iter_cases(self._cube)]
        return list(dict.fromkeys(name for names in found for name in names))

    def statistics(self, *wanted: str) -> xr.DataArray:
        """Mean, standard deviation, extremes … of each case and channel.

        Returns
        -------
        xarray.DataArray
            Over ``case``, ``channel`` and ``statistic``, in the units of the coordinate ``units``
            (skewness and kurtosis have none). What is no force or moment has NaN as its
            damage-equivalent load.
        """
        return self._each(
            wanted,
            lambda series: describe(series.to_dataset(name="x"))["x"].values,
            ("statistic",),
            {"statistic": list(STATISTICS)},
            "statistics of the series",
            "",
        )

    def del_(
        self, *wanted: str, m: float | Sequence[float] = 4.0, f_eq: float = 1.0
    ) -> xr.DataArray:
        """Damage equivalent load of each case and channel.

        Parameters
        ----------
        *wanted : str
            Channels.
        m : float or sequence of float
            Wöhler exponents.
        f_eq : float
            Frequency of the equivalent sine, Hz.

        Returns
        -------
        xarray.DataArray
            Over ``case``, ``channel`` and ``m``, in the units of the coordinate ``units``; the
            attribute ``units`` is there where these are one.

        Raises
        ------
        loadflow.errors.InputError
            An exponent or frequency that is not > 0; a channel that the cube has not.
        """
        exponents = np.atleast_1d(np.asarray(m, dtype=float))

        def found(series: xr.DataArray) -> np.ndarray:
            time = series["time"].values
            duration = time[-1] - time[0]
            return np.asarray(
                damage_equivalent_load(series.values, exponents.tolist(), duration, f_eq)
            )

        name = f"damage equivalent load at {f_eq:g} Hz"
        return self._each(wanted, found, ("m",), {"m": exponents}, name)

    def spectrum(self, *wanted: str) -> xr.DataArray:
        """Power spectral density of each case and channel [Welch 1967].

        Returns
        -------
        xarray.DataArray
            Over ``case``, ``channel`` and ``frequency``, Hz; in the units of the coordinate
            ``units``; the attribute ``units`` is there where these are one.
        """
        from scipy.signal import welch

        time = self._cube["time"].values
        length = max(2, 2 * time.size // (SEGMENTS + 1))
        step = time_step(self._cube)

        def density(series: xr.DataArray) -> np.ndarray:
            values = series.values.astype(float)
            return np.asarray(welch(values, 1 / step, nperseg=length)[1])

        frequency = np.fft.rfftfreq(length, step)
        found = self._each(
            wanted,
            density,
            ("frequency",),
            {"frequency": frequency},
            "power spectral density",
            "({})^2/Hz",
        )
        found["frequency"].attrs = {"units": "Hz", "long_name": "frequency"}
        return found

    def plot(self, *wanted: str) -> Figure:
        """Draw the channels of all cases over time, one frame for each channel."""
        from loadflow.plots.style import envelope, figure, readable

        names = self.channels(*wanted)
        drawing, axes = figure(len(names), sharex=True, height=1.6, squeeze=False)
        for case, series in self._cases():
            for axis, name in zip(axes[:, 0], names):
                data = channel(series, name)
                values, unit = readable(data)
                envelope(axis, series["time"].values, values, case)
                axis.set_ylabel(f"{name},\n{unit}")
        axes[-1, 0].set_xlabel("time, s")
        if self._cube.sizes.get("case", 1) > 1:
            axes[0, 0].legend(ncols=4, loc="upper right")
        return drawing

    def _cases(self) -> Iterator[tuple[str, xr.Dataset]]:
        for name, case in iter_cases(self._cube):
            yield name, case.load()

    def _each(
        self,
        wanted: Sequence[str],
        work: Callable[[xr.DataArray], np.ndarray],
        dims: tuple[str, ...],
        coords: dict[str, Any],
        meaning: str,
        unit: str = "{}",
    ) -> xr.DataArray:
        """What is found of every channel of every case, as one array.

        The coordinate ``units`` has `unit` of that of each channel; without one they are those of
        the series, but not of every value. Where they are not one, the array has no attribute of
        that name, which libraries of units would read as one.
        """
        names = self.channels(*wanted)
        cases, rows, units = [], [], [""] * len(names)
        for case, series in self._cases():
            parts = [channel(series, name) for name in names]
            units = [str(part.attrs.get("units", "1")) for part in parts]
            rows.append([work(part) for part in parts])
            cases.append(case)
        units = [unit.format(one) for one in units] if unit else units
        common = {"units": units[0]} if unit and len(set(units)) == 1 else {}
        return xr.DataArray(
            np.array(rows),
            {"case": cases, "channel": names, "units": ("channel", units), **coords},
            ("case", "channel", *dims),
            meaning.replace(" ", "_"),
            common | {"long_name": meaning},
        )
