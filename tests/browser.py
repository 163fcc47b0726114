"""A headless Chromium that a test can ask what a page shows: DevTools protocol over tornado."""

import asyncio
import base64
import json
import re
import shutil
import subprocess
import time
from pathlib import Path

from tornado.httpclient import AsyncHTTPClient
from tornado.websocket import websocket_connect

BROWSER = next(
    filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None
)

TEXT = """(() => {
  const seen = [];
  const walk = (node) => {
    if (node.shadowRoot) walk(node.shadowRoot);
    for (const child of node.children || []) walk(child);
    if (node.tagName === 'OPTION' || !node.children || !node.children.length)
      seen.push(node.textContent);
    if (node.tagName === 'IMG' && node.naturalWidth) seen.push(`picture ${node.src.length}`);
    if (node.tagName === 'svg') seen.push('picture svg');
  };
  walk(document.documentElement);
  return seen.join('\\n');
})()"""
"""What a page shows, within shadow roots, too."""


CODES = {"Tab": 9, "Enter": 13, "ArrowLeft": 37, "ArrowRight": 39}

FOCUS = """(() => { const a = document.activeElement, r = a.getBoundingClientRect();
  if (a === document.body) return null;
  const o = getComputedStyle(a);
  return { name: `${a.tagName} ${a.className} ${a.textContent.slice(0, 40)}`,
    seen: r.width > 0 && r.bottom > 0 && r.top < innerHeight,
    outlined: o.outlineStyle !== 'none' && parseFloat(o.outlineWidth) >= 1 }; })()"""
"""What has the focus, if anything, and whether one sees that it has."""


class Browser:
    """Run by `asyncio.run`; ends its own process only."""

    def __init__(self, profile: Path) -> None:
        self.profile, self.number, self.console = profile, 0, []

    async def __aenter__(self):
        self.process = subprocess.Popen(
            [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
             "--remote-debugging-port=0", "--window-size=1100,1200",
             "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
             f"--user-data-dir={self.profile}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        told = self.profile / "DevToolsActivePort"
        await until(lambda: told.exists() and len(told.read_text().split()) == 2, 60)
        port = told.read_text().split()[0]
        listed = await AsyncHTTPClient().fetch(f"http://127.0.0.1:{port}/json")
        page = next(one for one in json.loads(listed.body) if one["type"] == "page")
        self.socket = await websocket_connect(page["webSocketDebuggerUrl"], max_message_size=2**26)
        for domain in ("Page", "Runtime", "Network"):
            await self.call(f"{domain}.enable")
        return self

    async def __aexit__(self, *error):
        self.socket.close()
        self.process.kill()
        self.process.wait(20)

    async def call(self, method, **parameters):
        self.number += 1
        await self.socket.write_message(
            json.dumps({"id": self.number, "method": method, "params": parameters})
        )
        while True:
            told = json.loads(await asyncio.wait_for(self.socket.read_message(), 60))
            if told.get("id") == self.number:
                return told.get("result", {})
            self._note(told)

    def _note(self, told):
        """Keep errors of the console and requests that leave the machine."""
        data = told.get("params", {})
        if told["method"] == "Runtime.exceptionThrown":
            self.console.append(data["exceptionDetails"]["text"])
        if told["method"] == "Runtime.consoleAPICalled" and data["type"] == "error":
            self.console.append(str(data["args"]))
        if told["method"] == "Network.requestWillBeSent":
            url = data["request"]["url"]
            if not url.startswith(
                ("http://127.0.0.1", "ws://127.0.0.1", "data:", "blob:", "about")
            ):
                self.console.append(f"asks for {url}")

    async def open(self, url):
        await self.call("Page.navigate", url=url)

    async def evaluate(self, code):
        found = await self.call("Runtime.evaluate", expression=code, returnByValue=True)
        return found["result"].get("value")

    async def becomes(self, code, seconds=30):
        """Wait until some code is true."""
        end = time.monotonic() + seconds
        while not await self.evaluate(code):
            assert time.monotonic() < end, code
            await asyncio.sleep(0.2)

    async def resize(self, width, height=1000):
        """Make the page so many pixels wide."""
        await self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width, height=height, deviceScaleFactor=1, mobile=False,
        )  # fmt: skip

    async def printed(self):
        """Width and height of each sheet of the page as PDF, points."""
        paper = await self.call("Page.printToPDF", preferCSSPageSize=True)
        boxes = re.findall(rb"/MediaBox ?\[([^\]]*)\]", base64.b64decode(paper["data"]))
        return [tuple(round(float(side)) for side in box.split()[2:]) for box in boxes]

    async def press(self, key, *, shift=False):
        """Press and let go of a key where the focus is, as a hand does."""
        about = {"key": key, "windowsVirtualKeyCode": CODES.get(key, 0), "modifiers": 8 * shift}
        typed = {"Enter": "\r"}.get(key, key if len(key) == 1 else "")
        await self.call("Input.dispatchKeyEvent", type="keyDown", text=typed, **about)
        await self.call("Input.dispatchKeyEvent", type="keyUp", **about)

    async def tab_to(self, selector, most=400):
        """Press Tab until the focus is on what a selector names; return what it went over."""
        passed = []
        for _ in range(most):
            await self.press("Tab")
            passed.append(await self.evaluate(FOCUS))
            if await self.evaluate(f"document.activeElement.matches({selector!r})"):
                return passed
        raise AssertionError(f"no Tab leads to {selector}")

    async def shows(self, *words, seconds=60):
        """Wait until the page shows all of some words."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            text = await self.evaluate(TEXT) or ""
            if all(word in text for word in words):
                return text
            await asyncio.sleep(0.3)
        raise AssertionError(
            f"not shown: {[w for w in words if w not in text]} in:\n{text[-2000:]}"
        )


async def until(holds, seconds):
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "too long"
        await asyncio.sleep(0.1)


def looked_at(url, profile, look):
    """What `look` tells of a page that is opened in a browser of its own."""

    async def there():
        async with Browser(profile) as browser:
            await browser.open(url)
            await browser.becomes("document.readyState === 'complete'")  # all charts are there
            return await look(browser)

    return asyncio.run(there())


ON_PAPER = """(() => {
  const closed = () => [...document.querySelectorAll('details:not([open])')], before = closed();
  const edges = which => [...document.querySelectorAll('table, svg, img, canvas')].filter(which)
    .map(one => Math.round(one.getBoundingClientRect().right));
  dispatchEvent(new Event('beforeprint'));
  const told = {
    folded: before.length,
    lost: closed().filter(one => !one.querySelector('.chart')).length,
    silent: [...document.querySelectorAll('summary')].filter(one => !one.offsetHeight).length,
    wide: edges(one => one.closest('.wide')),
    upright: edges(one => one.closest('.upright')),
    other: edges(one => !one.closest('.wide, .upright')),
    smallest: Math.min(...[...document.querySelectorAll('td')]
      .map(one => parseFloat(getComputedStyle(one).fontSize))),
  };
  dispatchEvent(new Event('afterprint'));
  return { ...told, again: closed().length };
})()"""


async def on_paper(browser, width):
    """Return what becomes of a page on paper with so many millimetres between its margins.

    `wide`, `upright`, `other` are right edges, px, of what is printed on paper that lies, on paper
    that stands, and on that of the page.
    """
    await browser.resize(round(width / 25.4 * 96))
    await browser.call("Emulation.setEmulatedMedia", media="print")
    return await browser.evaluate(ON_PAPER)
