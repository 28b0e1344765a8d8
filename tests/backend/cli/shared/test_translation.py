"""Shared functions of the verbs of trees."""

from __future__ import annotations

import json

import pytest

from backend.cli.shared import translation
from backend.cli.shared.errors import CliError
from translator.diagnostic import Place, diagnostic

FOUND = diagnostic("BT0001", Place("a.json", line=1), problem="it ends")


def test_findings_end_the_work_as_text_or_json(capsys):
    assert "BT0001" in str(translation.fail([FOUND], as_json=False))
    translation.tell([FOUND])
    assert "BT0001" in capsys.readouterr().err
    translation.print_json({"a": 1})
    assert json.loads(capsys.readouterr().out) == {"a": 1}


def test_a_file_is_written_whole_or_not_at_all(tmp_path):
    translation.write_file(tmp_path / "a", b"x")
    assert (tmp_path / "a").read_bytes() == b"x"
    with pytest.raises(CliError):
        translation.write_file(tmp_path / "a" / "b", b"x")


def test_of_several_files_all_are_written_or_none(tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "old").write_bytes(b"old")
    taken = tmp_path / "mine" / "taken"
    taken.mkdir()
    files = {tmp_path / "new" / "a": b"x", tmp_path / "mine" / "old": b"y", taken: b"z"}
    with pytest.raises(CliError, match="taken:1:1: it cannot be written"):
        translation.write_files(files)
    assert not (tmp_path / "new").exists()
    assert sorted(path.name for path in (tmp_path / "mine").iterdir()) == ["old", "taken"]
    del files[taken]
    translation.write_files(files)
    assert [path.read_bytes() for path in files] == [b"x", b"y"]


def test_a_command_that_is_interrupted_leaves_nothing(tmp_path):
    class Interrupted(dict):
        def items(self):
            yield tmp_path / "new" / "a", b"x"
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        translation.write_files(Interrupted())
    assert [*tmp_path.iterdir()] == []


def test_what_is_not_there_is_said(tmp_path, stored_place):
    with pytest.raises(CliError):
        translation.open_project(str(tmp_path / "no.xml"))
