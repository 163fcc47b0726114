"""A record for the tests of the reduction."""

import numpy as np


def record(n, seed=0):
    """Correlated speed and force of the size of the 5 MW turbine's main bearing."""
    rng = np.random.default_rng(seed)
    slow = np.cumsum(rng.standard_normal((3, n)), axis=1)
    slow = (slow - slow.mean(axis=1, keepdims=True)) / max(slow.std(), 1e-9)
    noise = rng.standard_normal((2, n))
    speed = 1.2 + 0.03 * slow[0]
    force = np.stack([2e6 + 1e5 * slow[1] + 1e5 * noise[0], 1e5 * slow[2] + 1e5 * noise[1]], 1)
    return speed, force, 0.025 * np.arange(n)
