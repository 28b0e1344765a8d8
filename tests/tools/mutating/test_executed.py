"""The tests that execute a line are found, also where a process of theirs does."""

from __future__ import annotations

import sys
from pathlib import Path

from tests.tools.mutating.executed import executed, test_of

MODULE = """
def here():
    return 1

def there():
    return 2

if __name__ == "__main__":
    there()
"""
TESTS = """
import subprocess, sys
import pytest
from product import here

@pytest.mark.parametrize("number", [1, 2])
def test_here(number):
    here()

def test_there():
    subprocess.run([sys.executable, "product.py"], check=True)
"""


def test_lines_of_a_test_and_of_its_process(tmp_path: Path) -> None:
    root = tmp_path / "root"
    (root / "tests").mkdir(parents=True)
    (root / "product.py").write_text(MODULE)
    (root / "tests" / "__init__.py").write_text("")
    (root / "tests" / "test_it.py").write_text(TESTS)
    (root / "pytest.ini").write_text("[pytest]\npythonpath = .\n")
    seen = executed(root, Path(sys.executable), tmp_path / "data", ["product.py"], ["tests"])
    assert seen["product.py", 3] == {"tests/test_it.py::test_here"}
    assert seen["product.py", 6] == {"tests/test_it.py::test_there"}
    assert ("product.py", 4) not in seen


def test_contexts_name_tests():
    assert test_of("tests/a/test_b.py::test_c[1-2] (call)|") == "tests/a/test_b.py::test_c"
    assert test_of("tests.a.test_b.test_c") == "tests/a/test_b.py::test_c"
    assert test_of("tests.a.test_b.TestIt.test_c") == "tests/a/test_b.py::TestIt::test_c"
    assert test_of("") == ""


test_of.__test__ = False  # type: ignore[attr-defined]  # it is no test, but its name begins so
