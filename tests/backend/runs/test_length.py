"""The length of a recording, from its end."""

from __future__ import annotations

import contextlib
import io
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.writer import Writer

from backend.runs.length import MAGIC, DamagedError, length_of
from tests.backend.runs.conftest import SAMPLE


def length(data: bytes) -> tuple[float, float]:
    return length_of(lambda at, size: data[at : at + size], len(data))


def written(*times_ns: int) -> bytes:
    out = io.BytesIO()
    writer = Writer(out)
    writer.start()
    channel = writer.register_channel("/a", "json", 0)
    for time_ns in times_ns:
        writer.add_message(channel, time_ns, b"{}", time_ns)
    writer.finish()
    return out.getvalue()


def test_it_is_the_time_between_the_first_and_the_last_message():
    times = [message.log_time for _, _, message in make_reader(io.BytesIO(SAMPLE)).iter_messages()]
    assert length(SAMPLE) == pytest.approx((min(times) * 1e-9, (max(times) - min(times)) * 1e-9))
    assert length(written(2_000_000_000, 5_500_000_000)) == pytest.approx((2.0, 3.5))


@pytest.mark.parametrize(
    "data",
    [
        b"",
        MAGIC,
        MAGIC * 2,
        b"x" * 100,
        SAMPLE[:-1],
        SAMPLE[1:],
        written(),
        written(0, 10**19),
        SAMPLE[:-37] + struct.pack("<BQQQI", 2, 20, 2**63, 0, 0) + MAGIC,
        SAMPLE[:-37] + struct.pack("<BQQQI", 2, 20, len(SAMPLE) - 40, 0, 0) + MAGIC,
    ],
)
def test_what_is_no_complete_recording_is_refused(data):
    with pytest.raises(DamagedError):
        length(data)


@given(at=st.integers(0, len(SAMPLE) - 1), byte=st.integers(0, 255))
def test_a_changed_byte_gives_a_length_or_that_error(at, byte):
    with contextlib.suppress(DamagedError):
        assert min(length(SAMPLE[:at] + bytes([byte]) + SAMPLE[at + 1 :])) >= 0
