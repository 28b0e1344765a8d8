"""Logs of BehaviorTree.CPP's FileLogger2."""

from __future__ import annotations

import struct

import pytest

from executor.recorder.outside.btlog import BEGIN
from executor.recorder.outside.errors import OutsideError
from tests.executor.recorder.outside.logs import CHANGES, SAMPLES, btlog, converted, results


def real_trace():
    """Returns what an observer of its own in two real runs saw: (node, status)."""
    lines = (SAMPLES / "patrol.trace").read_text().splitlines()
    return [tuple(map(int, line.split())) for line in lines]


def results_of(trace):
    found: dict[int, list[int]] = {}
    for uid, status in trace:
        if status > 1:
            found.setdefault(uid, []).append(status)
    return found


def test_the_log_of_a_real_run_equals_its_trace(tmp_path):
    _, _, changes = (SAMPLES / "patrol.btlog").read_bytes().rpartition(b"</root>\n")
    trace = real_trace()[-((len(changes) - 8) // 9) :]  # of the second run, as the logger got it
    said = converted(SAMPLES / "patrol.btlog", tmp_path)
    assert results(said) == results_of(trace)
    (tree,) = [each.fields for each in said if each.topic == "/bt/tree"]
    assert tree["name"][:4] == ["patrol", "free?", "way is free", "turn"]
    assert "go there/go" in tree["path"]
    assert (tree["kind"][0], tree["type"][0]) == ("Control", "ReactiveSequence")


def test_a_tree_and_its_ticks_are_read(tmp_path):
    said = converted(btlog(), tmp_path)
    assert [each.topic for each in said] == ["/bt/tree", "/bt/keyframe", "/bt/tick", "/bt/tick"]
    tree, _, first, second = (each.fields for each in said)
    assert tree["path"] == ["all", "go", "sub", "sub/Inverter::4", "sub/way"]
    assert tree["kind"] == ["Control", "Action", "SubTree", "Decorator", "Condition"]
    assert (tree["parent"], tree["tree_id"][-1], tree["ports_json"][1]) == (
        [0, 1, 1, 3, 4],
        "Sub",
        '{"speed":"1"}',
    )
    assert (first["changed_uid"], first["changed_status"]) == ([1, 2, 3], b"\1\2\1")
    assert (second["flashed_uid"], second["flashed_status"]) == ([5], b"\3")
    assert [each.t_ns for each in said] == [0, 0, 100_000, 5_000_000]


def test_a_last_change_that_was_cut_off_is_left_out(tmp_path):
    assert converted(btlog()[:-4], tmp_path) == converted(btlog(CHANGES[:-1]), tmp_path)


@pytest.mark.parametrize(
    ("data", "code", "place", "text"),
    [
        (BEGIN, "damaged", 0, "ends within its head"),
        (btlog(version=9), "not_a_log", 18, "version 9"),
        (BEGIN + struct.pack("<Bi", 1, 2**31 - 1), "too_large", 19, "claims 2147483647 bytes"),
        (BEGIN + struct.pack("<Bi", 1, -1), "too_large", 19, "claims -1 bytes"),
        (btlog()[:200], "damaged", 23, "ends within its tree"),
        (btlog(xml="<root"), "damaged", 23, "not XML"),
        (btlog(xml="<!DOCTYPE r [<!ENTITY a 'b'>]><root>&a;</root>"), "damaged", 23, "DTD"),
        (btlog(xml="<root/>"), "damaged", 23, "no tree"),
        (btlog([(0, 77, 1)]), "damaged", len(btlog([])), "node 77 is not in the tree"),
        (btlog([(0, 1, 9)]), "damaged", len(btlog([])), "no status 9"),
        (btlog([(5_000_000, 1, 1), (1, 1, 0)]), "times_run_back", len(btlog([])) + 9, "runs back by 5 s"),
        (btlog([(0, 1, 1), (2**48 - 1, 1, 0)]), "damaged", len(btlog([])) + 9, "after the begin"),
    ],
)
def test_a_hostile_file_is_refused_with_its_place(data, code, place, text, tmp_path):
    with pytest.raises(OutsideError, match=text) as caught:
        converted(data, tmp_path)
    assert (caught.value.code, caught.value.offset) == (code, place)
    assert caught.value.hint
