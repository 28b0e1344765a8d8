"""Segments on disk: budgets, thinned pictures, and what a killed recorder leaves."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest
from mcap.reader import make_reader

from executor.recorder.run_writer import RunWriter
from executor.recorder.shelf import (
    MOST_PARTS_BYTES,
    PICTURE,
    Budgets,
    Segment,
    Shelf,
    file_of,
    files_of,
    parts_of,
)

SECOND = 1_000_000_000
BUDGETS = Budgets()


def filled(
    folder, seconds: int, *, picture: int = 0, pictures_hz: int = 10, budgets: Budgets | None = BUDGETS
):
    """Writes a run with a line each second, and pictures."""
    said: list[Segment] = []
    shelf = Shelf(folder, said.append, budgets)
    writer = RunWriter(shelf, "a1", {}, {})
    for step in range(seconds * pictures_hz):
        t_ns = step * SECOND // pictures_hz
        if picture:
            writer.write("/camera/compressed", PICTURE, t_ns, random.Random(step).randbytes(picture))  # noqa: S311
        if step % pictures_hz == 0:
            fields = {"stamp": t_ns, "source": "s", "level": "info", "text": str(step), "uid": 0}
            writer.record("/bt/log", "Log", fields)
    writer.end()
    return shelf, said


def counts(shelf: Shelf, segment: Segment) -> dict[str, int]:
    found: dict[str, int] = {}
    with file_of(shelf.folder, segment).open("rb") as file:
        for _, channel, _ in make_reader(file).iter_messages():
            found[channel.topic] = found.get(channel.topic, 0) + 1
    return found


def test_pictures_older_than_a_minute_are_thinned_to_two_in_a_second(tmp_path):
    shelf, said = filled(tmp_path, 120, picture=400)
    first, last = shelf.segments[0], shelf.segments[-1]
    assert (first.version, first.is_thinned, last.version) == (1, True, 0)
    assert counts(shelf, first) == {"/camera/compressed": 40, "/bt/log": 20}
    assert counts(shelf, last) == {"/camera/compressed": 200, "/bt/log": 20}
    assert any(s.number == 0 and s.version == 1 for s in said)
    assert [path.name for path in files_of(tmp_path, "a1")][:1] == ["00000.1.mcap"]


def test_the_oldest_pictures_go_first_and_nothing_else_with_them(tmp_path):
    shelf, _ = filled(tmp_path, 60, picture=400, budgets=Budgets(pictures=100_000))
    assert [segment.picture_bytes > 0 for segment in shelf.segments] == [False, False, True]
    assert [counts(shelf, segment)["/bt/log"] for segment in shelf.segments] == [20, 20, 20]


def test_the_oldest_segments_go_when_the_budget_is_used_up(tmp_path):
    shelf, said = filled(tmp_path, 200, budgets=Budgets(others=12_000))
    assert sum(segment.bytes for segment in shelf.segments) <= 12_000
    gone = [s.number for s in said if s.bytes == 0]
    assert gone == list(range(shelf.segments[0].number))
    assert len(gone) > 0
    assert len(files_of(tmp_path, "a1")) == len(shelf.segments)


def test_without_budgets_nothing_is_thinned_or_dropped(tmp_path):
    shelf, said = filled(tmp_path, 120, picture=400, budgets=None)
    assert [segment.version for segment in shelf.segments] == [0] * 6
    assert sum(counts(shelf, segment)["/camera/compressed"] for segment in shelf.segments) == 1200
    assert all(segment.bytes for segment in said)


@pytest.mark.parametrize("missing", [1, 60, 800])
def test_a_killed_recorders_files_are_taken_over(tmp_path, missing):
    shelf, _ = filled(tmp_path, 45, picture=400)
    cut = file_of(tmp_path, shelf.segments[-1])
    cut.write_bytes(cut.read_bytes()[:-missing])
    said: list[Segment] = []
    after = Shelf(tmp_path, said.append)
    after.recover()
    assert [(s.number, s.version, s.is_complete) for s in said] == [(0, 0, True), (1, 0, True), (2, 1, True)]
    assert [(s.from_ns, s.to_ns) for s in said] == [(s.from_ns, s.to_ns) for s in shelf.segments]
    assert after.next_number("a1") == 3
    assert counts(after, said[-1])["/bt/log"] == 5
    assert said[0].picture_bytes == shelf.segments[0].picture_bytes


def test_a_file_that_is_no_recording_is_left_out(tmp_path):
    (tmp_path / "a1").mkdir()
    (tmp_path / "a1" / "00000.0.mcap").write_bytes(b"nothing")
    shelf = Shelf(tmp_path, lambda _: None)
    shelf.recover()
    assert shelf.segments == []


def test_a_damaged_segment_is_dropped_and_not_rewritten(tmp_path):
    shelf, said = filled(tmp_path, 15, picture=400)
    [segment] = shelf.segments
    path = file_of(tmp_path, segment)
    path.write_bytes(b"nothing" + path.read_bytes())
    shelf.add(replace(segment, run="b2", number=9, picture_bytes=0))
    assert segment not in shelf.segments
    assert any(s.run == "a1" and s.bytes == 0 for s in said)


def test_reads_are_bounded(tmp_path):
    shelf, _ = filled(tmp_path, 15, picture=400)
    [segment] = shelf.segments
    whole = file_of(tmp_path, segment).read_bytes()
    assert shelf.read(segment, 0, 10**9) == whole[: 1 << 20]
    assert shelf.read(segment, 10, 5) == whole[10:15]
    assert shelf.read(segment, len(whole) + 5, 5) == b""


def test_names_of_runs_are_not_paths(tmp_path):
    assert files_of(tmp_path, "../etc") == []
    assert files_of(tmp_path, "") == []


def test_meshes_are_kept_once_and_go_with_the_last_segment_of_their_run(tmp_path):
    shelf, _ = filled(tmp_path, 25, budgets=Budgets(others=1))
    assert shelf.keep_parts("b2", {"aa": b"mesh", "bb": b"other"})
    assert shelf.keep_parts("b2", {"aa": b"mesh"})
    assert parts_of(tmp_path, "b2") == {"aa": b"mesh", "bb": b"other"}
    assert not shelf.keep_parts("b2", {"cc": bytes(MOST_PARTS_BYTES)})
    assert shelf.keep_parts("a1", {"dd": b"mesh"})
    other = RunWriter(shelf, "b2", {}, {})
    for t_s in (0, 21, 42):
        other.write("/a", "std_msgs/msg/String", t_s * SECOND, b"\0\1\0\0\2\0\0\0a\0")
    other.end()
    assert not (tmp_path / "a1").exists()
    assert parts_of(tmp_path, "b2") == {"aa": b"mesh", "bb": b"other"}


def test_meshes_that_another_recorder_left_are_counted(tmp_path):
    shelf, _ = filled(tmp_path, 25)
    assert shelf.keep_parts("a1", {"aa": bytes(MOST_PARTS_BYTES - 10)})
    second = Shelf(tmp_path, lambda _: None)
    second.recover()
    assert second.keep_parts("a1", {"aa": bytes(MOST_PARTS_BYTES - 10), "bb": b"small"})
    assert not second.keep_parts("a1", {"cc": bytes(20)})
