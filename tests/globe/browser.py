# SPDX-FileCopyrightText: The Rondel authors
# SPDX-License-Identifier: Apache-2.0
"""Chromium without a screen, driven through its debugging pipe (Chrome DevTools Protocol).

Needs nothing but Python and Debian's chromium: messages are JSON with a zero byte behind each, on
descriptor 3 to the browser and on 4 from it.
"""

import base64
import json
import os
import select
import shutil
import signal
import subprocess
import tempfile
import time

FLAGS = [
    "--headless",
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    "--remote-debugging-pipe",
]


class BrowserError(Exception):
    """What the browser refused, or what did not happen in time."""


class PageLeftError(BrowserError):
    """A script was asked for while another page took the place of its own."""


# How Chromium says so, by how far the other page has come.
LEFT = ("Inspected target navigated or closed", "Execution context was destroyed", "Cannot find default execution context")


class Browser:
    """One process with a folder of its own; `with Browser(path) as browser:` ends it."""

    def __init__(self, program):
        self.folder = tempfile.mkdtemp(prefix="rondel-globe-")
        to_browser, self.output = os.pipe()
        self.input, from_browser = os.pipe()

        def connect():
            ends = os.dup(to_browser), os.dup(from_browser)
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        self.process = subprocess.Popen(
            [program, *FLAGS, f"--user-data-dir={self.folder}", "about:blank"],
            preexec_fn=connect,
            pass_fds=(3, 4),
            start_new_session=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(to_browser)
        os.close(from_browser)
        self.buffer = b""
        self.number = 0
        self.events = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.close(self.output)
        try:
            self.process.wait(5)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)  # the group that this object started
            self.process.wait()
        os.close(self.input)
        shutil.rmtree(self.folder, ignore_errors=True)

    def message(self, deadline):
        """The next message, or None when the time is over."""
        while b"\0" not in self.buffer:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self.input], [], [], left)[0]:
                return None
            data = os.read(self.input, 1 << 20)
            if not data:
                raise BrowserError("the browser ended")
            self.buffer += data
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, session=None, timeout=90, **parameters):
        """The result of a method of the protocol; events meanwhile are kept."""
        self.number += 1
        call = {"id": self.number, "method": method, "params": parameters}
        if session:
            call["sessionId"] = session
        os.write(self.output, json.dumps(call).encode() + b"\0")
        deadline = time.monotonic() + timeout
        while True:
            message = self.message(deadline)
            if message is None:
                raise BrowserError(f"{method} took more than {timeout} s")
            if message.get("id") == self.number:
                if "error" in message:
                    reason = message["error"]["message"]
                    kind = PageLeftError if reason.startswith(LEFT) else BrowserError
                    raise kind(f"{method}: {reason}")
                return message["result"]
            if "method" in message:
                self.events.append(message)

    def open(self, path, width=800, height=600, dark=False, touch=False):
        """A page of its own that shows a file, or what a server has at an address."""
        return Page(self, path, width, height, dark, touch)


class Page:
    """A page and what went wrong in it (`errors`)."""

    def __init__(self, browser, path, width, height, dark, touch):
        self.browser = browser
        target = browser.call("Target.createTarget", url="about:blank")["targetId"]
        self.target = target
        self.session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")
        self.resize(width, height, touch)
        self.set_dark(dark)
        if touch:
            self.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=5)
        self.call("Page.navigate", url=path if "://" in str(path) else f"file://{os.path.abspath(path)}")

    def call(self, method, **parameters):
        return self.browser.call(method, session=self.session, **parameters)

    def resize(self, width, height, mobile=False):
        self.call(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=mobile,
        )

    def set_dark(self, dark):
        features = [
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion", "value": "reduce"},
        ]
        self.call("Emulation.setEmulatedMedia", features=features)

    def frame(self, timeout=90):
        """The number for `run` of what is in the page's only frame, which may be of another origin."""
        deadline = time.monotonic() + timeout
        while time.monotonic() < deadline:
            top = self.call("Page.getFrameTree")["frameTree"]
            inside = [child["frame"]["id"] for child in top.get("childFrames", [])]
            for event in reversed(self.browser.events):
                context = event["params"].get("context", {})
                if event.get("sessionId") == self.session and context.get("auxData", {}).get("frameId") in inside:
                    return context["id"]
            time.sleep(0.02)
        raise BrowserError("the page has no frame")

    def run(self, script, timeout=90, frame=None):
        """The value of an expression, or of the promise that it is."""
        answer = self.browser.call(
            "Runtime.evaluate",
            session=self.session,
            timeout=timeout,
            expression=script,
            awaitPromise=True,
            returnByValue=True,
            **({"contextId": frame} if frame else {}),
        )
        if "exceptionDetails" in answer:
            raise BrowserError(answer["exceptionDetails"].get("exception", {}).get("description", script))
        return answer["result"].get("value")

    def is_true(self, condition, frame=None):
        """Whether an expression is true now; it is not while the page is being replaced."""
        try:
            return bool(self.run(condition, frame=frame))
        except PageLeftError:
            return False

    def wait(self, condition, timeout=90, frame=None):
        """Waits until an expression is true, also in the page that takes the place of this one meanwhile."""
        deadline = time.monotonic() + timeout
        while not self.is_true(condition, frame):
            if time.monotonic() > deadline:
                raise BrowserError(f"never came true: {condition}")
            time.sleep(0.02)

    def wait_until_drawn(self, timeout=90, frame=None):
        """Waits until the globe is there and nothing is left to draw."""
        self.wait("['ready', 'failed'].includes(document.documentElement?.dataset.state)", timeout, frame)
        self.wait("Boolean(window.rondelGlobe && window.rondelGlobe.isDrawn)", timeout, frame)

    def key(self, name, text=None):
        parameters = {"key": name}
        if text:
            parameters["text"] = text
        self.call("Input.dispatchKeyEvent", type="keyDown", **parameters)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=name)

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.mouse(kind, x, y, button="left", clickCount=1)

    def touch(self, kind, *points, **more):
        fingers = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        self.call("Input.dispatchTouchEvent", type=kind, touchPoints=fingers, **more)

    def double_click(self, x, y):
        """Two clicks that the page sees a tenth of a second apart, however slow the machine is."""
        now = time.time()
        for i, kind in enumerate(("mousePressed", "mouseReleased") * 2):
            self.mouse(kind, x, y, button="left", clickCount=1, timestamp=now + i / 20)

    def double_tap(self, x, y):
        now = time.time()
        for i in (0, 2):
            self.touch("touchStart", (x, y), timestamp=now + i / 20)
            self.touch("touchEnd", timestamp=now + (i + 1) / 20)

    def picture(self, path=None):
        """What is on the screen, as the bytes of a PNG."""
        data = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            with open(path, "wb") as file:
                file.write(data)
        return data

    def errors(self):
        """Errors and warnings of the console, and exceptions that nobody caught."""
        self.run("0")
        found = []
        for event in self.browser.events:
            if event.get("sessionId") != self.session:
                continue
            parameters = event["params"]
            if event["method"] == "Runtime.exceptionThrown":
                details = parameters["exceptionDetails"]
                found.append(details.get("exception", {}).get("description", details["text"]))
            elif event["method"] == "Runtime.consoleAPICalled" and parameters["type"] in ("error", "warning"):
                found.append(str([value.get("value") for value in parameters["args"]]))
            elif event["method"] == "Log.entryAdded" and parameters["entry"]["level"] == "error":
                found.append(parameters["entry"]["text"])
        return found

    def close(self):
        self.browser.call("Target.closeTarget", targetId=self.target)
