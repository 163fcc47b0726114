"""What a report says of the seeds of a run."""

import xarray as xr

from loadflow.running.pages.seeds import _merge_table, answer


def verdicts_of(merge, together):
    variants = ["as-printed", "calibrated"]
    return xr.Dataset(
        {
            "may_merge": (("variant", "group"), merge),
            "together": ("group", together),
            "dlc": ("group", ["1.1", "1.1"]),
            "wind_speed": ("group", [12.0, 14.0]),
            "seeds": ("group", [6, 6]),
            "pvalue": (("group", "component"), [[1.0] * 7] * 2),
        },
        {"variant": variants},
    )


ONE, TWO = "{1, 2} (1 stands …). equal", "{1} {2}. groups 1 and 2: spread differs (p = 0.0014)"


def test_seeds_that_differ_at_one_wind_speed_alone_are_said_to_be_chance_and_merged():
    seeds = verdicts_of([[0, 0], [1, 1]], [ONE, TWO])
    assert answer(seeds) == (
        "By the calibrated tests, seeds may be merged at 2 of 2 wind speeds (as-printed: 0 of 2, "
        "not valid). Those of 14 m/s differ only if that wind speed is tested alone: among the 14 "
        "tests of this run such a difference may be chance (Holm's correction), so that they "
        "may be merged."
    )
    assert [row[-1] for row in _merge_table(seeds).rows] == [
        ONE,
        f"all; this wind speed alone: {TWO}",
    ]


def test_seeds_that_may_not_be_merged_keep_their_groups():
    seeds = verdicts_of([[0, 0], [1, 0]], [ONE, TWO])
    assert answer(seeds).endswith("at 1 of 2 wind speeds (as-printed: 0 of 2, not valid).")
    assert _merge_table(seeds).rows[1][-1] == TWO


def test_printed_tests_alone_are_said_not_to_be_valid():
    seeds = verdicts_of([[0, 0], [1, 1]], [ONE, TWO]).isel(variant=[0])
    assert answer(seeds) == "Seeds may be merged by tests as-printed: 0 of 2, which are not valid."
    assert _merge_table(seeds).rows[1][-1] == TWO
