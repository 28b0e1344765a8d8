"""Logs of BehaviorTree.CPP's SqliteLogger."""

from __future__ import annotations

import sqlite3

import pytest

from executor.recorder.outside.btsqlite import MOST_SESSIONS
from executor.recorder.outside.errors import OutsideError
from tests.executor.recorder.outside.logs import CHANGES, SAMPLES, XML, btlog, btsqlite, converted, results
from tests.executor.recorder.outside.test_btlog import real_trace, results_of


def test_the_log_of_real_runs_equals_their_trace(tmp_path):
    said = converted(SAMPLES / "patrol.db3", tmp_path)
    database = sqlite3.connect(f"file:{SAMPLES / 'patrol.db3'}?mode=ro&immutable=1", uri=True)
    first = database.execute("SELECT COUNT(*) FROM Transitions WHERE session_id = 1").fetchone()[0]
    trace = real_trace()
    assert results(said, 1) == results_of(trace[:first])
    assert results(said, 2) == results_of(trace[first:])


def test_it_says_the_same_as_the_other_logger(tmp_path):
    both = converted(btlog(), tmp_path), converted(btsqlite(tmp_path / "f.db3"), tmp_path)
    assert results(both[0]) == results(both[1])


def test_sessions_follow_each_other_a_second_apart(tmp_path):
    said = converted(btsqlite(tmp_path / "f.btdb", [CHANGES, CHANGES]), tmp_path)
    trees = [each for each in said if each.topic == "/bt/tree"]
    assert [(each.fields["generation"], each.t_ns) for each in trees] == [(1, 0), (2, 1_004_902_000)]
    assert results(said, 1) == results(said, 2)


def test_too_many_sessions_are_refused(tmp_path):
    path = btsqlite(tmp_path / "f.db3", [()] * (MOST_SESSIONS + 1))
    with pytest.raises(OutsideError, match=f"f.db3:{MOST_SESSIONS + 1}: it has too many sessions"):
        converted(path, tmp_path)


def test_extra_data_are_lines(tmp_path):
    said = converted(btsqlite(tmp_path / "f.db3"), tmp_path)
    assert [each.fields["text"] for each in said if each.topic == "/bt/log"] == ["a line"]


@pytest.mark.parametrize(
    ("sql", "code", "text"),
    [
        ("UPDATE Transitions SET state = 'x' WHERE node_uid = 5", "damaged", "not made of whole numbers"),
        ("UPDATE Transitions SET session_id = 9", "damaged", "session 9, which has no tree"),
        ("UPDATE Transitions SET node_uid = 70000", "damaged", "node 70000 is not in the tree"),
        ("UPDATE Transitions SET state = -1", "damaged", "no status -1"),
        ("UPDATE Definitions SET xml_tree = '<root'", "damaged", "not XML"),
        ("UPDATE Definitions SET xml_tree = x'00'", "damaged", "no number or no tree"),
        ("DELETE FROM Definitions", "no_tree", "it has no tree"),
        ("DROP TABLE Definitions", "not_a_log", "no tables of a known kind"),
    ],
)
def test_wrong_tables_are_refused_with_their_row(sql, code, text, tmp_path):
    path = btsqlite(tmp_path / "f.db3")
    with sqlite3.connect(path) as database:
        database.execute(sql)
    with pytest.raises(OutsideError, match=text) as caught:
        converted(path, tmp_path)
    assert caught.value.code == code


def test_a_tree_without_changes_is_shown(tmp_path):
    said = converted(btsqlite(tmp_path / "f.db3", [[]]), tmp_path)
    assert [each.topic for each in said] == ["/bt/tree", "/bt/keyframe"]
    assert XML.count("_uid") == len(said[0].fields["uid"])
