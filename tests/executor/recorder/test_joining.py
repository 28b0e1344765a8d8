"""The segments of a run as one file."""

from __future__ import annotations

import os
import shutil

from mcap.reader import make_reader

from executor.recorder.joining import NOT_RECORDED, join_newest, join_run, main
from executor.recorder.shelf import file_of
from tests.executor.recorder.test_shelf import SECOND, filled


def test_a_run_is_joined_in_order(tmp_path):
    filled(tmp_path, 45)
    out = tmp_path / "all.mcap"
    assert join_run(tmp_path, "a1", out) == 45
    with out.open("rb") as file:
        times = [message.log_time for _, _, message in make_reader(file).iter_messages()]
    assert times == [second * SECOND for second in range(45)]


def test_a_run_that_was_not_recorded_and_a_damaged_one_are_said(tmp_path, capsys):
    assert main([str(tmp_path), "ff", str(tmp_path / "out")]) == NOT_RECORDED
    shelf, _ = filled(tmp_path, 15)
    path = file_of(tmp_path, shelf.segments[0])
    path.write_bytes(b"x" + path.read_bytes())
    assert main([str(tmp_path), "a1", str(tmp_path / "out")]) == 1
    assert "00000.0.mcap:0: it does not begin as an MCAP file" in capsys.readouterr().err


def test_a_file_that_the_recorder_changes_meanwhile_is_read_again(tmp_path, monkeypatch):
    shelf, _ = filled(tmp_path, 15)
    path = file_of(tmp_path, shelf.segments[0])
    whole = path.read_bytes()
    path.write_bytes(b"x" + whole)
    monkeypatch.setattr("executor.recorder.joining.time.sleep", lambda _: path.write_bytes(whole))
    assert main([str(tmp_path), "a1", str(tmp_path / "out")]) == 0


def test_the_newest_run_of_a_folder_is_joined(tmp_path):
    out = tmp_path / "out.mcap"
    folder = tmp_path / "out.mcap.parts"
    folder.mkdir()
    (folder / "a note.txt").write_text("x")
    assert join_newest(folder, out) == 0
    filled(folder, 5)
    shutil.move(folder / "a1", folder / "b2")
    filled(folder, 15)
    os.utime(folder / "b2", (1, 1))
    assert join_newest(folder, out) == 15
    os.utime(folder / "a1", (0, 0))
    assert join_newest(folder, out) == 5


def test_a_segment_that_has_only_begun_does_not_prevent_joining(tmp_path):
    filled(tmp_path, 15)
    (tmp_path / "a1" / "00099.0.mcap").touch()
    assert join_run(tmp_path, "a1", tmp_path / "out.mcap") == 15
    (tmp_path / "b2").mkdir()
    (tmp_path / "b2" / "00000.0.mcap").touch()
    assert join_run(tmp_path, "b2", tmp_path / "out.mcap") == 0
