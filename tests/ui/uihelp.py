"""Shared by the tests of `skg ui`: a page's calls, and drawings."""

from __future__ import annotations

import http.client
import json
import time
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

import ezdxf
from ezdxf import units

from skg.ui.server import Server

Json = dict


def english(error: Json) -> str:
    """The English sentence of an error or line, which has one in Chinese, too."""
    first, other = error["message"] if "message" in error else error["text"]
    assert first and other
    return first


@dataclass
class Answer:
    """An answer of the server."""

    status: int
    headers: http.client.HTTPMessage
    body: bytes

    @property
    def json(self) -> Json:
        return json.loads(self.body)

    @property
    def message(self) -> str:
        """Of an error."""
        message = english(self.json["error"])
        assert "\n" not in message and "Traceback" not in message
        return message


class Page:
    """A page in a browser, as the server sees it."""

    def __init__(self, server: Server) -> None:
        self.host, self.token = server.host, server.token

    def call(self, method: str, path: str, body: bytes | Json | None = None, **headers: str) -> Answer:
        """Make a request; `headers` are added, or take the place of those that a page sends."""
        if isinstance(body, dict):
            body = json.dumps(body).encode()
        sent = {"Host": self.host, "Origin": f"http://{self.host}", "Authorization": f"Bearer {self.token}"}
        sent |= {name.replace("_", "-"): value for name, value in headers.items()}
        connection = http.client.HTTPConnection(self.host, timeout=600)
        connection.request(method, path, body, {name: value for name, value in sent.items() if value})
        answer = connection.getresponse()
        found = Answer(answer.status, answer.headers, answer.read())
        connection.close()
        return found

    def get(self, path: str) -> Answer:
        return self.call("GET", path)

    def done(self, method: str, path: str, body: bytes | Json | None = None, **headers: str) -> Json:
        """Make a request that must go well."""
        answer = self.call(method, path, body, **headers)
        assert answer.status == 200, answer.body
        return answer.json

    def open(self, path: Path) -> Json:
        """Drop a file."""
        return self.done("POST", "/api/open", path.read_bytes(), X_Name=quote(path.name))

    def state(self) -> Json:
        """The state, when something is open."""
        state = self.done("GET", "/api/state")
        while state["name"] is None or state["plan"] is None and not state.get("error"):
            state = self.done("GET", f"/api/state?after={state['rev']}")
        return state

    def put(self, state: Json, **job: object) -> Json:
        """Change the job; the plan of all contours is put together, as a page does it."""
        put = self.done("PUT", "/api/job", {"rev": state["rev"], "job": state["job"] | job})
        if "contours" not in put:
            put["plan"]["contours"] = state["plan"]["contours"] | put["plan"]["contours"]
        return put

    def cut(self, rev: int) -> tuple[int, Json]:
        """Cut to the end: the run's number and what became of it."""
        number = self.done("POST", "/api/cut", {"rev": rev})["run"]
        return number, self.wait(number)

    def wait(self, number: int) -> Json:
        run = self.done("GET", f"/api/run/{number}")
        while run["state"] == "running":
            run = self.done("GET", f"/api/run/{number}?after={run['k']}")
        return run


def plate(folder: Path, name: str = "plate.dxf", holes: int = 2) -> Path:
    """A plate of 60 x 30 mm with round holes."""
    page = ezdxf.new()
    page.units = units.MM
    page.modelspace().add_lwpolyline([(0, 0), (60, 0), (60, 30), (0, 30)], close=True, dxfattribs={"layer": "PART"})
    for at in range(holes):
        page.modelspace().add_circle((15 + 30 * at, 15), 6, dxfattribs={"layer": "HOLES"})
    path = folder / name
    page.saveas(path)
    return path


def circles(folder: Path, count: int) -> Path:
    """So many circles, 200 in a row."""
    rows = (f"0\nCIRCLE\n8\n0\n10\n{10 * (at % 200)}\n20\n{10 * (at // 200)}\n40\n3\n" for at in range(count))
    path = folder / f"circles{count}.dxf"
    header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n"
    path.write_text(f"{header}0\nSECTION\n2\nENTITIES\n{''.join(rows)}0\nENDSEC\n0\nEOF\n")
    return path


def until(happens: object, seconds: float = 600.0) -> None:
    """Wait for something."""
    last = time.monotonic() + seconds
    while not happens():
        assert time.monotonic() < last, "it did not happen"
        time.sleep(0.05)
