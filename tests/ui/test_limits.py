"""Refusals of the server: strangers, other pages, too large requests, and malformed ones."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from urllib.parse import quote

import pytest
from uihelp import Page, plate, until

from skg.ui import server as server_module
from skg.ui.server import MOST_DRAWING, MOST_JSON, Server
from skg.ui.session import MOST_WAYS

ROUTES = [
    ("GET", "/api/state"),
    ("POST", "/api/open"),
    ("PUT", "/api/job"),
    ("GET", "/api/job"),
    ("POST", "/api/ways"),
    ("POST", "/api/cut"),
    ("GET", "/api/run/1"),
    ("DELETE", "/api/run/1"),
    ("GET", "/api/run/1/tape"),
    ("GET", "/api/run/1/from/2"),
    ("POST", "/api/save"),
    ("POST", "/api/take"),
    ("GET", "/api/setups"),
    ("POST", "/api/setups"),
    ("PUT", "/api/setups"),
    ("DELETE", "/api/setups"),
]


def test_every_route_is_tried() -> None:
    assert len(ROUTES) == len(server_module.ROUTES)


@pytest.mark.parametrize(("method", "path"), ROUTES)
@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({"Authorization": ""}, 401),
        ({"Authorization": "Bearer "}, 401),
        ({"Authorization": "Bearer " + 32 * "A"}, 401),
        ({"Authorization": "Bearer ümläut"}, 401),
        ({"Host": "localhost:80"}, 403),
        ({"Host": "skg.example"}, 403),
        ({"Origin": "http://skg.example"}, 403),
        ({"Origin": "null"}, 403),
        ({"Origin": "https://127.0.0.1"}, 403),
    ],
    ids=lambda value: str(value),
)
def test_strangers(page: Page, method: str, path: str, headers: dict, status: int) -> None:
    answer = page.call(method, path, **headers)
    assert answer.status == status
    assert page.token not in answer.body.decode() and answer.message
    assert page.done("GET", "/api/state") == page.done("GET", "/api/state")


def test_token_of_another_server(serve: Callable[[], Server]) -> None:
    one, other = serve(), serve()
    assert one.token != other.token and len(one.token) >= 32
    assert Page(one).call("GET", "/api/state", Authorization=f"Bearer {other.token}").status == 401


def test_host_of_the_port_next_to_it(page: Page) -> None:
    host, port = page.host.split(":")
    for name in (host, f"{host}:{int(port) + 1}", f"localhost:{port}", f"{page.host}.", f"x@{page.host}"):
        assert page.call("GET", "/", Host=name).status == 403, name


def test_page_may_talk_to_here_alone(page: Page) -> None:
    """The page itself is shown without the token; no other page gets anything, and it gets nothing from elsewhere."""
    answer = page.call("GET", "/", Authorization="")
    assert answer.status == 200 and page.token not in answer.body.decode()
    policy = dict(part.split(" ", 1) for part in answer.headers["Content-Security-Policy"].split("; "))
    assert policy["default-src"] == "'none'" and policy["frame-ancestors"] == "'none'"
    assert "unsafe-inline" not in answer.headers["Content-Security-Policy"]
    assert policy["connect-src"] == "'self'"
    for path in ("/", "/ui.js", "/ui.css", "/api/state"):
        headers = page.call("GET", path).headers
        assert not [name for name in headers if name.lower().startswith("access-control")]
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert headers["Cache-Control"] == "no-store"


def test_it_listens_on_this_machine_alone(page: Page) -> None:
    port = int(page.host.split(":")[1])
    elsewhere = [at for *_, (at, *_) in socket.getaddrinfo(socket.gethostname(), port, socket.AF_INET)]
    for address in {*elsewhere, "127.0.0.2"} - {"127.0.0.1"}:
        with pytest.raises(OSError), socket.create_connection((address, port), 2):
            pass


@pytest.mark.parametrize(
    "path",
    ["/api", "/api/", "/api/nothing", "/api/run", "/api/run/", "/api/run/x", "/api/run/1/exe", "/api/run/1/tape/",
     "/api/run/9999999999", "/index.html", "/ui.py", "/../server.py", "/assets/index.html", "/%2e%2e/server.py",
     "/api/run/1/sheetxsvg", "http://[", "/api/run/١", "/favicon.ico"],
)  # fmt: skip
def test_unknown_routes(page: Page, path: str) -> None:
    assert page.call("GET", quote(path, safe="/%")).status == 404


def test_wrong_methods(page: Page) -> None:
    paths = {path for _, path in ROUTES} | {"/", "/ui.js", "/ui.css"}
    taken = {(method, path) for method, path in ROUTES} | {("GET", path) for path in ("/", "/ui.js", "/ui.css")}
    for path in paths:
        for method in ("GET", "POST", "PUT", "DELETE", "PATCH", "OPTIONS", "TRACE"):
            if (method, path) not in taken:
                assert page.call(method, path, b"").status == 405, (method, path)
        assert page.call("HEAD", path).status == 405
    assert page.call("BREW", "/api/state").status == 501


@pytest.mark.parametrize(
    "body",
    [b"", b"{", b"null", b"[]", b"7", b'"x"', b'{"rev":}', b"\xff\xfe", b"{}", b'{"rev":"1"}', b'{"rev":1.5}',
     b'{"rev":true}', b'{"rev":null}', b'{"rev":NaN}', b'{"rev":1e999}', b"[" * 100_000,
     b'{"rev":' + b"9" * 5000 + b"}", b'{"rev":' + b"[" * 100_000 + b"]" * 100_000 + b"}"],
    ids=lambda body: str(body[:20]),
)  # fmt: skip
@pytest.mark.parametrize(
    ("method", "path"), [("PUT", "/api/job"), ("POST", "/api/ways"), ("POST", "/api/cut"), ("POST", "/api/save")]
)
def test_bad_json(page: Page, method: str, path: str, body: bytes) -> None:
    answer = page.call(method, path, body)
    assert answer.status == 400 and len(answer.message) < 300


@pytest.mark.parametrize(
    ("name", "is_good"),
    [("part.dxf", True), ("Stück 零件.dxf", True), ("", False), ("../part.dxf", False), ("/etc/passwd", False),
     ("C:\\part.dxf", False), ("part\0.dxf", False), ("part\n.dxf", False), ("x" * 256, False), ("x" * 255, True)],
)  # fmt: skip
def test_names(page: Page, tmp_path: Path, name: str, is_good: bool) -> None:
    """No path comes from the browser."""
    answer = page.call("POST", "/api/open", plate(tmp_path).read_bytes(), X_Name=quote(name, safe=""))
    assert answer.status == (200 if is_good else 400)
    assert (answer.json["name"] == name) if is_good else answer.message


@pytest.mark.parametrize("name", ["%ff.dxf", "%C3%28.dxf", "%ED%A0%80.dxf"])
def test_names_that_are_no_utf8(page: Page, name: str) -> None:
    assert page.call("POST", "/api/open", b"x", X_Name=name).status == 400


def test_no_name(page: Page) -> None:
    assert page.call("POST", "/api/open", b"x").status == 400


def test_too_long(page: Page) -> None:
    """Bodies that are longer than may be are refused by what they say, and never read as the next request."""
    answer = page.call("POST", "/api/open", bytes(MOST_DRAWING + 1), X_Name="part.dxf")
    assert answer.status == 413 and "64 MB" in answer.message
    for method, path in (("PUT", "/api/job"), ("POST", "/api/ways"), ("POST", "/api/cut"), ("POST", "/api/save")):
        assert page.call(method, path, bytes(MOST_JSON + 1)).status == 413


def raw(page: Page, text: bytes, seconds: float = 5.0) -> bytes:
    """Sends raw bytes that no library would send, and returns the answer."""
    host, port = page.host.split(":")
    with socket.create_connection((host, int(port)), seconds) as connection:
        connection.sendall(text)
        connection.shutdown(socket.SHUT_WR)
        found = b""
        while part := connection.recv(65536):
            found += part
    return found


def head(page: Page, line: str, *more: str) -> bytes:
    return "\r\n".join([line, f"Host: {page.host}", f"Authorization: Bearer {page.token}", *more, "", ""]).encode()


@pytest.mark.parametrize(
    ("more", "status"),
    [
        (("Transfer-Encoding: chunked",), b"411"),
        (("Content-Length: -1",), b"411"),
        (("Content-Length: x",), b"411"),
        (("Content-Length: 1e3",), b"411"),
        (("Content-Length: 999999999999999",), b"413"),
        (("Content-Length: 5", "Transfer-Encoding: chunked"), b"411"),
        (("Content-Length: 5", "Content-Length: 50"), b"411"),
        (("Content-Length: 500",), b"408"),
    ],
)
def test_bodies_that_are_told_wrongly(page: Page, more: tuple[str, ...], status: bytes) -> None:
    """One answer and no more: what is left of such a body is not taken for a request."""
    smuggled = head(page, "GET /api/state HTTP/1.1")
    answer = raw(page, head(page, "PUT /api/job HTTP/1.1", *more) + smuggled)
    assert answer.startswith(b"HTTP/1.1 " + status)
    assert answer.count(b"HTTP/1.1 ") == 1


def test_two_hosts(page: Page) -> None:
    assert raw(page, head(page, "GET / HTTP/1.1", "Host: skg.example")).startswith(b"HTTP/1.1 403")
    assert raw(page, b"GET / HTTP/1.1\r\n\r\n").startswith(b"HTTP/1.1 403")


def test_body_where_none_belongs(page: Page) -> None:
    smuggled = head(page, "DELETE /api/run/1 HTTP/1.1")
    answer = raw(page, head(page, "GET /api/state HTTP/1.1", f"Content-Length: {len(smuggled)}") + smuggled)
    assert answer.startswith(b"HTTP/1.1 200") and answer.count(b"HTTP/1.1 ") == 1


@pytest.mark.parametrize(
    "text", [b"\0\1\2\3\r\n\r\n", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET " + b"x" * 70_000 + b"\r\n\r\n",
             b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 200 + b"\r\n", b"GET / HTTP/1.1\r\nX" + b"x" * 70_000 + b"\r\n\r\n"]
)  # fmt: skip
def test_what_is_no_request(page: Page, text: bytes) -> None:
    answer = raw(page, text)
    assert b" 4" in answer[:16] or b" 5" in answer[:16] or answer.startswith(b'{"error"'), answer[:100]
    assert page.call("GET", "/api/state").status == 200


def test_slow_clients(serve: Callable[[], Server], monkeypatch: pytest.MonkeyPatch) -> None:
    """Clients that send nothing, or too slowly, are dropped; their number is limited, and others are served."""
    monkeypatch.setattr(server_module.Handler, "timeout", 1.0)
    monkeypatch.setattr(server_module, "BODY", 2.0)
    page = Page(serve())
    host, port = page.host.split(":")
    silent = [socket.create_connection((host, int(port)), 10) for _ in range(server_module.CONNECTIONS // 2)]
    slow = socket.create_connection((host, int(port)), 10)
    slow.sendall(head(page, "PUT /api/job HTTP/1.1", "Content-Length: 1000000"))
    began = time.monotonic()
    answer = b""
    slow.settimeout(0.2)
    while not answer and time.monotonic() < began + 20:
        try:
            slow.sendall(b"{")
            answer = slow.recv(65536)
        except TimeoutError:
            continue
    assert answer.startswith(b"HTTP/1.1 408") and time.monotonic() - began > 1.5
    assert page.call("GET", "/api/state").status == 200
    for connection in silent:
        connection.settimeout(10)
        assert connection.recv(1) == b""
        connection.close()
    slow.close()


def test_too_many_connections(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    """One more is closed at once, the others stay; when they go there is room again."""
    monkeypatch.setattr(server_module, "HEADER", 600.0)
    host, port = page.host.split(":")
    some = [socket.create_connection((host, int(port)), 10) for _ in range(server_module.CONNECTIONS)]
    for connection in [socket.create_connection((host, int(port)), 10) for _ in range(10)]:
        assert connection.recv(1) == b""
        connection.close()
    for connection in some:
        connection.setblocking(False)
        with pytest.raises(BlockingIOError):
            connection.recv(1)
        connection.close()
    until(lambda: is_served(page))


def is_served(page: Page) -> bool:
    try:
        return page.call("GET", "/api/state").status == 200
    except OSError:
        return False


def test_ways_of_too_many(page: Page, tmp_path: Path) -> None:
    state = page.open(plate(tmp_path))
    for ids in ([0] * (MOST_WAYS + 1), [99], [-1], ["0"], [True], [1.5], [None], [10**30]):
        answer = page.call("POST", "/api/ways", {"rev": state["rev"], "ids": ids})
        assert answer.status == 400 and answer.message, ids


#: Values that a page would not send, and the keys of a job.
ODD = (None, True, -1, 1e308, 10**400, "", "x" * 10_000, [], {}, [1, 2], [[]], [{}])
TABLES = {
    "": "schema drawing sha256 box starts read machine default layer contour odd",
    "read": "units open tolerance start_layer fit_tolerance encoding layers bridges odd",
    "machine": "wire gap offset rom ram feed small into material thickness rates",
    "default": "cut side passes tab slug_tab tabs tab_passes overlap lead lead_shape reverse odd",
    "price": "per_area per_hole per_pass currency odd",
    "tape": "style short_name odd",
    "contour": "layer kind at size offset start entry order tab tabs passes",
}


def test_jobs_of_any_shape(page: Page, tmp_path: Path) -> None:
    """Each is planned or refused in one line, and the next one is none the worse."""
    state = page.open(plate(tmp_path, holes=1))
    which = {key: state["contours"][0][key] for key in ("layer", "kind", "at", "size")}
    rev, statuses = state["rev"], []
    for table, key in ((table, key) for table, keys in TABLES.items() for key in keys.split()):
        for value in ODD:
            job = state["job"] | {"contour": [which]}
            if table == "contour":
                job["contour"] = [which | {key: value}]
            else:
                job |= {table: {key: value}} if table else {key: value}
            answer = page.call("PUT", "/api/job", {"rev": rev, "job": job})
            assert answer.status in (200, 400), (table, key, value)
            statuses.append(answer.status)
            if answer.status == 200:
                rev = answer.json["rev"]
            else:
                assert len(answer.message) < 1000
    assert statuses.count(200) > 10 and statuses.count(400) > 200
    answer = page.done("PUT", "/api/job", {"rev": rev, "job": state["job"]})
    assert sorted(answer["plan"]["order"]) == [0, 1]


def test_headers_that_trickle(serve: Callable[[], Server], monkeypatch: pytest.MonkeyPatch) -> None:
    """All connections that there may be send headers byte by byte: they lock nobody out for long."""
    monkeypatch.setattr(server_module, "HEADER", 1.0)
    page = Page(serve())
    host, port = page.host.split(":")
    begun = b"GET /api/state HTTP/1.1\r\nX: "
    some = [socket.create_connection((host, int(port)), 10) for _ in range(server_module.CONNECTIONS)]
    answered = False
    for text in [begun, *[b"x"] * 400]:
        for connection in some:
            with suppress(OSError):
                connection.sendall(text)
        answered = is_served(page)
        if answered:
            break
        time.sleep(0.05)
    assert answered
    for connection in some:
        connection.close()


def test_header_after_header(page: Page) -> None:
    """The limit is one request's: a connection that is used again has it anew."""
    text = head(page, "GET /api/state HTTP/1.1")
    host, port = page.host.split(":")
    with socket.create_connection((host, int(port)), 30) as connection:
        for _ in range(3):
            connection.sendall(text[:20])
            time.sleep(0.1)
            connection.sendall(text[20:])
            assert connection.recv(65536).startswith(b"HTTP/1.1 200")
