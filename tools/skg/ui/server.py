"""The server for the page: on this machine alone, for those alone who have the token. Routes, limits, answers."""

from __future__ import annotations

import io
import json
import os
import re
import secrets
import select
import socket
import socketserver
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from hmac import compare_digest
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from threading import BoundedSemaphore, Event, Lock, Thread
from typing import TYPE_CHECKING, NoReturn, TypeVar
from urllib.parse import parse_qs, unquote

from skg.errors import UserError
from skg.job.job import TapeForm
from skg.messages.catalogue import LANGUAGES
from skg.messages.finding import Finding
from skg.tape.styles import STYLES
from skg.terminal import remark
from skg.ui.json_text import encoded, said, told
from skg.ui.session import Conflict, Session
from skg.ui.worker import mistake

if TYPE_CHECKING:
    from _typeshed import WriteableBuffer

#: A connection as socketserver has it: a stream, or a datagram with its socket.
_Connection = socket.socket | tuple[bytes, socket.socket]
_Kind = TypeVar("_Kind")

#: The page and what belongs to it: path -> file of `assets`, its type.
ASSETS = {
    "/": ("index.html", "text/html; charset=utf-8"),
    "/ui.js": ("ui.js", "text/javascript; charset=utf-8"),
    "/ui.css": ("ui.css", "text/css; charset=utf-8"),
}
#: A drawing is no larger, nor what else comes from the page; bytes.
MOST_DRAWING, MOST_JSON = 64 << 20, 16 << 20
#: A file's name has no more letters.
MOST_NAME = 255
#: A client that says nothing for so long is left; one header and one body take no longer than these; s.
SILENCE, HEADER, BODY = 30.0, 10.0, 120.0
#: So many connections at once, more than a few pages have.
CONNECTIONS = 64
#: A question for news is answered after so long, whether there is any or not, s.
PATIENCE = 25.0
#: So often it is seen whether anybody still waits for that, s.
GLANCE = 1.0
#: Without a page for so long, once there was one, the server ends, s. (Browsers put pages aside, and load them again.)
ALONE = 600.0
#: Permissions of a page from here: to talk to this server alone.
POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
#: Types of the files of a run.
TYPES = {
    "tape": "text/plain; charset=us-ascii",
    "program": "text/plain; charset=us-ascii",
    "holes": "text/csv; charset=us-ascii",
    "drill": "text/plain; charset=us-ascii",
    "sheet": "application/pdf",
    "sheet.svg": "image/svg+xml",
    "job": "application/toml; charset=utf-8",
}


class Refused(Exception):
    """A request that is not answered."""

    def __init__(self, status: HTTPStatus, message: str) -> None:
        super().__init__(message)
        self.status = status


class Server(ThreadingHTTPServer):
    """The server; `url` opens the page. `is_seen`: somebody has opened it."""

    daemon_threads = True
    # (who has to ask again for a connection waits for a second)
    request_queue_size = CONNECTIONS
    # (on Windows it would let others take the port as well)
    allow_reuse_address = os.name == "posix"

    def __init__(self, port: int, session: Session) -> None:
        self.session = session
        self.token = secrets.token_urlsafe(24)
        self.is_seen = Event()
        #: Requests of pages that are being answered; seconds without any, None before the first.
        self._asked, self._lock = 0, Lock()
        self._alone: float | None = None
        self._looked = time.monotonic()
        #: Set when the server is told to end.
        self.ending = Event()
        self._free = BoundedSemaphore(CONNECTIONS)
        super().__init__(("127.0.0.1", port), Handler)
        self.host = f"127.0.0.1:{self.server_address[1]}"

    @property
    def url(self) -> str:
        """The page, with the token where no server and no log sees it."""
        return f"http://{self.host}/#token={self.token}"

    @contextmanager
    def asked(self) -> Iterator[None]:
        """Note that a page is there, and waits."""
        with self._lock:
            self._asked += 1
        try:
            yield
        finally:
            with self._lock:
                self._asked -= 1
                self._alone = 0.0

    def service_actions(self) -> None:
        """End when the last page has been gone for a while, and nothing would be lost; called about twice a second."""
        now = time.monotonic()
        # (a computer that slept has not waited for its page)
        passed, self._looked = min(now - self._looked, GLANCE), now
        with self._lock:
            if self._alone is None or self._asked:
                return
            self._alone += passed
        if self._alone > ALONE and self.session.may_end():
            self.end()

    def end(self) -> None:
        """End `serve_forever`, from whatever thread."""
        if not self.ending.is_set():
            self.ending.set()
            # (it waits for the loop, which may be the caller)
            Thread(target=self.shutdown, daemon=True).start()

    def server_bind(self) -> None:
        """Bind without asking name servers who 127.0.0.1 is."""
        if hasattr(socket, "SO_EXCLUSIVEADDRUSE"):
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_EXCLUSIVEADDRUSE, 1)
        socketserver.TCPServer.server_bind(self)
        self.server_name, self.server_port = str(self.server_address[0]), int(self.server_address[1])

    def process_request(self, request: _Connection, client_address: tuple[str, int]) -> None:
        """Take a connection, but not more than there may be."""
        if self._free.acquire(blocking=False):
            super().process_request(request, client_address)
        else:
            self.shutdown_request(request)

    def process_request_thread(self, request: _Connection, client_address: tuple[str, int]) -> None:
        """Serve a connection to its end."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._free.release()

    def handle_error(self, request: _Connection, client_address: tuple[str, int]) -> None:
        """Say nothing of a client that went away."""


class _Incoming(io.RawIOBase):
    """The bytes that come over a connection. `is_header`: a request's header must be whole within `HEADER` of its first
    byte, that of the first request within so long of the connection's beginning."""

    def __init__(self, connection: socket.socket) -> None:
        self._connection = connection
        self._last: float | None = time.monotonic() + HEADER
        self.is_header = True

    def readable(self) -> bool:
        """Tell that it can be read."""
        return True

    def readinto(self, buffer: WriteableBuffer) -> int:
        """Take what there is; a header that is late is a `TimeoutError`."""
        usual = self._connection.gettimeout()
        if self.is_header and self._last is not None:
            left = self._last - time.monotonic()
            if left <= 0:
                raise TimeoutError
            self._connection.settimeout(left if usual is None else min(left, usual))
        try:
            count = self._connection.recv_into(buffer)
        finally:
            self._connection.settimeout(usual)
        if self.is_header and self._last is None:
            self._last = time.monotonic() + HEADER
        return count

    def expect_header(self) -> None:
        """Another request may come, or none."""
        self.is_header, self._last = True, None


class Handler(BaseHTTPRequestHandler):
    """One connection."""

    server: Server
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "skg", ""
    timeout = SILENCE
    # (headers and body as one packet each would wait for the other side's acknowledgement)
    wbufsize = -1
    disable_nagle_algorithm = True
    #: So much of a request's body has not been read, bytes; -1: nobody knows.
    _body_left = 0

    def setup(self) -> None:
        """Begin with a connection."""
        super().setup()
        self.rfile.close()
        self._incoming = _Incoming(self.connection)
        self.rfile = io.BufferedReader(self._incoming)

    def handle_one_request(self) -> None:
        """Read a request and answer it."""
        super().handle_one_request()
        self._incoming.expect_header()

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 (the library's name)
        """Write no log."""

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """Answer a request that is none, as the library finds it."""
        self._refuse(HTTPStatus(code), _request(message or HTTPStatus(code).phrase), {})

    def do_GET(self) -> None:
        """Answer any request."""
        self._incoming.is_header = False
        self._body_left = self._announced()
        try:
            self._answer()
        except Refused as refused:
            self._refuse(refused.status, _request(str(refused)), {})
        except Conflict as conflict:
            self._refuse(HTTPStatus.CONFLICT, told(conflict), conflict.data)
        except UserError as error:
            self._refuse(HTTPStatus.BAD_REQUEST, told(error), {})
        except (ConnectionError, TimeoutError):
            # (the client went away)
            self.close_connection = True
        except Exception as error:
            finding = mistake(error)
            remark(finding, "skg ui")
            self._refuse(HTTPStatus.INTERNAL_SERVER_ERROR, {"message": said(finding)}, {})

    do_HEAD = do_POST = do_PUT = do_DELETE = do_PATCH = do_OPTIONS = do_TRACE = do_CONNECT = do_GET

    def _answer(self) -> None:
        if self.headers.get_all("Host") != [self.server.host]:
            raise Refused(HTTPStatus.FORBIDDEN, f"this server is {self.server.host} and nothing else")
        path, _, query = self.path.partition("?")
        if path in ASSETS:
            self._allow("GET")
            name, kind = ASSETS[path]
            self._send((files("skg.ui") / "assets" / name).read_bytes(), kind)
            return
        self._refuse_strangers()
        route, words = self._route(path)
        with self.server.asked():
            route(self, {key: values[-1] for key, values in parse_qs(query).items()}, *words)

    def _refuse_strangers(self) -> None:
        """Refuse who comes from another page, or has not the token."""
        origin = self.headers.get_all("Origin", [])
        if any(address != f"http://{self.server.host}" for address in origin):
            raise Refused(HTTPStatus.FORBIDDEN, "another page's request")
        given = self.headers.get("Authorization", "")
        if not compare_digest(given.encode("utf-8", "replace"), f"Bearer {self.server.token}".encode()):
            raise Refused(HTTPStatus.UNAUTHORIZED, "no token, or a wrong one: open the address that skg ui printed")
        self.server.is_seen.set()

    def _route(self, path: str) -> tuple[Callable, tuple[str, ...]]:
        others = []
        for method, pattern, route in ROUTES:
            if match := re.fullmatch(pattern, path):
                if method == self.command:
                    return route, match.groups()
                others.append(method)
        if others:
            self._allow(*others)
        raise Refused(HTTPStatus.NOT_FOUND, f"there is no {path[:100]}")

    def _allow(self, *methods: str) -> None:
        if self.command not in methods:
            raise Refused(HTTPStatus.METHOD_NOT_ALLOWED, f"{self.command} is not for this: {', '.join(methods)}")

    # Requests.

    def _announced(self) -> int:
        """Length of a request's body; -1: not told in a way that is taken."""
        lengths = self.headers.get_all("Content-Length", ["0"])
        is_told = "Transfer-Encoding" not in self.headers and len(lengths) == 1
        return int(lengths[0]) if is_told and re.fullmatch("[0-9]{1,15}", lengths[0]) else -1

    def _body(self, most: int) -> bytes:
        if self._body_left < 0:
            raise Refused(HTTPStatus.LENGTH_REQUIRED, "a body comes with its Content-Length")
        if self._body_left > most:
            raise Refused(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"more than {most >> 20} MB")
        parts = []
        last = time.monotonic() + BODY
        with suppress(TimeoutError):
            while self._body_left and time.monotonic() < last:
                part = self.rfile.read1(min(self._body_left, 1 << 20))
                if not part:
                    break
                parts.append(part)
                self._body_left -= len(part)
        if self._body_left:
            raise Refused(HTTPStatus.REQUEST_TIMEOUT, "the body did not come to its end")
        return b"".join(parts)

    def _json(self) -> dict:
        try:
            data = json.loads(self._body(MOST_JSON), parse_constant=_no_number)
        except (ValueError, RecursionError) as error:
            raise Refused(HTTPStatus.BAD_REQUEST, f"the body is no JSON: {error}") from None
        if not isinstance(data, dict):
            raise Refused(HTTPStatus.BAD_REQUEST, "the body is no object of JSON")
        return data

    def _name(self) -> str:
        """The name of the file that the body has."""
        try:
            name = unquote(self.headers.get("X-Name", ""), errors="strict")
        except UnicodeDecodeError:
            raise Refused(HTTPStatus.BAD_REQUEST, "X-Name: not UTF-8 in percent encoding") from None
        if not 0 < len(name) <= MOST_NAME or re.search(r"[\0-\x1f\x7f/\\]", name):
            raise Refused(HTTPStatus.BAD_REQUEST, "X-Name: the name of a file, without a folder")
        return name

    # Answers.

    def _state(self, query: dict[str, str]) -> None:
        after, drawn = _number(query, "after"), _number(query, "drawn")
        state = self._awaited(lambda patience: self.server.session.state(after, patience, drawn), after)
        if state is None:
            self._send(b"", "", HTTPStatus.NO_CONTENT)
        else:
            self._send_json(state)

    def _awaited(self, ask: Callable[[float], dict | None], after: int | None) -> dict | None:
        """The state asked for; waits so long (s) for news after what the page knows."""
        last = time.monotonic() + PATIENCE
        while (state := ask(GLANCE if after is not None else 0.0)) is None and time.monotonic() < last:
            self._expect_client()
        return state

    def _expect_client(self) -> None:
        """Give up what nobody waits for any more."""
        if select.select([self.connection], [], [], 0.0)[0] and not self.connection.recv(1, socket.MSG_PEEK):
            raise ConnectionAbortedError

    def _open(self, query: dict[str, str]) -> None:
        name = self._name()
        self._send_json(self.server.session.open(self._body(MOST_DRAWING), name))

    def _put_job(self, query: dict[str, str]) -> None:
        data = self._json()
        self._send_json(self.server.session.plan(_field(data, "rev", int), _field(data, "job", dict)))

    def _get_job(self, query: dict[str, str]) -> None:
        self._send(self.server.session.job(), TYPES["job"])

    def _ways(self, query: dict[str, str]) -> None:
        data = self._json()
        ids = _field(data, "ids", list)
        if not all(type(number) is int for number in ids):
            raise Refused(HTTPStatus.BAD_REQUEST, "ids: expected numbers of contours")
        self._send_json(self.server.session.ways(_field(data, "rev", int), ids))

    def _cut(self, query: dict[str, str]) -> None:
        self._send_json({"run": self.server.session.cut(_field(self._json(), "rev", int))})

    def _run(self, query: dict[str, str], number: str) -> None:
        after = _number(query, "after")
        run = self._awaited(lambda patience: self.server.session.run(int(number), after, patience), after)
        self._send_json(run or self.server.session.run(int(number)))

    def _cancel(self, query: dict[str, str], number: str) -> None:
        self._send_json(self.server.session.cancel(int(number)))

    def _file(self, query: dict[str, str], number: str, kind: str) -> None:
        session = self.server.session
        if kind == "job" and query.get("style") in STYLES:
            file = session.job_in_form(int(number), TapeForm(query["style"], query.get("short") == "true"))
        else:
            file = session.file(int(number), kind, _language(query.get("language")), member=query.get("member", ""))
        self._send(file, TYPES[kind])

    def _save(self, query: dict[str, str]) -> None:
        data = self._json()
        kinds = _field(data, "what", list)
        run = None if data.get("run") is None else _field(data, "run", int)
        name, style = (
            _field(data, key, str) if key in data else usual for key, usual in (("name", ""), ("style", "punch"))
        )
        is_over, form = data.get("overwrite") is True, TapeForm(style, data.get("short") is True)
        language = _language(data.get("language"))
        written = self.server.session.save(run, kinds, is_over, name, form, language)
        self._send_json({"written": written})

    def _rest(self, query: dict[str, str], number: str, block: str) -> None:
        style, member = query.get("style", "punch"), query.get("member", "")
        rest = self.server.session.styled(int(number), style, int(block), member)
        self._send(rest, TYPES["tape"])

    def _take(self, query: dict[str, str]) -> None:
        data = self._json()
        self._send_json(self.server.session.take(_field(data, "name", str), data.get("take") is True))

    def _setups(self, query: dict[str, str]) -> None:
        self._send_json(self.server.session.setups())

    def _use_setup(self, query: dict[str, str]) -> None:
        self._send_json(self.server.session.use_setup(_field(self._json(), "name", str)))

    def _keep_setup(self, query: dict[str, str]) -> None:
        data = self._json()
        name, tables = _field(data, "name", str), _field(data, "tables", dict)
        self._send_json(self.server.session.keep_setup(name, tables, data.get("overwrite") is True))

    def _drop_setup(self, query: dict[str, str]) -> None:
        self._send_json(self.server.session.drop_setup(_field(self._json(), "name", str)))

    def _send_json(self, data: dict, status: HTTPStatus = HTTPStatus.OK) -> None:
        self._send(encoded(data), "application/json", status)

    def _refuse(self, status: HTTPStatus, error: dict, data: dict) -> None:
        self._send_json({"error": error, **data}, status)
        self._drain()

    def _drain(self) -> None:
        """Take what a client still sends, for a while: else it would not read why it is refused."""
        last = time.monotonic() + 2.0
        with suppress(OSError):
            self.wfile.flush()
            self.connection.settimeout(0.5)
            while self._body_left > 0 and time.monotonic() < last:
                part = self.rfile.read1(1 << 20)
                if not part:
                    break
                self._body_left -= len(part)
            self.connection.settimeout(self.timeout)

    def _send(self, body: bytes, kind: str, status: HTTPStatus = HTTPStatus.OK) -> None:
        if self._body_left:
            # (a body that is not read is not the next request)
            self.close_connection = True
        self.send_response(status)
        if kind:
            self.send_header("Content-Type", kind)
        if status != HTTPStatus.NO_CONTENT:
            self.send_header("Content-Length", str(len(body)))
        if self.close_connection:
            self.send_header("Connection", "close")
        self.send_header("Content-Security-Policy", POLICY)
        self.send_header("X-Content-Type-Options", "nosniff")
        self.send_header("Referrer-Policy", "no-referrer")
        self.send_header("Cross-Origin-Resource-Policy", "same-origin")
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)


#: Method, path, what answers.
ROUTES = (
    ("GET", "/api/state", Handler._state),
    ("POST", "/api/open", Handler._open),
    ("PUT", "/api/job", Handler._put_job),
    ("GET", "/api/job", Handler._get_job),
    ("POST", "/api/ways", Handler._ways),
    ("POST", "/api/cut", Handler._cut),
    ("GET", "/api/run/([0-9]{1,9})", Handler._run),
    ("DELETE", "/api/run/([0-9]{1,9})", Handler._cancel),
    ("GET", "/api/run/([0-9]{1,9})/(tape|program|sheet|sheet[.]svg|job|holes|drill)", Handler._file),
    ("GET", "/api/run/([0-9]{1,9})/from/([0-9]{1,9})", Handler._rest),
    ("POST", "/api/save", Handler._save),
    ("POST", "/api/take", Handler._take),
    ("GET", "/api/setups", Handler._setups),
    ("POST", "/api/setups", Handler._use_setup),
    ("PUT", "/api/setups", Handler._keep_setup),
    ("DELETE", "/api/setups", Handler._drop_setup),
)


def _request(detail: str) -> dict:
    """The error of a request that no page of ours makes."""
    return {"message": said(Finding("bad-request", detail=detail))}


def _no_number(text: str) -> NoReturn:
    raise ValueError(f"{text} is no number")


def _field(data: dict, name: str, kind: type[_Kind]) -> _Kind:
    """A field of a body."""
    value = data.get(name)
    # (True is an int, and no number here)
    if not isinstance(value, kind) or type(value) is not kind:
        expected = {int: "a whole number", list: "a list", dict: "an object", str: "a text"}[kind]
        raise Refused(HTTPStatus.BAD_REQUEST, f"{name}: expected {expected}")
    return value


def _language(value: object) -> str:
    """A language that is asked for, nothing for any other."""
    return value if value in LANGUAGES else ""


def _number(query: dict[str, str], name: str) -> int | None:
    """A number behind the path, None where there is none."""
    value = query.get(name)
    if value is None:
        return None
    if not re.fullmatch("[0-9]{1,9}", value):
        raise Refused(HTTPStatus.BAD_REQUEST, f"{name}: expected a whole number")
    return int(value)
