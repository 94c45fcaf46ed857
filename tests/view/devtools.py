"""A headless Chromium, controlled through its DevTools pipe: JSON messages, each ended by a zero byte.

Nothing else is needed than Python and the browser. Protocol: https://chromedevtools.github.io/devtools-protocol
"""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

SWITCHES = [
    "--headless",
    "--remote-debugging-pipe",
    "--no-sandbox",  # not available to root
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-quic",
    "--disable-gpu",
    "--use-gl=angle",  # WebGL by the processor
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--hide-scrollbars",
]


class Browser:
    """One page of a browser with a new profile. `events` holds the browser's notifications."""

    def __init__(self, executable: str, width: int, height: int, patience: float = 30):
        self.patience = patience
        self.events: list[dict] = []
        self._received = b""
        self._last_id = 0
        self._profile = tempfile.mkdtemp(prefix="chasles-chromium-")
        self._start([executable, *SWITCHES, f"--user-data-dir={self._profile}", f"--window-size={width},{height}"])
        target = self._call("Target.createTarget", {"url": "about:blank"})["targetId"]
        self._session = self._call("Target.attachToTarget", {"targetId": target, "flatten": True})["sessionId"]
        for domain in ["Page", "Runtime", "Network", "Log"]:
            self.call(f"{domain}.enable")
        self.resize(width, height)

    def __enter__(self) -> "Browser":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        self._process.wait()
        os.close(self._to_browser)
        os.close(self._from_browser)
        shutil.rmtree(self._profile, ignore_errors=True)

    def _start(self, command: list[str]) -> None:
        browser_reads, self._to_browser = os.pipe()
        self._from_browser, browser_writes = os.pipe()

        # The browser expects its pipe at the file descriptors 3 and 4.
        def place_pipe() -> None:
            reads, writes = os.dup(browser_reads), os.dup(browser_writes)
            os.dup2(reads, 3)
            os.dup2(writes, 4)

        self._process = subprocess.Popen(
            command, preexec_fn=place_pipe, close_fds=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        os.close(browser_reads)
        os.close(browser_writes)

    def _receive(self, deadline: float) -> dict:
        while b"\0" not in self._received:
            if not select.select([self._from_browser], [], [], max(0, deadline - time.monotonic()))[0]:
                raise TimeoutError(f"the browser said nothing for {self.patience} s")
            part = os.read(self._from_browser, 1 << 20)
            if not part:
                raise RuntimeError("the browser ended")
            self._received += part
        message, self._received = self._received.split(b"\0", 1)
        return json.loads(message)

    def _call(self, method: str, parameters: dict | None = None, **envelope: str) -> dict:
        self._last_id += 1
        message = {"id": self._last_id, "method": method, "params": parameters or {}, **envelope}
        os.write(self._to_browser, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + self.patience
        while True:
            answer = self._receive(deadline)
            if answer.get("id") != self._last_id:
                self.events.append(answer)
            elif "error" in answer:
                raise RuntimeError(f"{method}: {answer['error']['message']}")
            else:
                return answer["result"]

    def call(self, method: str, **parameters: object) -> dict:
        """Sends one command to the page and returns its result."""
        return self._call(method, parameters, sessionId=self._session)

    def evaluate(self, expression: str) -> object:
        """The value of a JavaScript expression, awaited if it is a promise."""
        result = self.call("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{expression}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def open(self, address: str, ready: str) -> None:
        """Opens the page and waits until the expression `ready` is true."""
        self.call("Page.navigate", url=address)
        deadline = time.monotonic() + self.patience
        while not self.evaluate(ready):
            if time.monotonic() > deadline:
                raise TimeoutError(f"{address}: not ready after {self.patience} s")
            time.sleep(0.05)

    def resize(self, width: int, height: int) -> None:
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def press(self, key: str) -> None:
        """Presses a named key, or the space key."""
        names = {" ": "Space"}
        for kind in ["rawKeyDown", "keyUp"]:
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=names.get(key, key))

    def drag(self, from_x: float, to_x: float, y: float) -> None:
        """Drags with the left button in small steps."""
        places = [from_x + (to_x - from_x) * step / 8 for step in range(9)]
        mouse = {"y": y, "button": "left", "buttons": 1, "clickCount": 1}
        self.call("Input.dispatchMouseEvent", type="mousePressed", x=from_x, **mouse)
        for x in places:
            self.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, **mouse)
        self.call("Input.dispatchMouseEvent", type="mouseReleased", x=to_x, **mouse)

    def screenshot(self, scale: float = 1) -> bytes:
        """A PNG file of the page after pending drawing is done."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))")
        width, height = self.evaluate("[innerWidth, innerHeight]")
        clip = {"x": 0, "y": 0, "width": width, "height": height, "scale": scale}
        return base64.b64decode(self.call("Page.captureScreenshot", format="png", clip=clip)["data"])
