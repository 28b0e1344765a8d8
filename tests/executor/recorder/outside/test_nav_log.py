"""Messages of Nav2 and of ROS's log."""

from __future__ import annotations

import contextlib
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executor.recorder.cdr import CdrError
from executor.recorder.outside.nav_log import NodeChange, changes_of, line_of
from tests.executor.recorder.outside.logs import nav_message

CHANGES = [("root", 1, 0, 1), ("folgt Pfad é", 7, 1, 2), ("x", 65535, 2, 0)]


def test_both_forms_of_a_change_are_read():
    assert changes_of(nav_message(CHANGES)) == [NodeChange(name, uid, to) for name, uid, _, to in CHANGES]
    without = changes_of(nav_message(CHANGES, with_number=False))
    assert without == [NodeChange(name, 0, to) for name, _, _, to in CHANGES]
    assert changes_of(nav_message([])) == []


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\7\7\7\7",
        nav_message(CHANGES)[:-9],
        nav_message(CHANGES) + bytes(9),
        b"\0\1\0\0" + struct.pack("<iII", 0, 0, 2**32 - 1),
        nav_message(CHANGES).replace(b"RUNNING", b"WALKING"),
    ],
)
def test_what_is_no_log_is_refused(data):
    with pytest.raises(CdrError):
        changes_of(data)


@given(st.binary(max_size=200))
def test_any_bytes_are_read_or_refused(data):
    for read in (changes_of, line_of):
        with contextlib.suppress(CdrError):
            read(b"\0\1\0\0" + data)


def test_a_line_of_the_log_is_read():
    data = (
        b"\0\1\0\0"
        + struct.pack("<iIB3xI", 1, 2, 30, 5)
        + b"nav2\0"
        + bytes(3)
        + struct.pack("<I", 5)
        + b"slow\0"
    )
    assert line_of(data) == ("warning", "nav2: slow")
