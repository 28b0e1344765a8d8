"""Recordings that were cut off."""

from __future__ import annotations

import io

import pytest
from mcap.reader import make_reader
from mcap.records import Attachment, Message

from executor.recorder.reader import RecordingError, RecordReader
from executor.recorder.recover import join, recover
from executor.recorder.writer import RecordingWriter, nanoseconds
from tests.executor.recorder.messages import MESSAGES
from tests.executor.recorder.test_writer import written

LOG = MESSAGES["Log"]


def texts(file):
    return [message.log_time for _, _, message in make_reader(io.BytesIO(file.getvalue())).iter_messages()]


def flushed(seconds):
    """Returns a recording without its end, and where each of its flushes ended."""
    file = io.BytesIO()
    writer, ends = RecordingWriter(file, {"project": "P"}), []
    for second in range(seconds):
        for part in range(10):
            writer.record("/bt/log", "Log", LOG | {"stamp": nanoseconds(second + part / 10)})
        writer.flush()
        ends.append(file.tell())
    return file.getvalue(), ends


def test_a_file_cut_anywhere_gives_all_seconds_that_were_flushed():
    data, ends = flushed(4)
    for length in range(ends[0] - 3, len(data) + 1, 7):
        out = io.BytesIO()
        found = recover(io.BytesIO(data[:length]), "f.mcap", out)
        seconds = sum(end <= length for end in ends)
        # The index of a chunk follows it, so the last chunk may be whole before its flush ended.
        assert found.messages in {10 * seconds, 10 * seconds + 10}, length
        assert found.messages == len(texts(out))
        assert found.was_cut


def test_a_whole_file_loses_nothing():
    file, out = io.BytesIO(), io.BytesIO()
    written(file)
    file.seek(0)
    found = recover(file, "f.mcap", out)
    assert (found.messages, found.was_cut, found.lost_bytes) == (len(MESSAGES), False, 0)
    reader = make_reader(io.BytesIO(out.getvalue()))
    assert {one.name for one in reader.iter_metadata()} == {"bt-studio", "extra"}
    assert [one.data for one in reader.iter_attachments()] == [b"{}"]


def test_the_bytes_of_a_half_chunk_are_counted_as_lost():
    data, ends = flushed(2)
    found = recover(io.BytesIO(data[: ends[0] + 50]), "f.mcap", io.BytesIO())
    assert found.lost_bytes <= 50
    assert found.end_ns == nanoseconds(0.9)


def test_segments_are_joined_with_their_channels_once():
    parts = []
    for start in (0, 20):
        file = io.BytesIO()
        writer = RecordingWriter(file, {"project": "P"})
        if start:
            writer.record("/bt/tick", "Tick", MESSAGES["Tick"] | {"stamp": nanoseconds(start)})
        writer.record("/bt/log", "Log", LOG | {"stamp": nanoseconds(start)})
        writer.finish()
        parts.append((io.BytesIO(file.getvalue()), f"{start}.mcap"))
    out = io.BytesIO()
    assert join(parts, out) == 3
    summary = make_reader(io.BytesIO(out.getvalue())).get_summary()
    assert sorted(channel.topic for channel in summary.channels.values()) == ["/bt/log", "/bt/tick"]
    assert summary.statistics.metadata_count == 1
    assert texts(out) == [0, nanoseconds(20), nanoseconds(20)]


def test_the_sequence_rises_over_all_segments_of_one_time():
    """A recorder that was replaced while time stood begins another segment at the same time."""
    parts = []
    for number in range(3):
        file = io.BytesIO()
        writer = RecordingWriter(file, {})
        for text in "ab":
            writer.record("/bt/log", "Log", LOG | {"stamp": nanoseconds(5), "text": f"{number}{text}"})
        writer.finish()
        parts.append((io.BytesIO(file.getvalue()), f"{number}.mcap"))
    out = io.BytesIO()
    join(parts, out)
    found = [message for _, _, message in make_reader(io.BytesIO(out.getvalue())).iter_messages()]
    assert [(message.log_time, message.sequence) for message in found] == [
        (nanoseconds(5), number) for number in range(1, 7)
    ]


def test_what_is_no_recording_is_refused():
    with pytest.raises(RecordingError, match=r"x\.mcap:0"):
        recover(io.BytesIO(b"{}"), "x.mcap", io.BytesIO())


def test_a_joined_file_has_each_version_of_an_attached_file_once_in_order():
    parts = []
    for number, text in enumerate((b"a", b"a", b"b", b"a")):
        file = io.BytesIO()
        writer = RecordingWriter(file, {})
        writer.attach("project/trees/Main.json", "application/json", text)
        writer.record("/bt/log", "Log", LOG | {"stamp": nanoseconds(number)})
        writer.finish()
        parts.append((io.BytesIO(file.getvalue()), f"{number}.mcap"))
    out = io.BytesIO()
    join(parts, out)
    out.seek(0)
    found = [
        record.data if isinstance(record, Attachment) else record.log_time // 10**9
        for record in RecordReader(out, "joined")
        if isinstance(record, Attachment | Message)
    ]
    assert found == [b"a", 0, 1, b"b", 2, b"a", 3]
    attached = sorted(
        make_reader(io.BytesIO(out.getvalue())).iter_attachments(), key=lambda one: one.log_time
    )
    assert [one.data for one in attached] == [b"a", b"b", b"a"]
