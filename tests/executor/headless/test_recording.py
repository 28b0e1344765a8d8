"""The file of a recorded run."""

from __future__ import annotations

import resource
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.records import Attachment

from executor.headless.errors import HeadlessError
from executor.headless.recording import Recording, check_name, open_recording
from executor.recorder.reader import RecordReader
from translator import open_files

FILES = {
    "project.json": b'{"format":"bt-studio/project","version":1,"name":"P","universe":"empty"}',
    "a.txt": b"x",
}


def test_it_holds_the_files_and_what_ran(tmp_path):
    path = tmp_path / "run.mcap"
    project = open_files(FILES)
    open_recording(path, project, universe=None, robot="rover", seed=4).close()
    with path.open("rb") as file:
        reader = make_reader(file)
        (about,) = (one.metadata for one in reader.iter_metadata())
        attached = {one.name: one.data for one in reader.iter_attachments()}
    assert (about["universe"], about["robot"], about["seed"]) == ("empty", "rover", "4")
    assert {"bt_studio", "python", "platform", "project"} <= about.keys()
    assert attached["project/a.txt"] == b"x"


def test_other_endings_are_refused_in_one_sentence(tmp_path):
    with pytest.raises(
        HeadlessError, match=r"run\.jsonl: a recording is an MCAP file, so its name ends with \.mcap\.$"
    ):
        check_name(Path("run.jsonl"))
    with pytest.raises(HeadlessError, match="cannot be written: No such file"):
        open_recording(tmp_path / "no" / "run.mcap", open_files(FILES), universe=None, robot=None, seed=0)


def test_it_is_complete_when_it_is_closed(tmp_path):
    path = tmp_path / "run.mcap"
    with Recording(path, {}, {}):
        pass
    assert path.read_bytes().endswith(b"\x89MCAP0\r\n")


def test_a_full_disk_stops_the_recording_and_its_begin_opens(tmp_path, capsys):
    path = tmp_path / "run.mcap"
    recording = Recording(path, {}, {"a": b"x"})
    recording.writer.flush()
    begin = path.stat().st_size
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (begin + 10, before[1]))
    try:
        recording.writer.attach("b", "text/plain", bytes(1000))
        recording.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert recording.is_stopped
    line = capsys.readouterr().err
    assert line.startswith(f"{path}: the recording stops here: File too large. Its begin can be read;")
    with path.open("rb") as file:
        found = [record.name for record in RecordReader(file, "run") if isinstance(record, Attachment)]
    assert found == ["a"]
