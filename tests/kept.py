"""Tests that are not run again while nothing that they read has changed: `make test` passes --kept.

The key of a test file is a hash of all files of the project, but of those that it cannot read: what of `tools/skg` and
of other tests' folders it does not import, neither itself nor through others, and the folders and pages of `APART`
whose name none of these tests' files says. So what nobody thought of belongs to the key. A file that comes to the
command line (`skg.cli`, the program `skg`) or names the folder reads all of `tools/skg`. Programs and versions are in
the key, too. A file that says `tests` reads all of them, one that says `ls-files` everything.

`make test-all`, and CI, keep nothing, and pass --keys instead: a test that opens a file of the project that is not in
its key fails.
"""

from __future__ import annotations

import hashlib
import json
import os
import platform
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from functools import cache, cached_property
from importlib.metadata import distributions
from pathlib import Path

import pytest

#: Parts of the project that most tests do not read: they are in the key of a test whose files say their name.
APART = ("web", "docs", "release", "pico", ".github", ".ci", "README.md", "README.zh.md", "HACKING.md", "CHANGELOG.md",
         "CONTRIBUTING.md")  # fmt: skip
TOOLS, TESTS, OWN = "tools/skg/", "tests/", "tests/kept.py"
#: What reads all of the tools: the command line, by its module or by its program; the folder by its name.
COMMAND_LINE = re.compile(r"[\"'/]tools[\"'/]|skg\.cli|with_name\(\"skg\"\)|bin/skg\b|-m\", \"skg\"")
IMPORT = re.compile(r"^[ \t]*(?:from[ \t]+([\w.]+)[ \t]+import[ \t]+(\([^)]*\)|[^\n#]*)|import[ \t]+([^\n#]*))", re.M)
PROGRAMS = (
    "gcc",
    "clang-14",
    "wasm-ld-14",
    "node",
    "z88dk-z80asm",
    "altairz80",
    "arm-none-eabi-gcc",
    "qemu-system-arm",
)


def imported(text: str) -> set[str]:
    """The names of modules that a source may import: of `from a import b`, a and a.b."""
    names = set()
    for module, things, modules in IMPORT.findall(text):
        names |= {part.split()[0] for part in modules.split(",") if part.strip()}
        if module:
            words = re.sub(r"#.*", "", things).strip("()").split(",")
            names |= {module, *(f"{module}.{part.split()[0]}" for part in words if part.strip())}
    return names


def plain(name: str) -> str:
    """A test's name without its group (`--dist loadgroup`)."""
    return re.sub(r"@[^@\[\]]*$", "", name)


class Keys:
    """The keys of test files, in the tree at `root`; paths are those of git, with slashes."""

    def __init__(self, root: Path) -> None:
        self.root = root

    @cached_property
    def paths(self) -> list[str]:
        """Every file of the project: those that git knows, and new ones that it does not ignore."""
        command = ["git", "ls-files", "-co", "--exclude-standard", "-z"]
        done = subprocess.run(command, cwd=self.root, capture_output=True, text=True, check=True)
        return sorted(path for path in set(done.stdout.split("\0")) if path and (self.root / path).is_file())

    @cached_property
    def modules(self) -> dict[str, list[str]]:
        """Module -> the files that it may be: those of tests and asm/ are imported by their bare names."""
        known = defaultdict(list)
        for path in self.paths:
            if path.endswith(".py"):
                file = Path(path)
                if path.startswith(TOOLS):
                    name = ".".join(file.with_suffix("").parts[1:])
                    known[name.removesuffix(".__init__")].append(path)
                else:
                    known[file.stem].append(path)
        return known

    @cache  # noqa: B019 (one for a run)
    def hash(self, path: str) -> bytes:
        """Of a file's contents."""
        return hashlib.sha256((self.root / path).read_bytes()).digest()

    @cache  # noqa: B019
    def text(self, path: str) -> str:
        """A source."""
        return (self.root / path).read_text(errors="replace")

    @cache  # noqa: B019
    def leads_to(self, path: str) -> frozenset[str]:
        """The files that a Python file imports itself. A package brings its __init__."""
        found = set()
        for name in imported(self.text(path)):
            parts = name.split(".")
            for size in range(1, len(parts) + 1):
                found.update(self.modules.get(".".join(parts[:size]), ()))
        return frozenset(found)

    @cache  # noqa: B019
    def of(self, test: str) -> frozenset[str]:
        """The files in the key of a test file."""
        folder = test.rpartition("/")[0] + "/"
        own = {path for path in self.paths if path.startswith(folder) or re.fullmatch(r"tests/[^/]+", path)}
        waiting = [path for path in own if path.endswith(".py") and (path == test or "/test_" not in path)]
        followed = set(waiting) - {OWN}
        while waiting:
            new = self.leads_to(waiting.pop()) - followed - {OWN}
            followed |= new
            waiting += new
        reached = own | followed
        said = "\n".join(self.text(path) for path in followed if path.startswith(TESTS))
        apart = {top for top in APART if not re.search(rf"""["'/]{re.escape(top)}(?![\w-])""", said)}
        if "ls-files" in said:
            return frozenset(self.paths)
        all_tools, all_tests = COMMAND_LINE.search(said), re.search(r"""["'/]tests["'/]""", said)
        folders = {path.rpartition("/")[0] for path in reached if path.startswith(TOOLS)} | {"tools/skg/native"}
        for path in self.paths:
            if path.startswith(TOOLS):
                is_read = all_tools or (not path.endswith(".py") and path.rpartition("/")[0] in folders)
            elif path.startswith(TESTS):
                is_read = all_tests
            else:
                is_read = path.split("/")[0] not in apart
            if is_read:
                reached.add(path)
        return frozenset(reached)

    @cached_property
    def machine(self) -> str:
        """Programs and versions that any test may run."""
        there = [f"{name} {shutil.which(name)}" for name in PROGRAMS]
        compiler = subprocess.run([os.environ.get("CC", "cc"), "--version"], capture_output=True, text=True).stdout
        packages = sorted(f"{one.metadata['Name']} {one.version}" for one in distributions())
        return "\n".join([sys.version, platform.platform(), compiler, *there, *packages])

    @cache  # noqa: B019
    def key(self, test: str) -> str:
        """The hash of all that a test file may read."""
        total = hashlib.sha256(self.machine.encode())
        for path in sorted(self.of(test)):
            total.update(path.encode() + self.hash(path))
        return total.hexdigest()


class Kept:
    """What passed, by test file, with the file's key at that time; the option --kept leaves it out of a run."""

    def __init__(self, keys: Keys, file: Path) -> None:
        self.keys, self.file = keys, file
        self.known: dict[str, tuple[str, set[str]]] = {}
        self.passed: dict[str, set[str]] = defaultdict(set)
        self.failed: set[str] = set()
        self.left_out = 0
        if file.exists():
            self.known = {test: (key, set(names)) for test, (key, names) in json.loads(file.read_text()).items()}

    def names(self) -> dict[str, list[str]]:
        """The tests that may be left out, by their file."""
        return {
            test: sorted(names)
            for test, (key, names) in self.known.items()
            if (self.keys.root / test).exists() and self.keys.key(test) == key
        }

    def note(self, report: pytest.TestReport) -> None:
        """Take in what became of a test."""
        name = plain(report.nodeid)
        if report.failed:
            self.failed.add(name)
        elif report.when == "call" and report.passed:
            self.passed[name.partition("::")[0]].add(name)

    def write(self) -> None:
        """Keep it for the next run."""
        still = self.names()
        now = {}
        for test in {*still, *self.passed}:
            names = (set(still.get(test, ())) | self.passed.get(test, set())) - self.failed
            if names:
                now[test] = (self.keys.key(test), sorted(names))
        self.file.parent.mkdir(exist_ok=True)
        new = self.file.with_suffix(".new")
        new.write_text(json.dumps(now))
        new.replace(self.file)


class Watch:
    """The option --keys: no test opens a file of the project that is not in its key."""

    def __init__(self, root: Path) -> None:
        self.keys = Keys(root)
        self.project = set(self.keys.paths)
        self.start = f"{root.as_posix()}/"
        self.test = ""
        sys.addaudithook(self.look)

    def look(self, event: str, what: tuple[object, ...]) -> None:
        """Take in an event of the interpreter."""
        if event == "open" and self.test and isinstance(what[0], str) and what[0].startswith(self.start):
            path, test = os.path.normpath(what[0]).replace(os.sep, "/").removeprefix(self.start), self.test
            if path in self.project and path not in self.keys.of(test):
                raise AssertionError(f"{test} reads {path}, which is not in its key (tests/kept.py)")

    @pytest.hookimpl(hookwrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        """Look at what a test opens, and its fixtures."""
        test = item.nodeid.partition("::")[0]
        self.keys.of(test)
        self.test = test
        yield
        self.test = ""


class Plugin:
    """The option --kept, in the process that controls a run and in those that test."""

    def __init__(self, config: pytest.Config, root: Path) -> None:
        self.names: dict[str, list[str]] = {}
        self.kept: Kept | None = None
        if hasattr(config, "workerinput"):
            self.names = config.workerinput.get("kept", {})
        else:
            # (the keys are those of the files as they are now: one that is edited meanwhile counts for the next run)
            self.kept = Kept(Keys(root), root / "build" / "kept.json")
            self.names = self.kept.names()
            for test in sorted(path.relative_to(root).as_posix() for path in root.glob("tests/*/test_*.py")):
                self.kept.keys.key(test)

    @pytest.hookimpl(optionalhook=True)
    def pytest_configure_node(self, node: object) -> None:
        """Tell a process of xdist's what is kept."""
        node.workerinput["kept"] = self.names

    def pytest_collection_modifyitems(self, config: pytest.Config, items: list[pytest.Item]) -> None:
        """Leave out what is kept."""
        kept = {name for names in self.names.values() for name in names}
        out = [item for item in items if plain(item.nodeid) in kept]
        if out:
            items[:] = [item for item in items if item not in set(out)]
            config.hook.pytest_deselected(items=out)
        if hasattr(config, "workerinput"):
            config.workeroutput["kept"] = len(out)
        elif self.kept:
            self.kept.left_out = len(out)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: object) -> None:
        """Take in how many a process left out: all leave out the same."""
        if self.kept:
            self.kept.left_out = max(self.kept.left_out, getattr(node, "workeroutput", {}).get("kept", 0))

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if self.kept:
            self.kept.note(report)

    def pytest_sessionfinish(self) -> None:
        if self.kept:
            self.kept.write()

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        if self.kept and self.kept.left_out:
            terminalreporter.write_line(
                f"kept: {self.kept.left_out} tests of {len(self.names)} files passed before with all that they read as"
                " it is now (make test-all runs them, too)"
            )
