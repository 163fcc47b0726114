"""Pictures of the pages for README.md, made anew by a headless Chromium.

python -m benchmarks.robustness.screenshots --comparison RUN --run RUN

`--comparison` is a folder that `loadflow compare` left, `--run` one of `loadflow run` with journal
bearings. Small palettes keep each picture below 200 kB.
"""

from __future__ import annotations

import asyncio
import base64
import io
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

from PIL import Image

from benchmarks.common import ROOT, arguments

sys.path.append(str(ROOT / "tests"))
from browser import BROWSER, Browser

PLACE = ROOT / "docs" / "images"
LARGEST = 200_000
COLOURS = (128, 64, 32)

SETTLED = 3.0
"""Seconds from the first words to the last figure."""


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--comparison", type=Path, help="folder of a comparison")
    parser.add_argument("--run", type=Path, help="folder of a run with journal bearings")
    asked = parser.parse_args()
    PLACE.mkdir(exist_ok=True)
    if asked.comparison:
        page = (asked.comparison / "compare.html").resolve().as_uri()
        keep("compare", screenshot(page, 1500, 1150, "main bearings compared"))
    if asked.run:
        report = (asked.run / "report.html").resolve().as_uri()
        keep("report", screenshot(report, 1150, 900, "Loads", at="#loads .chart"))
        keep("orbit", orbit_of(asked.run))
        with dashboard(asked.run) as address:
            keep("dashboard", screenshot(f"{address}?tab=2", 1050, 890, "bearing", "picture"))


def screenshot(address: str, width: int, height: int, *words: str, at: str = "body") -> Image.Image:
    """Picture of a page from an element on, as soon as it shows some words."""
    if BROWSER is None:
        raise SystemExit("no Chromium on this machine")

    async def look(folder: str) -> bytes:
        async with Browser(Path(folder)) as browser:
            await browser.call(
                "Emulation.setDeviceMetricsOverride",
                width=width, height=height, deviceScaleFactor=1, mobile=False,
            )  # fmt: skip
            await browser.open(address)
            await browser.shows(*words)
            for _ in range(2):  # charts are drawn when they are seen, and move what is below
                await browser.evaluate(f"document.querySelector('{at}').scrollIntoView()")
                await asyncio.sleep(SETTLED)
            found = await browser.call("Page.captureScreenshot", format="png")
            return base64.b64decode(found["data"])

    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        return Image.open(io.BytesIO(asyncio.run(look(folder)))).convert("RGB")


def orbit_of(run: Path) -> Image.Image:
    """Orbit of the first journal bearing in the worst load case of a run."""
    from loadflow.cube import open_cube
    from loadflow.plots import orbit

    films = open_cube(run / "result.h5")["journal"].to_dataset()["largest_eccentricity_ratio"]
    k, _ = divmod(int(films.transpose("case", "bearing").values.argmax()), films.sizes["bearing"])
    place = films["bearing"].values[0]
    case = films["case"].values[k]
    samples = open_cube(run / "journal" / f"{case}.h5")[str(place)].to_dataset().load()
    stream = io.BytesIO()
    drawing = orbit(samples)
    drawing.set_size_inches(5.6, 4.8)
    drawing.savefig(stream, format="png", dpi=110)
    return Image.open(stream).convert("RGB")


@contextmanager
def dashboard(run: Path):
    """Serve the dashboard of a run; yield its address."""
    process = subprocess.Popen(
        [sys.executable, "-u", "-m", "loadflow", "view", str(run), "--no-browser"],
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        line = next(line for line in process.stdout if "http://" in line)
        yield "http://" + line.split("http://")[1].split()[0]
    finally:
        process.terminate()
        process.wait(20)


def keep(name: str, picture: Image.Image) -> None:
    """Write a picture in as many colours as fit into the size that a page may have."""
    for colours in COLOURS:
        stream = io.BytesIO()
        picture.quantize(colours, dither=Image.Dither.NONE).save(stream, "PNG", optimize=True)
        if stream.tell() <= LARGEST:
            break
    path = PLACE / f"{name}.png"
    path.write_bytes(stream.getvalue())
    print(f"{path.relative_to(ROOT)}: {picture.width} × {picture.height}, {stream.tell()} bytes")


if __name__ == "__main__":
    main()
