"""Which tests execute which lines, their processes included: by the contexts of coverage.py.

The main thread of a test is known by the name of its function, and a process that a test starts by
`PYTEST_CURRENT_TEST`, which it inherits. A warm process counts for the test that started it.
"""

from __future__ import annotations

import os
import re
import subprocess
from collections import defaultdict
from typing import TYPE_CHECKING, Final

from coverage import CoverageData

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from pathlib import Path

_RULES: Final = """
[run]
data_file = {folder}/data
parallel = true
relative_files = true
dynamic_context = test_function
context = ${{PYTEST_CURRENT_TEST-}}
include =
    {files}
"""
_ID: Final = re.compile(r"(tests/\S+?\.py::\S+)")
_FUNCTION: Final = re.compile(r"(tests(?:\.[a-z_0-9]+)+)\.((?:Test\w+\.)?test_\w+)$")

Executed = dict[tuple[str, int], frozenset[str]]


def executed(
    root: Path, python: Path, folder: Path, files: Iterable[str], arguments: Sequence[str]
) -> Executed:
    """Runs tests, and returns the tests that execute each line of some files.

    Args:
        root: the tree whose tests run.
        python: the Python of its environment.
        folder: where the data are kept meanwhile.
        files: paths of modules, relative to the tree.
        arguments: the tests, as pytest takes them.

    Returns:
        for each path and line the files and functions of its tests (`tests/a/test_b.py::test_c`); none for a
        line that is executed when its module is loaded.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rules = folder / "coverage.ini"
    rules.write_text(_RULES.format(folder=folder, files="\n    ".join(files)), encoding="utf-8")
    measured = [str(python), "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments]
    # Each process of this environment begins to measure itself, by the rules that this variable names.
    environment = os.environ | {"COVERAGE_PROCESS_START": str(rules), "PYTEST_CURRENT_TEST": ""}
    subprocess.run(measured, cwd=root, env=environment, check=False)
    combine = [str(python), "-m", "coverage", "combine", "-q", f"--rcfile={rules}"]
    subprocess.run(combine, cwd=root, check=True)
    data = CoverageData(str(folder / "data"))
    data.read()
    found: defaultdict[tuple[str, int], set[str]] = defaultdict(set)
    for file in data.measured_files():
        for line, contexts in data.contexts_by_lineno(file).items():
            found[file, line] |= {test for context in contexts if (test := test_of(context))}
    return {place: frozenset(tests) for place, tests in found.items()}


def test_of(context: str) -> str:
    """Returns the test of a context, without its parameters; empty where a context names none."""
    if named := _ID.search(context):
        return named[1].partition("[")[0]
    if called := _FUNCTION.search(context):
        return f"{called[1].replace('.', '/')}.py::{called[2].replace('.', '::')}"
    return ""
