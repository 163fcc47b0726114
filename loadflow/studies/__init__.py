"""What a command makes of a load cube, of one bearing or of finished runs, without running a scene.

===============  =========================================================================
`statistics`     of every case; `channels`: its single series; `accessor`: ``cube.lf``
`bearing_series` loads of the bearings of a cube; `simulated_cube`: a cube without a run;
                 `wind_conditions`: those of IEC 61400-1
`shaft_through`  the shaft of a suspension; `tolerances`: bands by tolerances of values
`seeds`          which are equal, which belong together, whether they are enough
`lifetime`       fatigue, revolutions, extremes and energy of a lifetime
`design_loads`   fewer loads to calculate with, and what that costs
`one_bearing`    one bearing under one load or one series
`verdicts`       numbers of a run beside their limits
`candidate`      numbers of one arrangement, how far from their limits, how sure
`design`         the best bearing
`compare`        several candidates for the same places
===============  =========================================================================

Each folder uses those above it only.
"""
