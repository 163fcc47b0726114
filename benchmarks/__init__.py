"""Measurements, started from the root of the repository; no part of the package.

``ladder`` measures every rung of every stage for `loadflow plan`; ``peers`` puts the package beside
other ones, ``references`` beside finer or complete solutions of its own; ``robustness`` looks for
input that it does not survive. `common` is what they share.
"""
