"""The table of durations is read whole or refused in one sentence."""

from __future__ import annotations

import json

import pytest

from tests.tools.selection.table import (
    Duration,
    Executed,
    Table,
    TableError,
    read,
    read_executed,
    read_loaded,
    write,
    write_executed,
    write_loaded,
)

TABLE = Table(
    tests={
        "tests/test_a.py::test_x": Duration((0.5, 3.0, 1.2), 9.0),
        "tests/test_a.py::test_y[a\nb]": Duration((0.9,), 1.0),
    },
    files={"tests/test_a.py": 4.5},
    lanes={"page": 200.0},
    inputs={"tests/test_a.py": "0123"},
)


def test_what_is_written_is_read_and_each_test_has_a_line(tmp_path):
    path = tmp_path / "durations.json"
    write(TABLE, path)
    assert read(path) == TABLE
    lines = path.read_text().splitlines()
    assert sum("test_a.py::" in line for line in lines) == 2
    assert sorted(lines[2:4]) == lines[2:4]


def test_dear_is_what_needs_more_than_a_second_in_the_median_of_its_runs():
    assert TABLE.dear() == {"tests/test_a.py::test_x": 1.2}


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        '{"tests": {}, "files": {}',
        '{"tests": {}, "files": {}, "lanes": {}}',
        '{"tests": {"a": [1.0]}, "files": {}, "lanes": {}, "inputs": {}}',
        '{"tests": {"a": ["x", 1]}, "files": {}, "lanes": {}, "inputs": {}}',
    ],
)
def test_half_a_table_is_refused_with_its_name(tmp_path, content):
    path = tmp_path / "durations.json"
    path.write_text(content)
    with pytest.raises(TableError, match=r"durations\.json is not a whole table"):
        read(path)


def test_a_table_that_is_missing_is_refused_with_who_writes_it(tmp_path):
    for reader in (read, read_loaded):
        with pytest.raises(TableError, match="make test-full"):
            reader(tmp_path / "durations.json")


def test_modules_of_processes_are_stored_as_ranges(tmp_path):
    path = tmp_path / "loaded.json"
    loaded = {
        "tests/test_a.py": frozenset({"a.py", "b.py", "c.py", "e.py"}),
        "tests/test_b.py": frozenset({"d.py"}),
    }
    write_loaded(loaded, path)
    assert read_loaded(path) == loaded
    assert json.loads(path.read_text())["files"] == {"tests/test_a.py": "0-2 4", "tests/test_b.py": "3"}


def test_ranges_of_paths_that_there_are_not_are_refused(tmp_path):
    path = tmp_path / "loaded.json"
    path.write_text('{"paths": ["a.py"], "files": {"tests/test_a.py": "0-3"}}')
    with pytest.raises(TableError, match=r"loaded\.json is not a whole table"):
        read_loaded(path)


def test_functions_are_stored_with_a_line_a_module(tmp_path):
    path = tmp_path / "executed.json"
    executed = {
        "tests/test_a.py": Executed(
            frozenset({("a.py", "f"), ("a.py", "C.m"), ("b.py", "g")}),
            frozenset({"a.py"}),
            frozenset({"c.py"}),
        ),
        "tests/test_b.py": Executed(frozenset({("b.py", "g")})),
    }
    assert read_executed(path) == {}  # until a full run has written it
    write_executed(executed, path)
    assert read_executed(path) == executed
    assert '"a.py": "* C.m f"' in path.read_text()
    path.write_text('{"modules": {}, "files": {"tests/test_a.py": "0"}}')
    with pytest.raises(TableError, match=r"executed\.json is not a whole table"):
        read_executed(path)
