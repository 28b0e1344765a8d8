"""The framing of the language server protocol."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.language.protocol.framing import MAX_BODY_BYTES, FramingError, Unframer, framed


@given(st.lists(st.binary(max_size=40), max_size=6), st.integers(1, 30))
def test_bodies_come_out_as_they_went_in_however_the_stream_is_cut(bodies, size):
    stream = b"".join(map(framed, bodies))
    unframer = Unframer()
    found = []
    for at in range(0, len(stream), size):
        found += unframer.feed(stream[at : at + size])
    assert found == bodies


@pytest.mark.parametrize(
    "stream",
    [
        b"Hello: there\r\n\r\n",
        b"Content-Length: -1\r\n\r\n",
        b"Content-Length: many\r\n\r\n",
        b"Content-Length: %d\r\n\r\n" % (MAX_BODY_BYTES + 1),
        b"x" * 5000,
    ],
)
def test_what_is_no_stream_of_messages_is_refused(stream):
    with pytest.raises(FramingError):
        Unframer().feed(stream)
