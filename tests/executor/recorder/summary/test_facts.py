"""The facts of a run as a whole, read from its recording."""

from __future__ import annotations

import io
from pathlib import Path

import pytest

from executor.recorder.reader import RecordingError
from executor.recorder.summary.facts import facts_of
from executor.recorder.writer import RecordingWriter
from tests.executor.recorder.messages import MESSAGES

SAMPLE = Path(__file__).parents[1] / "samples" / "v1.mcap"
TREE = MESSAGES["Tree"] | {"generation": 1}


def recording(*messages):
    out = io.BytesIO()
    writer = RecordingWriter(out, {})
    for name, fields in messages:
        writer.record(f"/bt/{name.lower()}", name, fields)
    writer.finish()
    return io.BytesIO(out.getvalue())


def tick(number, changed=(), flashed=()):
    return "Tick", MESSAGES["Tick"] | {
        "stamp": number * 10**9,
        "generation": 1,
        "number": number,
        "changed_uid": [uid for uid, _ in changed],
        "changed_status": bytes(status for _, status in changed),
        "flashed_uid": [uid for uid, _ in flashed],
        "flashed_status": bytes(status for _, status in flashed),
    }


def test_a_recording_of_a_robot_has_times_a_picture_a_trail_and_a_tree():
    with SAMPLE.open("rb") as file:
        facts = facts_of(file, "v1")
    assert (facts.messages, facts.from_ns, facts.to_ns, facts.ticks) == (325, 0, 10**9, 21)
    assert facts.result == "running"
    assert facts.picture.startswith(b"\xff\xd8\xff")
    assert len(facts.trail) == 31
    assert len(facts.boxes) == 8
    assert facts.rows[:2] == [[0, 1], [1, 2]]


@pytest.mark.parametrize(
    ("ticks", "result"),
    [
        ([], "running"),
        ([tick(1, [(1, 1)])], "running"),
        ([tick(1, [(1, 1)]), tick(2, [(1, 2)])], "success"),
        ([tick(1, [(1, 1)]), tick(2, [(1, 0)], [(1, 3)])], "failure"),
        ([tick(1, [(1, 0)], [(1, 3)]), tick(2, [(1, 1)])], "running"),
        ([tick(1, [(2, 3)])], "running"),
        ([tick(1, [(1, 2)]), ("Fault", MESSAGES["Fault"])], "error"),
    ],
)
def test_the_result_is_the_last_one_of_the_root_or_a_fault(ticks, result):
    assert facts_of(recording(("Tree", TREE), *ticks), "f").result == result


def test_a_tree_that_is_repeated_in_a_segment_keeps_its_statuses_and_another_one_does_not():
    same = recording(("Tree", TREE), tick(1, [(1, 1), (2, 3)]), ("Tree", TREE))
    assert facts_of(same, "f").rows == [[0, 1], [1, 3]]
    other = recording(("Tree", TREE), tick(1, [(2, 3)]), ("Tree", TREE | {"generation": 2}))
    assert facts_of(other, "f").rows == [[0, 0], [1, 0]]


def test_messages_that_are_not_of_their_type_are_passed_over():
    out = io.BytesIO()
    writer = RecordingWriter(out, {})
    writer.write("/bt/tick", "bt_studio_msgs/msg/Tick", 5, b"\0\1\0\0no tick")
    writer.record("/world/scene", "Scene", MESSAGES["Scene"])
    writer.finish()
    facts = facts_of(io.BytesIO(out.getvalue()), "f")
    assert (facts.messages, facts.ticks, facts.boxes) == (2, 0, [])


def test_the_tree_of_a_log_is_found_and_one_that_is_cut_is_said():
    out = io.BytesIO()
    writer = RecordingWriter(out, {})
    writer.attach("tree_1.xml", "application/xml", b"<root/>")
    writer.record("/bt/tree", "Tree", TREE)
    writer.finish()
    assert facts_of(io.BytesIO(out.getvalue()), "f").xml == b"<root/>"
    whole = SAMPLE.read_bytes()
    assert facts_of(io.BytesIO(whole[: len(whole) // 2]), "f").is_cut


def test_what_is_no_recording_is_an_error():
    with pytest.raises(RecordingError, match="f:0: it does not begin"):
        facts_of(io.BytesIO(b"no recording"), "f")
