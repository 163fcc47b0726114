"""Names of load files as campaigns write them: what each says, and what it leaves open."""

from pathlib import Path

import pytest

from loadflow.errors import InputError
from loadflow.readers import list_names, read_loads
from loadflow.readers.names import label_from_name, plain_dlc
from loadflow.studies.lifetime.extreme_loads import safety_factor
from loadflow.wind.cases import row_of

NAMES = {
    # DTU, HAWC2
    "dlc12_wsp08_wdir000_s1001.sel": ("1.2", 8.0, 1001),
    "dlc12_wsp04_wdir350_s3001.dat": ("1.2", 4.0, 3001),
    "DLC12_wsp03_wdir350_s1001.hdf5": ("1.2", 3.0, 1001),
    "dlc13_wsp04_wdir000_s023004.hdf5": ("1.3", 4.0, 23004),
    "dlc14_wsp12_wdir000_s0000.sel": ("1.4", 12.0, 0),
    "dlc22b_wsp12_wdir000_s1005.sel": ("2.2b", 12.0, 1005),
    "dlc31_wsp25_wdir000_s0000.sel": ("3.1", 25.0, 0),
    "dlc61_wsp50_wdir008_s6101.sel": ("6.1", 50.0, 6101),
    "dlc10_powercurve_wsp08.sel": ("1.0", 8.0, None),
    "iea_22mw_rwt_steps.sel": ("steps", None, None),
    # WEIS and pCrunch: the numbers behind the load case count cases
    "DLC1.1_0_NREL5MW_OC3_spar_3.outb": ("1.1", None, None),
    "DLC6.1_1_IEA_22_Semi_1.outb": ("6.1", None, None),
    "DLC1.6_0.outb": ("1.6", None, None),
    "DLC2.3_1.out": ("2.3", None, None),
    "IEA15_DLC1.1_0_ws12.0_seed3.outb": ("1.1", 12.0, 3),
    "IEA15_DLC1.1_0_ws12.0_seed3": ("1.1", 12.0, 3),
    "IEA-22-280-RWT_DLC1.2_12.5mps_seed_17.outb": ("1.2", 12.5, 17),
    # scripts around OpenFAST
    "nrel5mw_dlc11_v04_s1.outb": ("1.1", 4.0, 1),
    "nrel5mw_steady_v12.outb": ("steady", 12.0, None),
    "nrel5mw_startup_v12.outb": ("startup", 12.0, None),
    "IEA-15-240-RWT_v1.1_dlc12_v12_s1.outb": ("1.2", 12.0, 1),
    "IEA-15-240_dlc13_v25_s006.outb": ("1.3", 25.0, 6),
    "V164-8.0MW_dlc12_wsp10_wdir000_s1.outb": ("1.2", 10.0, 1),
    "DLC6.2a_ws11.4_seed3.outb": ("6.2a", 11.4, 3),
    "DLC1p1_U12p5_Seed7.outb": ("1.1", 12.5, 7),
    "DLC_1_1_ws_12_seed_3.outb": ("1.1", 12.0, 3),
    "DLC1.1-v12-s1.outb": ("1.1", 12.0, 1),
    "DLC1.2_NTM_U12.0_Seed3.outb": ("1.2", 12.0, 3),
    "WT_DLC1.3ETM_V24_S06.out": ("1.3", 24.0, 6),
    "IEA_15MW_dlc-1.2_vhub12_seed-4.outb": ("1.2", 12.0, 4),
    "BAR_wind_speed_12_seed_3.outb": (None, 12.0, 3),
    "TurbSim_12mps_Seed1.outb": (None, 12.0, 1),
    "case_ws08.0_sd01.outb": (None, 8.0, 1),
    "U08_TI06_s3.outb": (None, 8.0, 3),
    "NTM_12mps_1.outb": ("ntm", 12.0, None),
    "90m_12mps_twr.bts": (None, 12.0, None),
    "5MW_Land_DLL_WTurb.outb": (None, None, None),
    "AOC_WSt.outb": (None, None, None),
    # Bladed
    "Steady_8ms.$04": ("steady", 8.0, None),
    "1.2a_v12_s3.$23": ("1.2a", 12.0, 3),
    "1.2_12.0_3.%23": ("1.2", 12.0, 3),
    "dlc12v10s1.$PJ": ("1.2", 10.0, 1),
    "demo_a_44.$23": (None, None, None),
    # own series
    "11_v04_s1.csv": ("1.1", 4.0, 1),
    "run_007.csv": (None, None, None),
}


@pytest.mark.parametrize(("name", "said"), NAMES.items())
def test_names_of_public_campaigns_are_understood(name, said):
    label = label_from_name(Path("some/folder_v3_s9") / name)
    assert (label.dlc, label.wind_speed, label.seed) == said


def test_the_preview_reads_no_file(tmp_path):
    absent = [str(tmp_path / name) for name in NAMES]
    assert {file: (x.dlc, x.wind_speed, x.seed) for file, x in list_names(absent)} == {
        str(tmp_path / name): said for name, said in NAMES.items()
    }


def test_in_the_preview_a_pattern_or_list_stands_above_the_names(tmp_path):
    names = ["x_12_1.outb", "other.outb"]
    [(_, fits), (_, other)] = list_names(names, pattern="x_{wind_speed}_{seed}")
    assert (fits.dlc, fits.wind_speed, fits.seed) == (None, 12.0, 1)
    assert (other.dlc, other.wind_speed, other.seed) == (None, None, None)
    table = tmp_path / "cases.txt"
    table.write_text("file,dlc\nx_12_1.outb,6.2\n")
    assert [label.dlc for _, label in list_names(names, cases=table)] == ["6.2", None]


def test_a_pattern_or_list_that_says_nothing_of_any_file_is_refused_in_the_preview(tmp_path):
    names = ["x_12_1.outb", "other.outb"]
    with pytest.raises(InputError, match=r"x_12_1.outb: the name does not fit .* of 2 files"):
        list_names(names, pattern="y_{seed}")
    table = tmp_path / "cases.txt"
    table.write_text("file,dlc\nthird.outb,6.2\n")
    with pytest.raises(InputError, match="does not name this file"):
        list_names(names[:1], cases=table)


def test_a_malformed_pattern_is_refused_in_the_preview_too():
    with pytest.raises(InputError, match="must name one or more"):
        list_names(["a.outb"], pattern="nothing")
    with pytest.raises(InputError, match="no load file"):
        list_names([])


def test_wind_directions_of_one_seed_are_cases_of_their_own(tmp_path):
    from openfast_files import channels, write_outb

    for i, direction in enumerate((350, 0, 10)):
        name = f"dlc12_wsp12_wdir{direction:03d}_s1001.outb"
        write_outb(tmp_path / name, channels(seed=i))
    cube = read_loads(tmp_path, quiet=True)
    assert sorted(cube.case.values) == [
        "dlc1.2_v12_s1001",
        "dlc1.2_v12_s1001_wdir010",
        "dlc1.2_v12_s1001_wdir350",
    ]
    assert set(cube.seed.values) == {1001}


@pytest.mark.parametrize(
    ("text", "plain", "standard"),
    [
        ("DLC1.3", "1.3", "1.3"),
        ("62a", "6.2a", "6.2"),
        ("DLC 1.3 ETM", "1.3", "1.3"),
        ("6.2 EWM", "6.2", "6.2"),
        ("2.2y", "2.2y", "2.2"),
        ("shutdown", "shutdown", "shutdown"),
        ("unknown", "unknown", "unknown"),
    ],
)
def test_variants_belong_to_a_load_case_of_the_standard(text, plain, standard):
    assert plain_dlc(text) == plain
    row = row_of(plain_dlc(text))
    assert (plain if row is None else row.dlc) == standard


def test_load_cases_by_other_names_keep_their_safety_factor():
    assert safety_factor("6.2a") == safety_factor("DLC62") == safety_factor("6.2") == 1.1
    assert safety_factor("dlc13 ETM") == 1.35
    assert safety_factor("steady") == safety_factor("9.9") == 1.0
