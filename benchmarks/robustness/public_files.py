"""Public load files of other programs, offered to the readers: read, mapped, or refused.

The files stay where they are: each is taken from a clone of its repository, at the commit below,
into a temporary folder. Clones lie in one folder as OWNER/NAME; those that are absent are made.

    python -m benchmarks.robustness.public_files CLONES    # the table of docs/reliability.md
"""

from __future__ import annotations

import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from benchmarks.common import arguments, head, row
from loadflow.errors import InputError
from loadflow.readers import read_loads

COMMITS = {
    "NREL/pCrunch": "da3a7eec3fce409d81bb331efd1abe0ee0566624",
    "OpenFAST/openfast_toolbox": "d34b283c1aa1ab2360634a51a6ea95f3fbbdefeb",
    "ebranlard/welib": "6c8f155c1b7f4fb3fb7da6273f3b9509f177995e",
    "DTUWindEnergy/WindEnergyToolbox": "0accfb1c8ef2e8957e7f04ce19d79c6210fa488b",
    "mathieupelle/HAWC2": "283590fc7b0a057e0056dccba65a8f032a574209",
}
PCRUNCH, TOOLBOX, WELIB, WETB, PELLE = COMMITS
EXAMPLES = "openfast_toolbox/io/tests/example_files/"
RUNS = "pCrunch/test/data/"
HAWC2 = "wetb/hawc2/tests/test_files/"
SPAR = "welib/yams/papers/2022-symbolic-framework/"
GAUGE = {"gauge_distance": 1.912}
"""ShftGagL of the NREL 5 MW turbine, of which these files are."""


@dataclass(frozen=True)
class File:
    """A public file, how it is read, and what is to come of it.

    Attributes
    ----------
    repository, path : str
        Where it is.
    outcome : str
        "read", or words of the message it is refused with.
    options : dict
        Arguments of `read_loads`; with them a file that is read is "mapped".
    """

    repository: str
    path: str
    outcome: str = "read"
    options: dict[str, Any] = field(default_factory=dict)


FILES = (
    *(File(PCRUNCH, f"{RUNS}DLC1p1/DLC1.1_0_NREL5MW_OC3_spar_{i}.outb") for i in range(5)),
    File(PCRUNCH, f"{RUNS}step_0.outb"),
    *(File(PCRUNCH, f"{RUNS}Test{i}.outb", options=GAUGE) for i in (1, 2, 3)),
    *(File(PCRUNCH, f"{RUNS}DLC2.3_{i}.out", options=GAUGE) for i in (1, 2, 3)),
    File(PCRUNCH, f"{RUNS}AOC_WSt.out", "'LSSTipMys' for 'hub_moment_y'"),
    File(PCRUNCH, f"{RUNS}AOC_WSt.outb", "'LSSTipMys' for 'hub_moment_y'"),
    File(TOOLBOX, "data/example_files/fastout_allnodes.outb"),
    File(TOOLBOX, f"{EXAMPLES}FASTOutBin_ID4.outb"),
    File(TOOLBOX, f"{EXAMPLES}FASTOutBin.outb", "6 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}FASTOut.out", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}FASTOut_Hydro.out", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}BModesOut.out", "no OpenFAST text output"),
    File(TOOLBOX, f"{EXAMPLES}FLEXDocFile.out", "no OpenFAST text output"),
    File(TOOLBOX, f"{EXAMPLES}Bladed_out_binary_case2.%23", "channel 'Rotor speed'"),
    File(TOOLBOX, f"{EXAMPLES}Bladed_out_ascii.%04", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}Bladed_out_binary.%04", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}Bladed_out_ascii.%41", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}Bladed_out_binary.%41", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}Bladed_out_binary_case2_fail.%55", "no group over time"),
    File(TOOLBOX, f"{EXAMPLES}HAWC2_out_ascii.sel", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}HAWC2_out_bin.sel", "7 channels are missing"),
    File(TOOLBOX, f"{EXAMPLES}BHAWC_out_ascii.sel", "no list of HAWC2 channels"),
    File(TOOLBOX, f"{EXAMPLES}BHAWC_out_ascii1.sel", "no list of HAWC2 channels"),
    File(WELIB, "data/example_files/fastout_allnodes.outb"),
    File(WELIB, "data/example_files/ad_driver_yaw.1.outb", "6 channels are missing"),
    File(WELIB, "data/Spar/Main_Spar_ED_HydroExample.outb", "4 channels are missing"),
    File(WELIB, f"{SPAR}F0T2N0S1/Main_Spar_ED.outb", "7 channels are missing"),
    File(WELIB, f"{SPAR}F2T1RNA_SmallAngle/Main_Spar_ED.outb", "7 channels are missing"),
    *(
        File(WETB, f"wetb/fast/tests/test_files/5MW_Land_BD_DLL_WTurb_fid0{i}.outb",
             "5 channels are missing")
        for i in (2, 3, 4)
    ),
    File(WETB, "wetb/fast/tests/test_files/DTU10MW.out", "5 channels are missing"),
    File(WETB, "wetb/fatigue_tools/tests/test_files/test.sel", "6 channels are missing"),
    File(WETB, "wetb/fatigue_tools/tests/test_files/test_bearing_damage.sel",
         "7 channels are missing"),
    File(WETB, "wetb/hawc2/tests/test_files/hawc2io/Hawc2ascii.sel", "7 channels are missing"),
    File(WETB, "wetb/hawc2/tests/test_files/hawc2io/Hawc2bin.sel", "7 channels are missing"),
    File(WETB, "wetb/hawc2/tests/test_files/cmp_test_cases/ref/test1.sel",
         "6 channels are missing"),
    *(File(WETB, f"wetb/dlc/tests/test_files/res/{name}.sel", "a HAWC2 run needs .sel and .dat")
      for name in ("dlc12_iec61400-1ed3/dlc12_wsp04_wdir350_s3001",
                   "dlc12_iec61400-1ed3/dlc12_wsp04_wdir350_s4001",
                   "dlc31_iec61400-1ed3/dlc31_wsp25_wdir000_s0000")),
    File(WETB, "wetb/fast/tests/test_files/FASTOut_Hydro.out", "7 channels are missing"),
    File(WETB, "wetb/hawc2/ascii2bin/tests/test_files/Hawc2ascii.sel", "7 channels are missing"),
    File(WETB, "wetb/hawc2/ascii2bin/tests/test_files/Hawc2bin.sel", "7 channels are missing"),
    File(WETB, f"{HAWC2}cmp_test_cases/ref/test3.sel", "6 channels are missing"),
    File(WETB, f"{HAWC2}cmp_test_cases/test1/test1.sel", "6 channels are missing"),
    File(WETB, f"{HAWC2}cmp_test_cases/test1/test3.sel", "6 channels are missing"),
    *(File(WETB, f"{HAWC2}hawc2io/{name}.sel", "a HAWC2 run needs .sel and .dat")
      for name in ("hawc2ascii_chantest_1", "hawc2bin_chantest_2", "hawc2bin_chantest_3")),
    File(WETB, "wetb/gtsdf/tests/test_files/test.hdf5", "6 channels are missing"),
    File(WETB, "wetb/signal/tests/test_files/azi.hdf5", "7 channels are missing"),
    File(WETB, "wetb/wind/tests/test_files/shear.hdf5", "7 channels are missing"),
    File(WETB, "wetb/wind/tests/test_files/shear_noturb.hdf5", "7 channels are missing"),
    File(WETB, "wetb/wind/tests/test_files/wind3.hdf5", "7 channels are missing"),
    File(WETB, "wetb/utils/tests/test_files/SonicDataset.hdf5", "7 channels are missing"),
    File(PELLE, "V1/results/hawc2/airfoil/dtu_10mw_rwt_05.0_21716.sel", "a pointer of Git LFS"),
    File(PELLE, "V2/results/hawc2/airfoil/v2_turb_08.0_15536.sel", "a pointer of Git LFS"),
    File(PELLE, "V2/results/hawc2/control/f0.05_eta0.7.sel", "a pointer of Git LFS"),
)  # fmt: skip


def outcome(file: File, clones: Path) -> str:
    """Read one file; return "read", or the message of its refusal."""
    with tempfile.TemporaryDirectory() as folder:
        source = PurePosixPath(file.path)
        for name in _siblings(file, clones):
            content = _git(clones / file.repository, "show", f"{_commit(file)}:{name}")
            (Path(folder) / PurePosixPath(name).name).write_bytes(content)
        cases = Path(folder) / "cases.txt"  # names of test files tell no case
        cases.write_text(f"file,dlc,wind_speed,seed\n{source.name},1.1,10,1\n")
        try:
            read_loads(Path(folder) / source.name, cases=cases, quiet=True, **file.options)
        except InputError as error:
            return str(error)
        return "read"


def clone(repository: str, clones: Path) -> None:
    """Clone a repository without its large files, if it is not there."""
    target = clones / repository
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        url = f"https://github.com/{repository}"
        subprocess.run(["git", "clone", "--quiet", "--filter=blob:none", url, target], check=True)


def _siblings(file: File, clones: Path) -> list[str]:
    """Return the file and those of the same run, which differ in the suffix."""
    source = PurePosixPath(file.path)
    listed = _git(clones / file.repository, "ls-tree", "--name-only", _commit(file),
                  f"{source.parent}/").decode().splitlines()  # fmt: skip
    stem = source.name.rsplit(".", 1)[0]
    return [name for name in listed if PurePosixPath(name).name.rsplit(".", 1)[0] == stem]


def _commit(file: File) -> str:
    return COMMITS[file.repository]


def _git(repository: Path, *arguments: str) -> bytes:
    done = subprocess.run(["git", "-C", repository, *arguments], check=True, capture_output=True)
    return done.stdout


def main(clones: Path) -> None:
    print(head("repository", "file", "outcome"))
    differing = []
    for file in FILES:
        clone(file.repository, clones)
        if file.outcome not in (found := outcome(file, clones)):
            differing.append(f"{file.path}: {found}")
        told = ("mapped" if file.options else "read") if found == "read" else "refused: "
        reason = "" if found == "read" else file.outcome.replace("|", "")
        print(row(file.repository, f"`{file.path}`", f"{told}{reason}"))
    if differing:
        raise SystemExit("\n".join(["not as expected:", *differing]))


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("clones", type=Path, help="folder of clones, OWNER/NAME")
    main(parser.parse_args().clones)
