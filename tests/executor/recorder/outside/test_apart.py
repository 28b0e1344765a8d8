"""Conversion in a child with limits."""

from __future__ import annotations

import sqlite3

import pytest

from executor.recorder.outside.apart import convert_apart, main, outcome
from executor.recorder.outside.convert import Converted
from executor.recorder.outside.errors import OutsideError
from tests.executor.recorder.outside.logs import SAMPLES, btlog, read


def test_the_child_writes_the_recording(tmp_path):
    made = convert_apart(SAMPLES / "patrol.btlog", tmp_path / "f.mcap")
    assert made.messages == len(read((tmp_path / "f.mcap").read_bytes())) > 40


def test_an_error_arrives_with_its_code_and_place(tmp_path):
    (tmp_path / "f").write_bytes(btlog([(0, 77, 1)]))
    with pytest.raises(OutsideError, match=r"mine\.btlog:.*node 77") as caught:
        convert_apart(tmp_path / "f", tmp_path / "f.mcap", "mine.btlog")
    assert caught.value.code == "damaged"


def test_a_file_that_needs_too_much_memory_is_refused(tmp_path):
    path = tmp_path / "f.db3"
    database = sqlite3.connect(path)
    database.execute("CREATE TABLE Definitions (session_id, xml_tree)")
    database.execute("CREATE TABLE Transitions (timestamp, session_id, node_uid, state, extra_data)")
    xml = (
        '<root BTCPP_format="4"><BehaviorTree ID="A">'
        + "<S>"
        + "<T/>" * 1_900_000
        + "</S></BehaviorTree></root>"
    )
    database.execute("INSERT INTO Definitions VALUES (1, ?)", (xml,))
    database.commit()
    database.close()
    with pytest.raises(OutsideError, match=r"too many|needs more than 256 MB") as caught:
        convert_apart(path, tmp_path / "f.mcap")
    assert caught.value.hint


def test_a_child_that_ends_without_a_word_is_an_error():
    assert outcome("f", 0, b'{"messages": 3, "lost_bytes": 1}') == Converted(3, 1)
    with pytest.raises(OutsideError, match="needs more than 256 MB"):
        outcome("f", 1, b"")
    with pytest.raises(OutsideError, match="took more than 60 s"):
        outcome("f", -24, b"")


def test_it_is_the_child_that_reads(tmp_path):
    assert callable(main)
    with pytest.raises(OutsideError, match="No such file"):
        convert_apart(tmp_path / "nothing", tmp_path / "f.mcap")
