"""Coloured noise for the statistical tests."""

import numpy as np
from scipy.signal import lfilter


def ar1(rng, shape, dt, tau):
    """Gaussian noise of variance one and correlation exp(−t/tau), stationary from the start."""
    a = np.exp(-dt / tau)
    e = rng.standard_normal(shape)
    e[..., 0] /= np.sqrt(1 - a * a)
    return lfilter([np.sqrt(1 - a * a)], [1, -a], e, axis=-1)


def load_like(rng, shape, dt, tau=2.0, tone=1.0, frequency=0.6):
    """Slow turbulence and a 3p tone of random phase."""
    t = dt * np.arange(shape[-1])
    phase = rng.uniform(0, 2 * np.pi, shape[:-1])[..., None]
    tones = tone * np.sin(2 * np.pi * frequency * t + phase)
    return ar1(rng, shape, dt, tau) + tones
