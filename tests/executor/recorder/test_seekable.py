"""Recordings that can be read from several places: the state there is that of all messages before."""

from __future__ import annotations

import io
import random

from mcap.reader import make_reader

from executor.recorder.cdr import decode
from executor.recorder.moment import SEGMENT_NS, Moment
from executor.recorder.seekable import LEAST_BYTES, SeekableWriter
from executor.recorder.writer import CHUNK_BYTES
from tests.executor.recorder.messages import MESSAGES

TICK_NS = 50_000_000
TREE = MESSAGES["Tree"]
UIDS = TREE["uid"]


def recorded(seconds: int, text: str) -> list[tuple[str, int, dict]]:
    """Records random ticks, writes and lines of the console; returns all messages of the file."""
    file, chance = io.BytesIO(), random.Random(seconds)  # noqa: S311 - the same run each time
    writer = SeekableWriter(file, {})
    writer.record("/bt/tree", "Tree", {**TREE, "stamp": 0})
    for number in range(1, seconds * 20):
        stamp = number * TICK_NS
        changed = {chance.choice(UIDS): chance.randrange(5) for _ in range(2)}
        tick = {"number": number, "changed_uid": list(changed), "changed_status": bytes(changed.values())}
        writer.record("/bt/tick", "Tick", {**MESSAGES["Tick"], **tick, "stamp": stamp})
        entry = {"scope": [""], "key": ["n"], "type": ["int"], "value_json": [str(number)]}
        board = {**MESSAGES["Blackboard"], **entry, "removed": [False], "writer_uid": [1]}
        writer.record("/bt/blackboard", "Blackboard", {**board, "tick": number, "stamp": stamp})
        writer.record("/bt/log", "Log", {**MESSAGES["Log"], "text": text, "stamp": stamp})
    writer.finish()
    read = make_reader(io.BytesIO(file.getvalue()))
    chunks = read.get_summary().chunk_indexes
    trees = [channel.id for channel in read.get_summary().channels.values() if channel.topic == "/bt/tree"]
    begins = [chunk for chunk in chunks if trees[0] in chunk.message_index_offsets]
    messages = [
        (schema.name.rpartition("/")[2], message.log_time, decode(schema.name, message.data))
        for schema, _, message in read.iter_messages(log_time_order=False)
    ]
    assert len(begins) == sum(name == "Tree" for name, _, _ in messages)
    return messages


def test_the_state_is_written_again_as_all_messages_before_give_it():
    messages = recorded(90, "x" * (2 * CHUNK_BYTES // 20))
    state, heads = Moment(), []
    for at, (name, t_ns, fields) in enumerate(messages):
        if name == "Tree" and at:
            heads.append(t_ns)
            assert fields == {**TREE, "stamp": t_ns}
            assert messages[at + 1] == ("Keyframe", t_ns, state.keyframe(t_ns, 0, b""))
        state.take(name, fields)
    assert [round(t_ns / SEGMENT_NS, 1) for t_ns in heads] == [1.0, 2.0, 3.0, 4.0]


def test_a_short_recording_has_its_state_once():
    messages = recorded(90, "")
    assert sum(len(str(each)) for each in messages) < 4 * LEAST_BYTES
    assert [name for name, _, _ in messages].count("Tree") == 1
