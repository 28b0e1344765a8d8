"""Mutants of Python: who sees them, and what counts as seen."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from tests.tools.mutating.changes import Mutant
from tests.tools.mutating.python import Copy, Result, candidates, chosen, ordered, sources_of, summary
from tests.tools.selection.table import Duration, Table

MODULE = "def half(number):\n    return number / 2 if number > 1 else 0\n"
TESTS = """
from product import half

def test_four():
    assert half(4) == 2

def test_one():
    assert half(1) == 0

def test_always_fails():
    assert half(4) == 3
"""


@pytest.fixture
def copy(tmp_path: Path) -> Copy:
    (tmp_path / "tests").mkdir()
    (tmp_path / "product.py").write_text(MODULE)
    (tmp_path / "tests" / "test_it.py").write_text(TESTS)
    (tmp_path / "pytest.ini").write_text("[pytest]\npythonpath = .\n")
    return Copy(tmp_path, Path(sys.executable))


def mutant(source: str) -> Mutant:
    return Mutant("product.py", 2, "", "", source)


def test_the_first_test_that_fails_with_the_mutant_alone_kills_it(copy: Copy) -> None:
    tests = [f"tests/test_it.py::test_{name}" for name in ("one", "four")]
    assert copy.killer(mutant(MODULE.replace("> 1", "> 4")), tests) == tests[1]
    assert copy.killer(mutant(MODULE.replace("> 1", "> 2")), tests) == ""
    assert (copy.root / "product.py").read_text() == MODULE


def test_a_test_that_fails_without_the_mutant_kills_none(copy: Copy) -> None:
    assert copy.killer(mutant(MODULE.replace("> 1", "> 4")), ["tests/test_it.py::test_always_fails"]) == ""


def test_the_seed_decides(tmp_path: Path) -> None:
    (tmp_path / "one.py").write_text("".join(f"x{number} = a and b\n" for number in range(20)))
    first = chosen(tmp_path, 5, 1, ["one.py"])
    assert first == chosen(tmp_path, 5, 1, ["one.py"]) != chosen(tmp_path, 5, 2, ["one.py"])
    assert len({each.line for each in first}) == 5


def test_modules_of_the_product_are_changed():
    files = ["executor/a.py", "tests/a.py", "executor/a.txt", "backend/x/migrations/0001.py"]
    assert sources_of(files) == ["executor/a.py"]


def test_a_line_that_runs_with_its_module_has_the_tests_of_the_module():
    seen = {
        ("product.py", 1): frozenset({"a"}),
        ("product.py", 2): frozenset(),
        ("other.py", 1): frozenset("b"),
    }
    assert candidates(mutant(""), seen) == {"a"}
    assert candidates(mutant("")._replace(line=3), seen) == set()


def test_cheap_tests_run_first():
    table = Table(tests={"tests/b.py::test_x[1]": Duration((5.0,), 5.0)})
    assert ordered(["tests/b.py::test_x", "tests/c.py::test_y"], table)[0] == "tests/c.py::test_y"


def test_the_summary_counts_what_make_test_kills():
    class Some:
        @staticmethod
        def runs(test: str, path: str | None) -> bool:
            return test == "cheap" or path is not None

    results = [Result("a.py", 1, "", "", 1, killer) for killer in ("cheap", "dear", "")]
    text = summary([*results, Result("a.py", 2, "", "", 0, "")], Some())
    assert "2 of 4 killed (50%); 1 are in lines" in text
    assert "kills 100% as a change, and 50%" in text
