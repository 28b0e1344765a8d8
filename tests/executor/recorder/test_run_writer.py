"""A run in segments: each is a complete file that begins with the whole state."""

from __future__ import annotations

import resource
from typing import Any

import msgspec
import pytest
from mcap.reader import make_reader
from mcap.records import Attachment, Message

from executor.recorder.cdr import decode
from executor.recorder.joining import join_run
from executor.recorder.moment import SEGMENT_NS
from executor.recorder.reader import RecordReader
from executor.recorder.run_writer import MOST_CHANNELS, RunWriter
from executor.recorder.shelf import PICTURE, Segment, Shelf, file_of, parts_of

SECOND = 1_000_000_000


def writer_in(folder, **files: bytes) -> tuple[RunWriter, Shelf, list[Segment]]:
    said: list[Segment] = []
    shelf = Shelf(folder, said.append)
    return RunWriter(shelf, "a1", {"universe": "u"}, files), shelf, said


def log(second: float, text: str = "x") -> tuple[str, str, dict[str, Any]]:
    fields = {"stamp": round(second * SECOND), "source": "s", "level": "info", "text": text, "uid": 0}
    return "/bt/log", "Log", fields


def scene(second: float) -> tuple[str, str, dict[str, Any]]:
    return "/world/scene", "Scene", {"stamp": round(second * SECOND), "data": b"scene"}


def topics_of(path) -> list[tuple[str, int]]:
    with path.open("rb") as file:
        return [
            (channel.topic, message.log_time) for _, channel, message in make_reader(file).iter_messages()
        ]


def test_after_20_s_another_segment_begins_with_the_state(tmp_path):
    writer, shelf, said = writer_in(tmp_path, **{"project/a.py": b"code"})
    writer.record(*scene(0))
    for second in (0, 10, 19.9, 20, 25):
        writer.record(*log(second))
    writer.end()
    assert [(s.number, s.from_ns, s.to_ns, s.is_complete) for s in said] == [
        (0, 0, round(19.9 * SECOND), True),
        (1, SEGMENT_NS, 25 * SECOND, True),
    ]
    second_file = file_of(tmp_path, shelf.segments[1])
    assert topics_of(second_file) == [
        ("/world/scene", SEGMENT_NS),
        ("/bt/log", SEGMENT_NS),
        ("/bt/log", 25 * SECOND),
    ]
    assert second_file.stat().st_size == said[1].bytes
    with second_file.open("rb") as file:
        attached = [r.name for r in RecordReader(file, "x") if isinstance(r, Attachment)]
    assert attached == ["project/a.py"]


def test_a_flush_tells_how_far_the_open_segment_can_be_read(tmp_path):
    writer, shelf, said = writer_in(tmp_path)
    writer.flush()  # nothing is open
    writer.record(*log(1))
    writer.flush()
    writer.flush()  # nothing new
    [told] = said
    assert (told.is_complete, told.to_ns, told.bytes) == (False, SECOND, writer.open_segment.bytes)
    part = shelf.read(writer.open_segment, 0, 1 << 20)
    path = tmp_path / "part.mcap"
    path.write_bytes(part)
    with path.open("rb") as file:
        reader = RecordReader(file, "x")
        assert sum(isinstance(record, Message) for record in reader) == 1
    assert reader.is_cut
    writer.end()


def test_changed_files_are_attached_before_the_next_tree_and_in_the_next_segment(tmp_path):
    files = {"project/a.py": b"code", "project/trees/Main.json": b"old", "universe.yaml": b"name: u"}
    writer, shelf, _ = writer_in(tmp_path, **files)
    writer.record(*log(1))
    writer.change_files({"project/a.py": b"code", "project/trees/Main.json": b"new"})
    for second in (2, 25):
        writer.record(*log(second))
    writer.end()
    found: list[bytes | int] = []
    for segment in shelf.segments:
        with file_of(tmp_path, segment).open("rb") as file:
            for record in RecordReader(file, "x"):
                if isinstance(record, Attachment) and record.name != "project/a.py":
                    found.append(record.data)
                elif isinstance(record, Message):
                    found.append(round(record.log_time / SECOND))
    assert found == [b"old", b"name: u", 1, b"new", 2, b"new", b"name: u", 25]


def test_time_never_runs_back_and_wild_times_are_refused(tmp_path):
    writer, shelf, _ = writer_in(tmp_path)
    writer.record(*log(5))
    writer.record(*log(4))
    for wild in (-1, 10**17):
        with pytest.raises(ValueError, match="not a time"):
            writer.write("/x", PICTURE, wild, b"")
    writer.end()
    assert [t for _, t in topics_of(file_of(tmp_path, shelf.segments[0]))] == [5 * SECOND, 5 * SECOND]


def test_the_topics_of_a_run_are_bounded(tmp_path):
    writer, _, _ = writer_in(tmp_path)
    for number in range(MOST_CHANNELS):
        writer.write(f"/t{number}", PICTURE, 0, b"1234")
    with pytest.raises(ValueError, match="topics"):
        writer.write("/one/more", PICTURE, 0, b"")
    assert writer.open_segment.picture_bytes == 4 * MOST_CHANNELS
    writer.end()


def test_what_was_flushed_can_be_read_after_an_error_of_the_disk(tmp_path):
    writer, shelf, _ = writer_in(tmp_path)
    writer.record(*log(1))
    writer.flush()
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (writer.open_segment.bytes, before[1]))
    try:
        writer.record(*log(2))
        with pytest.raises(OSError, match="too large"):
            writer.flush()
        writer.abandon()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    [kept] = shelf.segments
    assert len(shelf.read(kept, 0, 1 << 20)) == kept.bytes > 0


def test_a_disk_that_is_full_from_the_begin_leaves_nothing(tmp_path):
    writer, shelf, _ = writer_in(tmp_path)
    path = file_of(tmp_path, writer.open_segment)
    path.parent.mkdir()
    path.symlink_to("/dev/full")
    with pytest.raises(OSError, match="No space"):
        writer.record(*log(1))
    writer.abandon()
    assert shelf.segments == []


def test_a_scene_is_written_without_its_meshes_which_the_joined_file_has_once(tmp_path):
    mesh = {"positions": b"0", "normals": b"1", "indices": b"2"}
    frame = msgspec.msgpack.encode({"type": "scene", "meshes": {"m": mesh}})
    shelf = Shelf(tmp_path, lambda _: None)
    writer = RunWriter(shelf, "a1", {}, {})
    writer.record("/world/scene", "Scene", {"stamp": 0, "data": frame})
    for second in (25, 50):
        writer.record(*log(second))
    writer.end()
    ((digest, part),) = parts_of(tmp_path, "a1").items()
    assert msgspec.msgpack.decode(part) == mesh
    assert join_run(tmp_path, "a1", tmp_path / "all.mcap") == 5
    with (tmp_path / "all.mcap").open("rb") as file:
        reader = make_reader(file)
        (attached,) = reader.iter_attachments()
        scenes = [decode(s.name, m.data) for s, _, m in reader.iter_messages(topics=["/world/scene"]) if s]
    assert (attached.name, attached.data) == (f"scene/{digest}", part)
    assert [msgspec.msgpack.decode(s["data"])["meshes"] for s in scenes] == [{"m": {"hash": digest}}] * 3
