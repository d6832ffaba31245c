"""What is kept from run to run (tests/kept.py): a test runs again when something that it may read has changed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from kept import Kept, Keys

TREE = {
    ".gitignore": "build/",
    "asm/some.asm": "NOP",
    "web/page.ts": "",
    "docs/page.md": "",
    "docs/curves.md": "",
    "tools/skg/__init__.py": "",
    "tools/skg/cli.py": "",
    "tools/skg/ref/__init__.py": "from skg.ref.parser import parse",
    "tools/skg/ref/parser.py": "",
    "tools/skg/ref/skg.lark": "",
    "tools/skg/cutting/__init__.py": "",
    "tools/skg/cutting/job.py": "",
    "tests/conftest.py": "",
    "tests/rom/romhelp.py": "",
    "tests/rom/test_tape.py": "from skg import (\n    ref,  # the reference\n)\nimport other",
    "tests/rom/test_pages.py": 'ROOT / "docs" / "page.md"\nimport romhelp',
    "tests/rom/test_more.py": "import test_tape, skg.cutting.job",
    "tests/tools/other.py": "",
    "tests/tools/test_cut.py": "from skg.cli import cli",
}


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A small project."""
    for path, text in TREE.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    subprocess.run(["git", "init", "-q"], cwd=tmp_path, check=True)
    return tmp_path


def keys(tree: Path) -> dict[str, str]:
    """The key of each test file."""
    now = Keys(tree)
    return {
        test: now.key(f"tests/{test}.py")
        for test in ("rom/test_tape", "rom/test_pages", "rom/test_more", "tools/test_cut")
    }


@pytest.mark.parametrize(
    ("changed", "again"),
    [
        ("asm/some.asm", "tape pages more cut"),  # what nobody excludes
        ("new.txt", "tape pages more cut"),
        ("tests/conftest.py", "tape pages more cut"),
        ("tools/skg/ref/parser.py", "tape more cut"),  # through others
        ("tools/skg/ref/skg.lark", "tape more cut"),  # beside them
        ("tools/skg/cutting/job.py", "more cut"),
        ("tools/skg/new.py", "cut"),
        ("docs/curves.md", "pages"),
        ("web/page.ts", ""),
        ("tests/rom/romhelp.py", "tape pages more"),
        ("tests/tools/other.py", "tape more cut"),
    ],
)
def test_what_runs_again(tree: Path, changed: str, again: str) -> None:
    before = keys(tree)
    (tree / changed).write_text("changed")
    assert [test.rpartition("_")[2] for test, key in keys(tree).items() if key != before[test]] == again.split()


def test_a_file_that_is_gone(tree: Path) -> None:
    before = keys(tree)
    (tree / "asm/some.asm").unlink()
    assert all(key != before[test] for test, key in keys(tree).items())


def report(name: str, outcome: str) -> pytest.TestReport:
    return pytest.TestReport(name, ("", 0, ""), {}, outcome, None, "call")


def test_what_passed_alone_is_kept(tree: Path) -> None:
    """Until it fails, or something changes."""
    file = tree / "build" / "kept.json"
    one, two = "tests/rom/test_tape.py::test_one[A]", "tests/rom/test_tape.py::test_two"
    for outcomes, left in (
        ({one: "passed", two: "failed"}, [one]),
        ({two: "passed"}, [one, two]),
        ({one: "failed"}, [two]),
    ):
        kept = Kept(Keys(tree), file)
        for name, outcome in outcomes.items():
            kept.note(report(f"{name}@group" if name == one else name, outcome))
        kept.write()
        assert Kept(Keys(tree), file).names() == {"tests/rom/test_tape.py": left}
    (tree / "asm/some.asm").write_text("RET")
    assert Kept(Keys(tree), file).names() == {}


def test_a_test_that_reads_more_than_its_key(tree: Path) -> None:
    """--keys finds it, in a run of its own."""
    root = Path(__file__).parents[2]
    test = tree / "tests" / "rom" / "test_tape.py"
    test.write_text(
        f"def test(): open({str(tree)!r} + '/we' 'b/page.ts')\ndef test_own(): open({str(tree / 'asm/some.asm')!r})\n"
    )
    (tree / "tests" / "conftest.py").write_text(
        f"import sys; sys.path.insert(0, {str(root / 'tests')!r}); import kept, pathlib\n"
        "def pytest_configure(config): config.pluginmanager.register(kept.Watch(pathlib.Path(__file__).parents[1]))\n"
    )
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", test], cwd=tree, capture_output=True, text=True
    )
    assert "1 failed, 1 passed" in done.stdout and "reads web/page.ts" in done.stdout, done.stdout
