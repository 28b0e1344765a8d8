"""The shards of a full run together have each file once, and write the tables when all came to their ends."""

from __future__ import annotations

import json
import struct

import pytest

from tests.tools.measuring.executed import Lane, path_hash
from tests.tools.measuring.results import Measured
from tests.tools.selection import shards
from tests.tools.selection.shards import Shard, ShardError, collect, merged, share, store
from tests.tools.selection.table import (
    ROOT,
    Duration,
    Table,
    read,
    read_executed,
    read_loaded,
    write_executed,
)
from tests.tools.selection.units import Kind, module_of

FILES = [f"tests/test_{letter}.py" for letter in "abcdefgh"]
TREE = dict.fromkeys([*FILES, "tests/conftest.py", "translator/tree.py", "docs/a.md"], "1")


@pytest.fixture
def tables(tmp_path, monkeypatch):
    monkeypatch.setattr(shards, "FOLDER", tmp_path / "full")
    monkeypatch.setattr(shards, "core_patterns", lambda: {"all": FILES})
    monkeypatch.setattr(shards, "write", lambda table: _write(table, tmp_path))
    monkeypatch.setattr(shards, "write_loaded", lambda loaded: _write_loaded(loaded, tmp_path))
    monkeypatch.setattr(shards, "write_executed", lambda ran: write_executed(ran, tmp_path / "executed.json"))
    return tmp_path


def _write(table, folder):
    from tests.tools.selection.table import write

    write(table, folder / "durations.json")


def _write_loaded(loaded, folder):
    from tests.tools.selection.table import write_loaded

    write_loaded(loaded, folder / "loaded.json")


def found(*files: str, seconds: float = 2.0, **more) -> Measured:
    tests = {f"{file}::test_x": seconds for file in files}
    return Measured(processor_s=tests, wall_s=dict.fromkeys(tests, 3.0), **more)


@pytest.mark.parametrize("text", ["", "0/8", "9/8", "3", "3/8/1", "-1/8", "a/b"])
def test_a_shard_that_there_is_not_is_refused(text):
    with pytest.raises(ShardError, match="expected a part such as 3/8"):
        Shard.parse(text)


def test_each_file_is_in_one_shard_and_the_longest_are_apart():
    table = Table(files={FILES[0]: 100.0, FILES[1]: 90.0, FILES[2]: 80.0})
    parts = [share(table, TREE, Shard(number, 3)) for number in (1, 2, 3)]
    assert sorted(file for part in parts for file in part) == FILES
    assert [sum(file in FILES[:3] for file in part) for part in parts] == [1, 1, 1]


def test_the_tables_are_written_when_all_shards_are_there(tables, capsys):
    loaded = {FILES[0]: {"translator/tree.py", "docs/a.md"}}
    assert store(found(FILES[0]), {"page": 5.0}, Table(), TREE, Shard(1, 2), is_complete=True) == 0
    assert not (tables / "durations.json").exists()
    assert "missing ['2-of-2']" in capsys.readouterr().out
    assert store(found(FILES[1]), {"page": 6.0}, Table(), TREE, Shard(2, 2), is_complete=True) == 0
    table = read(tables / "durations.json")
    assert set(table.inputs) == {FILES[0], FILES[1]}
    assert table.lanes == {"page": 11.0}
    assert table.tests[f"{FILES[0]}::test_x"] == Duration((2.0,), 3.0)
    first = table.inputs[FILES[0]]
    store(found(FILES[0], loaded=loaded), {}, Table(), TREE, Shard(1, 2), is_complete=True)
    assert read_loaded(tables / "loaded.json") == {FILES[0]: frozenset({"translator/tree.py"})}
    assert read(tables / "durations.json").inputs[FILES[0]] != first


def test_what_the_dear_tests_ran_is_written_with_names_where_imports_do_not_stand_for_it(tables, tmp_path):
    """The lane is of a worker that ran a function of the tests' folder, and loaded nothing."""
    path, test = "tests/deadline.py", f"{FILES[0]}::test_x"
    line = next(
        unit.lines[0] for unit in module_of((ROOT / path).read_bytes()).units if unit.kind is Kind.BODY
    )
    records = [(1, 1 << 28, 1, 1), (path_hash(path), line, 2, 1), (path_hash(path), 0, 2, 1)]
    content = b"".join(struct.pack("<4I", *each) for each in [(1, len(records), 9, 1), *records])
    measured = found(*FILES[:2])
    measured.lanes = {7: Lane(content, {path_hash(path): path})}
    measured.lines = {7: [{"test": test, "epochs": [2], "fixtures": []}]}
    store(measured, {}, Table(), {**TREE, path: "1"}, Shard(1, 1), is_complete=True)
    executed = read_executed(tables / "executed.json")
    assert set(executed) == {FILES[0]}
    assert executed[FILES[0]].modules == {path}
    assert [place[0] for place in executed[FILES[0]].functions] == [path]


def test_a_file_with_a_failure_has_no_digest(tables):
    measured = found(*FILES[:2], failed={f"{FILES[0]}::test_x"})
    store(measured, {}, Table(), TREE, Shard(1, 1), is_complete=True)
    assert set(read(tables / "durations.json").inputs) == {FILES[1]}
    assert set(read(tables / "durations.json").files) == set(FILES[:2])


def test_one_shard_that_did_not_end_writes_nothing(tables, capsys):
    store(found(FILES[0]), {}, Table(), TREE, Shard(1, 2), is_complete=False)
    store(found(FILES[1]), {}, Table(), TREE, Shard(2, 2), is_complete=True)
    assert not (tables / "durations.json").exists()
    assert "not run to the end ['1-of-2']" in capsys.readouterr().out


def test_a_read_that_no_rule_knows_fails_the_run_by_name(tables, capsys):
    read_by_pytest = {FILES[0]: {"docs/a.md"}}
    result = store(found(FILES[0], read=read_by_pytest), {}, Table(), TREE, Shard(1, 1), is_complete=True)
    assert result == 1
    assert f"{FILES[0]} reads docs/a.md" in capsys.readouterr().out


def test_a_source_that_is_read_as_a_text_is_no_gap_of_the_rules(tables):
    path = "translator/tree.py"
    measured = found(FILES[0], read={FILES[0]: {path}}, texts={FILES[0]: {path}})
    assert store(measured, {}, Table(), TREE, Shard(1, 1), is_complete=True) == 0
    assert read_loaded(tables / "loaded.json") == {FILES[0]: frozenset({path})}


def test_a_long_test_without_a_line_fails_the_run_by_name(tables, capsys):
    known = Table(tests={f"{FILES[1]}::test_x": Duration((9.0,), 9.0)}, inputs={FILES[1]: "1"})
    measured = found(FILES[0], FILES[1], seconds=9.0)
    assert store(measured, {}, known, TREE, Shard(1, 1), is_complete=True) == 1
    assert f"{FILES[0]}::test_x has no line in durations.json" in capsys.readouterr().out


def test_a_small_core_fails_the_run(tables, monkeypatch, capsys):
    monkeypatch.setattr(shards, "core_patterns", lambda: {"all": FILES[:1]})
    measured = found(*FILES)
    measured.processor_s |= {f"{file}::test_cheap[{number}]": 0.9 for file in FILES for number in range(9)}
    measured.wall_s |= dict.fromkeys(measured.processor_s, 1.0)
    assert store(measured, {}, Table(), TREE, Shard(1, 1), is_complete=True) == 1
    assert "the core is 3% of the time of an unchanged tree, expected 25%" in capsys.readouterr().out


def test_shards_of_other_machines_are_brought_together(tables, tmp_path):
    for number in (1, 2):
        store(found(FILES[number]), {}, Table(), TREE, Shard(number, 2), is_complete=True)
    (tables / "durations.json").unlink()
    elsewhere = tmp_path / "artifacts"
    (tables / "full").rename(elsewhere)
    assert collect([elsewhere], TREE) == 0
    assert set(read(tables / "durations.json").files) == {FILES[1], FILES[2]}
    with pytest.raises(ShardError, match="no results of this tree"):
        collect([elsewhere], {**TREE, "docs/a.md": "2"})


def test_the_last_three_runs_are_kept_and_tests_that_are_gone_are_not():
    table = Table(tests={"a.py::x": Duration((1.0, 2.0, 3.0), 1.0), "a.py::gone": Duration((9.0,), 9.0)})
    new = merged(table, {"a.py::x": 4.0, "a.py::cheap": 0.1}, {"a.py::x": 5.0, "a.py::cheap": 0.1})
    assert new.tests == {"a.py::x": Duration((2.0, 3.0, 4.0), 5.0)}
    assert new.files == {"a.py": 4.1}


def test_results_are_json_that_another_machine_reads(tables):
    store(found(FILES[0]), {"lint": 1.0}, Table(), TREE, Shard(1, 2), is_complete=True)
    (path,) = (tables / "full").rglob("1-of-2.json")
    assert json.loads(path.read_text())["processor_s"] == {f"{FILES[0]}::test_x": 2.0}
