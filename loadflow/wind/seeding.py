"""Random seeds that depend on what is simulated, not on the order in which it is.

A seed is a function of the scene's seed, the load case, the wind speed and the index of the
realisation. So a case gives the same wind whether it runs alone, in a set, or again after a crash,
and no two wind speeds share their random numbers.
"""

from __future__ import annotations

from zlib import crc32

import numpy as np

from loadflow.errors import InputError

Seed = int | np.random.SeedSequence


def case_seed(dlc: str, wind_speed: float, index: int, base: int = 0) -> np.random.SeedSequence:
    """Seed of one realisation of a load case.

    Parameters
    ----------
    dlc : str
        Design load case, e.g. ``"1.1"``.
    wind_speed : float
        Mean speed at the hub, m/s; speeds that differ by a micrometre a second differ in seed.
    index : int
        Index of the realisation.
    base : int
        Seed of the whole scene.

    Returns
    -------
    numpy.random.SeedSequence
        Independent of those of all other load cases, speeds, indices and bases, and the same on
        every machine.

    Raises
    ------
    InputError
        If the speed, the index or the base is negative.

    Examples
    --------
    >>> from loadflow.wind import case_seed
    >>> [int(x) for x in case_seed("1.1", 12.0, 1).generate_state(2)]
    [1798477470, 1995373387]
    """
    if not 0 <= wind_speed < 4000:  # in µm/s it has to fit into one 32-bit word of the key
        raise InputError(f"wind speed = {wind_speed} m/s must not be negative")
    if index < 0 or base < 0:
        raise InputError(f"seed index = {index} and base = {base} must not be negative")
    # crc32, not hash(): the same in every process and on every machine
    key = (crc32(dlc.encode()), round(wind_speed * 1e6), index)
    return np.random.SeedSequence(entropy=base, spawn_key=key)


def as_sequence(seed: Seed) -> np.random.SeedSequence:
    """A plain number as a `numpy.random.SeedSequence`; a sequence passes through."""
    if isinstance(seed, np.random.SeedSequence):
        return seed
    if seed < 0:
        raise InputError(f"seed = {seed} must not be negative")
    return np.random.SeedSequence(seed)


def child(seed: np.random.SeedSequence, index: int) -> np.random.SeedSequence:
    """Child number `index`; unlike ``spawn`` it leaves `seed` as it is, for another use."""
    key = (*seed.spawn_key, index)
    return np.random.SeedSequence(entropy=seed.entropy, spawn_key=key, pool_size=seed.pool_size)
