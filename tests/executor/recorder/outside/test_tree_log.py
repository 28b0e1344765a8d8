"""Times and messages of a converted log."""

from __future__ import annotations

import io

import pytest

from executor.recorder.outside.errors import OutsideError
from executor.recorder.outside.tree_log import MOST_BACK_NS, TimeLine, TreeLog
from executor.recorder.outside.tree_xml import flat_tree
from executor.recorder.writer import RecordingWriter
from tests.executor.recorder.outside.logs import read


def test_times_begin_at_0_and_never_decrease():
    times = TimeLine("f")
    assert [times.at(t, 0) for t in (100, 300, 200, 400)] == [0, 200, 200, 300]
    times.join(50)
    assert times.at(5, 0) == 350


def test_times_that_run_far_back_are_refused():
    times = TimeLine("f")
    times.at(0, 0)
    times.at(MOST_BACK_NS * 5, 1)
    with pytest.raises(OutsideError, match="f:2: the time runs back by 5 s"):
        times.at(0, 2)


def test_every_five_seconds_the_whole_state_is_written():
    file = io.BytesIO()
    writer = RecordingWriter(file, {})
    log = TreeLog(writer, "f")
    log.tree(0, flat_tree({1: "root"}))
    for second in range(12):
        log.change(second * 10**9, 1, second % 2, 0)
    log.end_step()
    writer.finish()
    frames = [each for each in read(file.getvalue()) if each.topic == "/bt/keyframe"]
    assert [(each.t_ns, each.fields["status"]) for each in frames] == [
        (0, b"\0"),
        (5 * 10**9, b"\1"),
        (10 * 10**9, b"\0"),
    ]


def test_long_lines_are_cut():
    file = io.BytesIO()
    writer = RecordingWriter(file, {})
    TreeLog(writer, "f").line(0, "ros", "info", "x" * 10_000)
    writer.finish()
    assert len(read(file.getvalue())[0].fields["text"]) == 4096
