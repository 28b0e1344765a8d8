"""The first line of a stream names one socket below the keeper's folder, and nothing else."""

from __future__ import annotations

from uuid import uuid4

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.sessions.relay.hello import KEEPER, WrongHelloError, read_hello, socket_of, write_hello


def test_a_line_names_the_keeper_or_a_session():
    made = str(uuid4())
    assert socket_of(read_hello(write_hello(KEEPER))) == "keeper.sock"
    assert socket_of(read_hello(write_hello(made))) == f"sessions/{made}.sock"


@given(st.binary(max_size=200))
def test_any_other_line_is_refused(line):
    with pytest.raises(WrongHelloError):
        read_hello(line)


@pytest.mark.parametrize("what", ["", "keeper\n", "../keeper", "sessions/x", "KEEPER", str(uuid4()).upper()])
def test_nothing_else_is_named(what):
    with pytest.raises(WrongHelloError):
        write_hello(what)
