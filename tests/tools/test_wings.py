"""The wings of tools/skg: which may import which, read from the sources; one name has one meaning."""

from __future__ import annotations

import ast
import functools
import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

#: In the process that has read the sources.
pytestmark = pytest.mark.xdist_group("wings")

ROOT = Path(__file__).parents[2] / "tools"
SOURCES = sorted((ROOT / "skg").rglob("*.py"))

#: What a wing may import besides itself. What stands beside the wings is common ground, and so are the messages.
COMMON = "common ground"
ALLOWED = {
    COMMON: set(),
    "ref": {COMMON},
    "rivals": {COMMON},
    "native": {COMMON},
    "geometry": {COMMON},
    "job": {COMMON, "geometry", "tape"},
    "tape": {COMMON, "native", "geometry"},
    "board": {COMMON, "native", "tape"},
    "reading": {COMMON, "geometry", "job"},
    "planning": {COMMON, "geometry", "job"},
    "checking": {COMMON, "geometry", "job", "tape", "planning", "ref"},
    "cutting": {COMMON, "geometry", "job", "tape", "planning", "checking", "board"},
    "pipeline": {COMMON, "geometry", "job", "reading", "planning", "checking", "cutting"},
    "sources": {COMMON, "geometry", "tape", "board", "ref", "rivals"},
    "pictures": {COMMON, "geometry", "job", "tape", "planning", "checking", "cutting"},
}
ALLOWED["dialects"] = {COMMON, "geometry", "job", "planning", "tape"}
ALLOWED["ui"] = {COMMON, "geometry", "job", "reading", "tape", "planning", "cutting", "pipeline", "pictures"}
ALLOWED["commands"] = set(ALLOWED) - {"native"}
#: Modules beside the wings that are nobody's ground: the package's door, and the command line.
DOORS = {"skg", "skg.cli", "skg.__main__"}


def name_of(path: Path) -> str:
    """The module in a file, as it is imported."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@functools.cache
def modules() -> dict[str, ast.Module]:
    """The package's modules, read. (not when tests are collected, which each process does)"""
    return {name_of(path): ast.parse(path.read_text()) for path in SOURCES}


@functools.cache
def imported(module: str) -> set[str]:
    """The modules that one imports, anywhere in its text."""
    found: set[str] = set()
    for node in ast.walk(modules()[module]):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{module}: a relative import"
            inner = [f"{node.module}.{alias.name}" for alias in node.names]
            found |= {name if name in modules() else node.module for name in inner}
    return found


def imports(module: str) -> set[str]:
    """Those of the package among them."""
    return {name for name in imported(module) if name.split(".")[0] == "skg"}


@functools.cache
def graph() -> dict[str, set[str]]:
    """What each module imports."""
    return {module: imports(module) for module in modules()}


def wing(module: str) -> str:
    """The wing that a module belongs to."""
    parts = module.split(".")
    return parts[1] if len(parts) > 1 and parts[1] in ALLOWED else COMMON


def test_what_is_imported_is_there() -> None:
    assert len(modules()) > 40
    assert {name for names in graph().values() for name in names} <= set(modules())


def test_hacking_names_the_folders_of_the_tests() -> None:
    """Each folder that has tests is in HACKING.md's table of them, and no other."""
    rows = re.findall(r"^\| (`tests/.*?) \|", (ROOT.parent / "HACKING.md").read_text(), re.M)
    named = sorted(folder for row in rows for folder in re.findall(r"`tests/(\w+)`", row))
    assert named == sorted({path.parent.name for path in (ROOT.parent / "tests").glob("*/test_*.py")})


def test_every_folder_is_a_wing() -> None:
    folders = {path.parent.name for path in SOURCES if path.parent.parent == ROOT / "skg"}
    assert folders - {"messages"} == set(ALLOWED) - {COMMON}


def test_hacking_tells_the_wings() -> None:
    """The table of HACKING.md: each wing, and on which others it leans."""
    rows = re.findall(r"^\| `(\w+)` \|.*\| (.*?) ?\|$", (ROOT.parent / "HACKING.md").read_text(), re.M)
    assert len(rows) == len(ALLOWED) - 1
    for name, leans in rows:
        others = ALLOWED[name] - {COMMON}
        if leans.startswith("all but "):
            others = set(ALLOWED) - {COMMON, name} - others
        assert set(re.findall(r"`(\w+)`", leans)) == others, name


def test_wings_lean_on_those_below() -> None:
    wrong = [
        f"{module} imports {name}"
        for module, names in graph().items()
        if module not in DOORS
        for name in names
        if name in DOORS or wing(name) not in ALLOWED[wing(module)] | {wing(module)}
    ]
    assert not wrong


def test_allowed_is_without_circles() -> None:
    TopologicalSorter(ALLOWED).prepare()


def test_modules_are_without_circles() -> None:
    """Inside the wings too. (A package's own face is no module of its wing: it imports those below it.)"""
    try:
        TopologicalSorter(graph()).prepare()
    except CycleError as error:
        pytest.fail(" -> ".join(error.args[1]))


def test_commands_alone_know_the_command_line() -> None:
    """Click is imported by commands alone, and nothing imports a command."""
    for module in modules():
        roots = {name.split(".")[0] for name in imported(module)}
        assert "click" not in roots or module == "skg.cli" or wing(module) == "commands", module


def type_names(tree: ast.Module) -> Iterator[str]:
    """Names of a module's classes, of its aliases of types, and those that it gives to what it imports."""
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.ImportFrom):
            yield from (alias.asname for alias in node.names if alias.asname and alias.name[0].isupper())
        elif isinstance(node, ast.Assign) and (
            isinstance(node.value, ast.Subscript)
            or isinstance(node.value, ast.BinOp)
            and isinstance(node.value.op, ast.BitOr)
        ):
            yield from (target.id for target in node.targets if isinstance(target, ast.Name) and target.id[0].isupper())


def test_one_name_one_meaning() -> None:
    """No two modules give the same name to a type."""
    found: dict[str, list[str]] = defaultdict(list)
    for module, tree in modules().items():
        for name in type_names(tree):
            found[name].append(module)
    assert {"Piece", "Placed", "XY", "Tape", "Punch", "Curve"} <= set(found)
    assert not {name: modules for name, modules in found.items() if len(modules) > 1}


def test_test_helpers_have_names_of_their_own() -> None:
    """A module that a test imports from its folder is found by name alone, with any folders in one run: no other
    folder may have that name, and every folder has a conftest."""
    tests = sorted((ROOT.parent / "tests").rglob("*.py"))
    names = Counter(path.stem for path in tests)
    imported = {
        name
        for path in tests
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Import | ast.ImportFrom)
        for name in ([node.module] if isinstance(node, ast.ImportFrom) else [alias.name for alias in node.names])
        if name in names
    }
    assert {"toolhelp", "romhelp"} <= imported
    assert not [name for name in imported if names[name] > 1]
