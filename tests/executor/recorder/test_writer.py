"""Recordings, read back by two independent readers."""

from __future__ import annotations

import io
from typing import Any

from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from executor.recorder.cdr import decode
from executor.recorder.definitions import OURS
from executor.recorder.writer import CHUNK_BYTES, FORMAT_VERSION, RecordingWriter, nanoseconds
from tests.executor.recorder.messages import MESSAGES, T_NS

ABOUT = {"project": "P", "seed": "1"}


def written(file):
    writer = RecordingWriter(file, ABOUT)
    for name, fields in MESSAGES.items():
        writer.record(f"/bt/{name.lower()}", name, fields)
    writer.attach("trees/Main.json", "application/json", b"{}")
    writer.describe("extra", {"revision": "7"})
    writer.finish()
    return writer


def test_the_reader_of_mcap_finds_everything():
    file = io.BytesIO()
    written(file)
    reader = make_reader(io.BytesIO(file.getvalue()))
    assert reader.get_header().profile == "ros2"
    found = {}
    for schema, channel, message in reader.iter_messages():
        assert (schema.encoding, channel.message_encoding) == ("ros2msg", "cdr")
        assert message.log_time == T_NS
        found[channel.topic] = decode(schema.name, message.data)
    assert found == {f"/bt/{name.lower()}": fields for name, fields in MESSAGES.items()}
    about = {one.name: one.metadata for one in reader.iter_metadata()}
    assert about == {
        "bt-studio": {"format_version": str(FORMAT_VERSION), **ABOUT},
        "extra": {"revision": "7"},
    }
    assert [(one.name, one.data) for one in reader.iter_attachments()] == [("trees/Main.json", b"{}")]


def test_rosbags_reads_each_topic_with_no_package_installed(tmp_path):
    path = tmp_path / "run.mcap"
    with path.open("wb") as file:
        written(file)
    with AnyReader([path]) as reader:
        read: dict[str, Any] = {
            connection.topic: reader.deserialize(data, connection.msgtype)
            for connection, _, data in reader.messages()
        }
    assert set(read) == {f"/bt/{name.lower()}" for name in MESSAGES}
    assert read["/bt/log"].text == "The way is free"
    assert read["/bt/tick"].changed_uid.tolist() == [1, 2]
    assert read["/bt/blackboard"].value_json == ["3", '"x"']
    assert read["/bt/tree"].__msgtype__ == f"{OURS}/msg/Tree"


def test_log_time_never_decreases_and_the_sequence_rises():
    file = io.BytesIO()
    writer = RecordingWriter(file, {})
    for t_s in (1.0, 0.5, 1.0, 2.0):
        writer.record("/bt/log", "Log", MESSAGES["Log"] | {"stamp": nanoseconds(t_s)})
    writer.finish()
    messages = [message for _, _, message in make_reader(io.BytesIO(file.getvalue())).iter_messages()]
    assert [message.log_time for message in messages] == [10**9, 10**9, 10**9, 2 * 10**9]
    assert [message.sequence for message in messages] == [1, 2, 3, 4]
    assert (writer.last_ns, writer.messages) == (2 * 10**9, 4)


def test_chunks_have_256_kib_and_are_packed_by_zstd():
    file = io.BytesIO()
    writer = RecordingWriter(file, {})
    size = 10_000
    for number in range(100):
        writer.write("/x", "std_msgs/msg/String", number, bytes(size))
    writer.finish()
    summary = make_reader(io.BytesIO(file.getvalue())).get_summary()
    chunks = summary.chunk_indexes
    assert {chunk.compression for chunk in chunks} == {"zstd"}
    assert len(chunks) == -(-100 * size // CHUNK_BYTES)
    assert all(CHUNK_BYTES <= chunk.uncompressed_size < CHUNK_BYTES + 2 * size for chunk in chunks[:-1])


def test_negative_time_is_the_begin():
    assert nanoseconds(-1.0) == 0
    assert nanoseconds(0.1) == 100_000_000
