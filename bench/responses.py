#!/usr/bin/env python3
"""Measures how fast the language server answers, and prints a table.

    python3 bench/responses.py PARTC [EDITS]

PARTC is the program, EDITS the count of changes for the measurement of memory (10,000 if left out).
The server runs as an editor would start it. Times are from the last byte sent to the first byte of the
answer read, in ms.
"""

import json
import math
import os
import queue
import subprocess
import sys
import threading
import time


class Client:
    """A client of the language server."""

    def __init__(self, partc):
        self.begin = time.monotonic()
        self.process = subprocess.Popen([partc, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.messages = queue.Queue()
        self.last = 0
        threading.Thread(target=self._receive, daemon=True).start()

    def _receive(self):
        stream = self.process.stdout
        while True:
            size = 0
            while True:
                line = stream.readline()
                if not line:
                    self.messages.put((time.monotonic(), None))
                    return
                if line == b"\r\n":
                    break
                if line.lower().startswith(b"content-length:"):
                    size = int(line.split(b":")[1])
            body = stream.read(size)
            self.messages.put((time.monotonic(), json.loads(body)))

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()
        return time.monotonic()

    def notify(self, method, params):
        return self.send({"method": method, "params": params})

    def request(self, method, params):
        self.last += 1
        return self.last, self.send({"id": self.last, "method": method, "params": params})

    def until(self, wanted):
        while True:
            at, message = self.messages.get(timeout=120)
            if message is None:
                sys.exit("the server is gone")
            if wanted(message):
                return at, message

    def answer(self, ident):
        return self.until(lambda m: m.get("id") == ident and "method" not in m)

    def ask(self, method, params):
        """The time of a request until its answer."""
        ident, sent = self.request(method, params)
        return self.answer(ident)[0] - sent

    def initialize(self):
        ident, _ = self.request("initialize", {"capabilities": {}})
        at, _ = self.answer(ident)
        self.notify("initialized", {})
        return at - self.begin

    def open(self, uri, text):
        document = {"uri": uri, "languageId": "part", "version": 0, "text": text}
        self.notify("textDocument/didOpen", {"textDocument": document})
        self.until(notification("partc/settled", uri, 0))

    def change(self, uri, version, edit):
        document = {"uri": uri, "version": version}
        return self.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [edit]})

    def memory(self):
        """The memory in MB that the server has now."""
        with open(f"/proc/{self.process.pid}/status") as status:
            return next(int(line.split()[1]) / 1000 for line in status if line.startswith("VmRSS"))

    def processor_time(self):
        """The processor time in s that the server has used."""
        with open(f"/proc/{self.process.pid}/stat") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def end(self):
        """The time from the end of the input to the end of the process."""
        begin = time.monotonic()
        self.process.stdin.close()
        self.process.wait()
        return time.monotonic() - begin


def notification(method, uri, version):
    def wanted(message):
        params = message.get("params") or {}
        return message.get("method") == method and (params.get("uri"), params.get("version")) == (uri, version)

    return wanted


HEAD = """part measured
machine iso6983
tool mill(diameter 2 mm)
feed 60 mm/min
tolerance 0.02 mm
from (1020, 0)
"""

TAIL = """let c = (59.3, 59.1)
let lug(a) = circle(c + polar(41, a), 9)
let boss(a) = circle(c + polar(34, a), 8)
contour outline closed {
  for a in [210, 90, -30] {
    cw lug(a) tangent
    cw boss(a - 30) fillet -36
    cw boss(a - 90) tangent
  }
}
mill outline outside {
  approach (0, 20) rapid
  retract (0, 20), (0, 0) rapid
}
"""


def program(lines):
    """A program with this count of lines: definitions, and one contour to mill."""
    count = lines - len(HEAD.splitlines()) - len(TAIL.splitlines())
    forms = [
        "let d{k} = {r}",
        "let c{k} = ({x} + d{k}, {y})",
        "let k{k} = circle(c{k}, d{k} * 2)",
        "-- the hole {k} of the plate",
    ]
    middle = [
        forms[k % 4].format(k=k // 4, r=2 + k % 5, x=k * 7 % 900, y=k * 3 % 500) for k in range(count)
    ]
    return HEAD + "\n".join(middle) + "\n" + TAIL


def pocket(islands):
    """A program that clears a square pocket around this count of round islands."""
    side = math.ceil(islands ** 0.5)
    far = 3 * side
    return (
        HEAD.replace("diameter 2 mm", "diameter 1 mm")
        + "clearance 5 mm\n"
        + f"contour c closed {{ (0, 0) ({far}, 0) ({far}, {far}) (0, {far}) }}\n"
        + "".join(
            f"contour i{k} closed {{ ccw circle(({3 * (k % side) + 1.5}, {3 * (k // side) + 1.5}), 0.5) }}\n"
            for k in range(islands)
        )
        + "pocket c step 0.8 { depth 1 mm  rest allowed  plunge 20  islands "
        + ", ".join(f"i{k}" for k in range(islands))
        + " }\n"
    )


def edit(line, begin, end, text):
    return {
        "range": {"start": {"line": line, "character": begin}, "end": {"line": line, "character": end}},
        "text": text,
    }


def percentile(times, share):
    return 1000 * sorted(times)[min(len(times) - 1, int(len(times) * share))]


def row(what, unit, *values):
    print("| " + " | ".join([what, unit, *(f"{v:.1f}" for v in values)]) + " |", flush=True)


def start(partc):
    times = []
    for _ in range(20):
        client = Client(partc)
        times.append(client.initialize())
        client.end()
    row("start to the first answer", "ms", percentile(times, 0.5), percentile(times, 0.99))


def typing(partc, edits):
    """Changes one digit at a time, each after the settled results of the one before."""
    uri = "file:///tmp/typing.part"
    client = Client(partc)
    client.initialize()
    client.open(uri, program(2000))
    first, settled = [], []
    for version in range(1, edits + 1):
        sent = client.change(uri, version, edit(6, 9, 10 if version > 1 else 10, str(version % 9 + 1)))
        if version > 200:
            client.until(notification("partc/settled", uri, version))
            continue
        at, _ = client.until(notification("textDocument/publishDiagnostics", uri, version))
        first.append(at - sent)
        at, _ = client.until(notification("partc/settled", uri, version))
        settled.append(at - sent)
        if version in (1, 200):
            row(f"memory after {version} changes of 2,000 lines", "MB", client.memory())
        time.sleep(0.05)
    row("key to the first diagnostics, 2,000 lines", "ms", percentile(first, 0.5), percentile(first, 0.99))
    row("key to the last diagnostics, 2,000 lines", "ms", percentile(settled, 0.5), percentile(settled, 0.99))
    row(f"memory after {edits} changes of 2,000 lines", "MB", client.memory())
    time.sleep(3)
    before = client.processor_time()
    time.sleep(10)
    row("processor time of ten idle seconds", "ms", 1000 * (client.processor_time() - before))
    row("end of the input to the end of the process", "ms", 1000 * client.end())


def busy(partc):
    """Hovers in two documents while the analysis of one of them runs."""
    other, slow = "file:///tmp/other.part", "file:///tmp/slow.part"
    client = Client(partc)
    client.initialize()
    client.open(other, program(2000))
    client.open(slow, pocket(1))
    began = client.change(slow, 1, {"text": pocket(11000)})
    time.sleep(0.2)
    times, largest = [], 0
    isSettled = notification("partc/settled", slow, 1)
    ended = None
    while ended is None:
        for uri, line in ((other, 7), (slow, 7)):
            ident, sent = client.request(
                "textDocument/hover",
                {"textDocument": {"uri": uri}, "position": {"line": line, "character": 5}},
            )
            while True:
                at, message = client.messages.get(timeout=120)
                if message is None:
                    sys.exit("the server is gone")
                if isSettled(message):
                    ended = at
                if message.get("id") == ident and "method" not in message:
                    break
            times.append(at - sent)
        largest = max(largest, client.memory())
        time.sleep(0.01)
    row("the analysis during the hovers", "s", ended - began)
    row(f"hover during this analysis ({len(times)})", "ms", percentile(times, 0.5), percentile(times, 0.99))
    row("memory during this analysis", "MB", largest)
    client.change(slow, 2, {"text": pocket(11001)})
    time.sleep(1)
    row("end of the input to the end of the process, busy", "ms", 1000 * client.end())


def long(partc):
    """Changes in a document of 100,000 lines. The refusal of an unknown request ends the clock."""
    uri = "file:///tmp/long.part"
    client = Client(partc)
    client.initialize()
    document = {"uri": uri, "languageId": "part", "version": 0, "text": program(100000)}
    client.notify("textDocument/didOpen", {"textDocument": document})
    client.ask("partc/unknown", {})
    times = []
    for turn in range(50):
        begin = time.monotonic()
        for change in range(20):
            client.change(uri, 20 * turn + change + 1, edit((turn * 1999 + change * 7) % 99000, 0, 0, "-"))
        client.ask("partc/unknown", {})
        times.append((time.monotonic() - begin) / 20)
    row("a change in 100,000 lines", "ms", percentile(times, 0.5), percentile(times, 0.99))
    client.process.kill()


def main():
    partc = sys.argv[1]
    edits = int(sys.argv[2]) if len(sys.argv) > 2 else 10000
    print("| measurement | unit | median or value | 99th percentile |\n|---|---|---|---|", flush=True)
    start(partc)
    typing(partc, edits)
    busy(partc)
    long(partc)


if __name__ == "__main__":
    main()
