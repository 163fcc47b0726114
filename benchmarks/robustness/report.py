"""Size of the report page of a finished run, and processor time to write it.

python -m benchmarks.robustness.report RUN

docs/scale.md has the numbers of pipelines/dlc_1_1.toml: 66 load cases of 24,000 steps.
"""

from __future__ import annotations

import re
from pathlib import Path

from benchmarks.common import arguments, head, row, timed


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("run", type=Path, help="folder of a finished run")
    run = parser.parse_args().run

    _, loading = timed(_load)
    from loadflow.running.folder import read_manifest
    from loadflow.running.pages.report import write_report

    page, first = timed(lambda: write_report(run, again=True))
    _, again = timed(lambda: write_report(run, again=True), repeat=3)
    _, unchanged = timed(lambda: write_report(run), repeat=3)
    text = page.read_text(encoding="utf-8")
    print(head("load cases", "MB", "figures", "charts", "modules, s", "first, s", "again, s",
               "unchanged, s", numbers=True))  # fmt: skip
    print(row(
        len(read_manifest(run)["cases"]), f"{page.stat().st_size / 1e6:.2f}",
        len(re.findall("<svg |<img ", text)), text.count('<div class="chart"'),
        f"{loading:.2f}", f"{first:.2f}", f"{again:.2f}", f"{unchanged:.3f}",
    ))  # fmt: skip


def _load() -> None:
    import loadflow.report.figures
    import loadflow.running.pages.report  # noqa: F401


if __name__ == "__main__":
    main()
