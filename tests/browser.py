"""A headless Chromium that a test can ask what a page shows: DevTools protocol over tornado."""

import asyncio
import json
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
