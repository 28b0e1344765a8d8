"""`bt-studio convert`."""

from __future__ import annotations

import pytest
from mcap.reader import make_reader

from backend.cli.convert import convert
from backend.cli.shared.errors import CliError
from tests.executor.recorder.outside.test_lines import LINES, write
from tests.executor.recorder.test_recover import flushed


def test_an_older_recording_becomes_mcap(tmp_path, capsys):
    target = tmp_path / "new.mcap"
    convert(write(tmp_path / "old.jsonl.gz", LINES), target)
    assert capsys.readouterr().out == f"{target}: 4 messages\n"
    with target.open("rb") as file:
        assert make_reader(file).get_summary().statistics.message_count == 4


def test_a_cut_recording_is_completed(tmp_path, capsys):
    cut = tmp_path / "cut.mcap"
    data, ends = flushed(3)
    cut.write_bytes(data[: ends[1] + 30])
    convert(cut, tmp_path / "whole.mcap")
    assert "20 messages; the last 30 bytes were not whole" in capsys.readouterr().out


def test_what_cannot_be_converted_is_said_and_leaves_no_file(tmp_path):
    wrong = write(tmp_path / "old.jsonl", [{"format": "x"}])
    with pytest.raises(CliError, match=r"old\.jsonl:1: it does not begin"):
        convert(wrong, tmp_path / "new.mcap")
    with pytest.raises(CliError, match="No such file"):
        convert(tmp_path / "nothing.mcap", tmp_path / "new.mcap")
    with pytest.raises(CliError, match=r"its name ends with \.mcap"):
        convert(wrong, tmp_path / "new.bag")
    with pytest.raises(CliError, match="exists already"):
        convert(wrong, tmp_path / "taken.mcap" if (tmp_path / "taken.mcap").write_bytes(b"") == 0 else wrong)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["old.jsonl", "taken.mcap"]
