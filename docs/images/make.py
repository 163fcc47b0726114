"""The pictures of the README, made anew of a finished run and a comparison.

    PYTHONPATH=tests python docs/images/make.py runs/dlc_1_1 runs/quick_look

Needs a Chromium and the extras `view` and `test`.
"""

import asyncio
import base64
import io
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from browser import Browser
from PIL import Image

from loadflow.running.dashboard import RunView

HERE = Path(__file__).parent
ALL_DRAWN = "[...document.querySelectorAll('.chart')].some(box => box.plots)"
FIRST_CHART = "document.querySelector('#loads .chart').getBoundingClientRect().top + scrollY - 10"


async def shot(page, name, width, height, top=0.0):
    """A part of what the browser shows, as PNG."""
    clip = {"x": 0, "y": top, "width": width, "height": height, "scale": 1}
    taken = await page.call("Page.captureScreenshot", captureBeyondViewport=True, clip=clip)
    with Image.open(io.BytesIO(base64.b64decode(taken["data"]))) as picture:
        picture.convert("RGB").quantize(64).save(HERE / name, optimize=True)


async def sized(page, width, height):
    """Give the window a size."""
    await page.call(
        "Emulation.setDeviceMetricsOverride",
        width=width, height=height, deviceScaleFactor=1, mobile=False,
    )  # fmt: skip


async def look(run, compared, address):
    """Open the pages and take their pictures."""
    with tempfile.TemporaryDirectory() as profile:
        async with Browser(Path(profile)) as page:
            await sized(page, 1500, 1150)
            await page.open((compared / "compare.html").absolute().as_uri())
            await page.shows("capacity margin")
            await shot(page, "compare.png", 1500, 1150)
            await sized(page, 1170, 900)
            await page.open((run / "report.html").absolute().as_uri())
            await page.shows("Provenance")
            while not await page.evaluate(ALL_DRAWN):
                await asyncio.sleep(0.2)
            await shot(page, "report.png", 1170, 900, await page.evaluate(FIRST_CHART))
            await sized(page, 1050, 1150)
            await page.open(f"{address}?tab=2")
            await page.shows("bearing", "picture")
            await asyncio.sleep(1.0)  # until the figures have their place
            await shot(page, "dashboard.png", 1050, 1150)


def main(run, compared):
    """Serve the dashboard, take the pictures, draw an orbit."""
    server = subprocess.Popen(
        [sys.executable, "-u", "-m", "loadflow", "view", str(run), "--no-browser"],
        stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    try:
        address = next(
            found[0] for line in server.stdout if (found := re.search(r"http://[\d.]+:\d+/", line))
        )
        asyncio.run(look(run, compared, address))
    finally:
        server.kill()
        server.wait(20)
    view = RunView(run)
    drawn = view.orbit_figure(view.cases[0], view.bearings()[0])
    drawn.savefig(HERE / "orbit.png", dpi=110)


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:3]))
