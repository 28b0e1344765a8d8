"""A session in a recording."""

from __future__ import annotations

import errno
from typing import Any, cast

import msgspec
from mcap.reader import make_reader

from executor.headless.live_recorder import LiveRecorder
from executor.headless.recording import Recording
from executor.messages import Poses, Scan, View
from executor.recorder.reader import RecordReader
from tests.executor.recorder.test_events import SCAN

LINE = {"command": "log", "t": 1.0, "data": {"source": "action", "level": "info", "text": "hello"}}


def test_events_and_frames_are_written(tmp_path):
    path = tmp_path / "run.mcap"
    frames = [
        Poses(t=1.0, ids=b"", poses=b""),
        Scan(pose=[], **SCAN),
        View(t=1.0, width=1, height=1, jpeg=b""),
    ]
    with LiveRecorder(Recording(path, {}, {})) as recorder:
        recorder.event(LINE)
        for frame in frames:
            recorder.frame(frame, msgspec.msgpack.encode(frame))
    with path.open("rb") as file:
        topics = [channel.topic for _, channel, _ in make_reader(file).iter_messages()]
    assert topics == ["/bt/log", "/world/poses", "/scan"]


def test_each_second_is_on_disk_before_the_end(tmp_path):
    path, now = tmp_path / "run.mcap", [0.0]
    recorder = LiveRecorder(Recording(path, {}, {}), clock=lambda: now[0])
    counts = []
    for second in (0.0, 0.5, 1.0, 1.5):
        now[0] = second
        recorder.event(LINE)
        with path.open("rb") as file:
            counts.append(
                sum(type(record).__name__ == "Message" for record in RecordReader(file, "run.mcap"))
            )
    recorder.__exit__()
    assert counts == [1, 1, 3, 3]


def test_a_full_disk_stops_the_recording_and_not_the_run(tmp_path, capsys):
    recorder = LiveRecorder(recording := Recording(tmp_path / "run.mcap", {}, {}))

    class Full:
        def write(self, *_):
            raise OSError(errno.ENOSPC, "No space left on device")

        record = write

        def flush(self):
            raise OSError(errno.ENOSPC, "No space left on device")

    writer, recording.writer = recording.writer, cast("Any", Full())
    full = LiveRecorder(recording)
    for _ in range(3):
        full.event(LINE)
    assert capsys.readouterr().err.count("the recording stops here: No space left on device") == 1
    recording.writer = writer
    recorder.__exit__()
