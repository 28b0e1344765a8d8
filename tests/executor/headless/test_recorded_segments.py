"""The recording of a run in real time, from segments to one file."""

from __future__ import annotations

import pytest
from mcap.reader import make_reader

from executor.headless.errors import HeadlessError
from executor.headless.recorded_segments import recorded_segments
from executor.recorder.shelf import file_of
from tests.executor.recorder.test_shelf import filled


def times(path):
    with path.open("rb") as file:
        return [message.log_time for _, _, message in make_reader(file).iter_messages()]


def test_the_segments_become_one_file_that_replaces_an_older_one(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_bytes(b"old")
    with recorded_segments(path) as folder:
        filled(folder, 45)
    assert len(times(path)) == 45
    assert list(tmp_path.iterdir()) == [path]


def test_a_run_that_fails_is_kept_too_and_one_that_never_began_leaves_nothing(tmp_path):
    path = tmp_path / "run.mcap"

    def fails():
        with recorded_segments(path) as folder:
            filled(folder, 5)
            raise HeadlessError("it fails")

    with pytest.raises(HeadlessError, match="it fails"):
        fails()
    assert len(times(path)) == 5
    path.unlink()
    with recorded_segments(path):
        pass
    assert list(tmp_path.iterdir()) == []


def test_what_a_killed_run_left_is_not_overwritten(tmp_path):
    folder = tmp_path / "run.mcap.parts"
    folder.mkdir()
    filled(folder, 5)
    with (
        pytest.raises(
            HeadlessError, match=r"what a killed run recorded\. Complete it by `bt-studio convert .*parts"
        ),
        recorded_segments(tmp_path / "run.mcap"),
    ):
        pass
    assert list(folder.glob("*/*.mcap"))


def test_a_place_that_cannot_be_written_and_a_wrong_name_are_refused(tmp_path):
    for path, text in (
        (tmp_path / "missing" / "run.mcap", "cannot be written: No such file or directory"),
        (tmp_path / "run.jsonl", "its name ends with .mcap"),
    ):
        with pytest.raises(HeadlessError, match=text), recorded_segments(path):
            pass


def test_segments_that_cannot_be_joined_stay_and_are_reported(tmp_path, capsys):
    path = tmp_path / "run.mcap"
    with recorded_segments(path) as folder:
        shelf, _ = filled(folder, 5)
        file_of(folder, shelf.segments[0]).write_bytes(b"no recording")
    assert "the recording stays in" in capsys.readouterr().err
    assert list(folder.glob("*/*.mcap"))
    assert not path.exists()
