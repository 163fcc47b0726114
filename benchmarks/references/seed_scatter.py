"""How far answers of the main job scatter with one seed; writes loadflow/data/seed_scatter.json.

loadflow run pipelines/dlc_1_1.toml --out RUNS
python -m benchmarks.references.seed_scatter RUNS/dlc_1_1
"""

from __future__ import annotations

import json
from pathlib import Path

from benchmarks.common import ROOT, arguments
from loadflow.running.folder import results_of
from loadflow.scene import read_scene
from loadflow.studies.lifetime.finished_run import known_shares
from loadflow.studies.seeds.intervals import Groups
from loadflow.studies.seeds.scatter import scatter_of_one_seed, table_of_cases

FILE = ROOT / "loadflow" / "data" / "seed_scatter.json"


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("run", type=Path, help="folder of a finished run of pipelines/dlc_1_1.toml")
    run = parser.parse_args().run
    tables = results_of(run) or {}
    table = table_of_cases(tables)
    if table is None:
        parser.error("no finished run there")
    groups = Groups.of(table)
    found = scatter_of_one_seed(tables, known_shares(tables, table))
    data = {
        "about": "half width of the 95 % interval that one seed of each wind speed leaves, over "
        f"the answer; pipelines/dlc_1_1.toml, {min(groups.sizes)} seeds of each wind speed",
        "wind_speeds": len(groups.sizes),
        "duration": read_scene(run / "scene.toml").loads.duration,
        "half_width": {answer: float(f"{value:.2g}") for answer, value in found.items()},
    }
    FILE.write_text(json.dumps(data, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
