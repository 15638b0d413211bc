# A headless Chromium at the end of a pipe: opens a page and reports requests, messages and values.
import base64
import json
import os
import shutil
import subprocess
import tempfile
import time


class Browser:
    """Speaks Chromium's DevTools protocol: JSON messages that end in a zero byte, on descriptors 3 and 4."""

    def __init__(self, program):
        self.profile = tempfile.mkdtemp(prefix="gnomon_chromium_")
        to_browser, self.write_end = os.pipe()
        self.read_end, from_browser = os.pipe()

        def hand_over():
            # Both ends may lie where the other is to go: first out of the way.
            high = [os.dup(to_browser), os.dup(from_browser)]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        command = [program, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                   "--remote-debugging-pipe", "--no-first-run", "--user-data-dir=" + self.profile, "about:blank"]
        self.process = subprocess.Popen(command, preexec_fn=hand_over, close_fds=False, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        os.set_blocking(self.read_end, False)
        self.buffer = b""
        self.next_id = 0
        self.session = None
        self.events = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.call(domain + ".enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def _message(self, deadline):
        while b"\0" not in self.buffer:
            if time.monotonic() > deadline:
                raise TimeoutError("the browser does not answer")
            try:
                data = os.read(self.read_end, 1 << 20)
                if not data:
                    raise EOFError("the browser has gone")
                self.buffer += data
            except BlockingIOError:
                time.sleep(0.01)
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def call(self, method, **params):
        self.next_id += 1
        message = {"id": self.next_id, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.write_end, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + 60
        while True:
            answer = self._message(deadline)
            if answer.get("id") == self.next_id:
                if "error" in answer:
                    raise RuntimeError(method + ": " + answer["error"]["message"])
                return answer["result"]
            if "method" in answer:
                self.events.append((answer["method"], answer["params"]))

    def wait_for(self, method):
        deadline = time.monotonic() + 60
        while not any(name == method for name, _ in self.events):
            answer = self._message(deadline)
            if "method" in answer:
                self.events.append((answer["method"], answer["params"]))

    def press(self, key):
        """A key by its DOM name: Tab, Enter, ArrowRight."""
        codes = {"Tab": 9, "Enter": 13, " ": 32, "ArrowLeft": 37, "ArrowUp": 38, "ArrowRight": 39, "ArrowDown": 40}
        text = {"Enter": "\r", " ": " "}.get(key)
        for kind in ("keyDown", "keyUp"):
            params = {"key": key, "code": "Space" if key == " " else key, "windowsVirtualKeyCode": codes[key]}
            if text and kind == "keyDown":
                params["text"] = text
            self.call("Input.dispatchKeyEvent", type=kind, **params)

    def colors(self, scheme):
        """Makes the page see "light" or "dark" as what the reader prefers."""
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])

    def open(self, path, width=1200, height=900):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.events = []
        self.call("Page.navigate", url="file://" + os.path.abspath(path))
        self.wait_for("Page.loadEventFired")

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True)
        if "exceptionDetails" in result:
            raise RuntimeError(expression + ": " + json.dumps(result["exceptionDetails"]))
        return result["result"].get("value")

    def click(self, selector):
        at = self.value("(() => { const e = document.querySelector(%s); e.scrollIntoView({block: 'center'});"
                        "const b = e.getBoundingClientRect();"
                        "return [b.left + b.width / 2, b.top + b.height / 2]; })()" % json.dumps(selector))
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", clickCount=1)

    def complaints(self):
        """Console messages, exceptions and refusals of the page."""
        said = []
        for name, params in self.events:
            if name == "Runtime.exceptionThrown":
                said.append("exception: " + json.dumps(params["exceptionDetails"]))
            elif name == "Runtime.consoleAPICalled":
                said.append("console: " + json.dumps(params["args"]))
            elif name == "Log.entryAdded":
                said.append("log: " + params["entry"]["text"])
        return said

    def requests(self):
        """Requests other than for the page itself and its data URLs."""
        urls = [params["request"]["url"] for name, params in self.events if name == "Network.requestWillBeSent"]
        return [url for url in urls if not url.startswith("data:")][1:]

    def screenshot(self, path, x=0, y=0, width=1200, height=900):
        clip = {"x": x, "y": y, "width": width, "height": height, "scale": 1}
        image = self.call("Page.captureScreenshot", format="png", clip=clip, captureBeyondViewport=True)["data"]
        with open(path, "wb") as out:
            out.write(base64.b64decode(image))
