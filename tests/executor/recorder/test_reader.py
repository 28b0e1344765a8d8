"""Records of hostile and damaged files."""

from __future__ import annotations

import io
import struct

import pytest
import zstandard
from hypothesis import given
from hypothesis import strategies as st
from mcap.data_stream import RecordBuilder
from mcap.records import Channel, Chunk, Message
from mcap.writer import CompressionType, Writer

from executor.recorder.reader import MAGIC, Limits, RecordingError, RecordReader
from tests.executor.recorder.messages import MESSAGES
from tests.executor.recorder.test_writer import written


def whole():
    file = io.BytesIO()
    written(file)
    return file.getvalue()


def read(data, **limits):
    reader = RecordReader(io.BytesIO(data), "f.mcap", Limits(**limits))
    return list(reader), reader


def chunk(data, size=None, compression="", packed=None):
    builder = RecordBuilder()
    Chunk(
        compression=compression,
        data=data if packed is None else packed,
        message_start_time=0,
        message_end_time=0,
        uncompressed_crc=0,
        uncompressed_size=len(data) if size is None else size,
    ).write(builder)
    return MAGIC + builder.end()


def test_a_whole_file_is_not_cut():
    records, reader = read(whole())
    assert sum(isinstance(record, Message) for record in records) == len(MESSAGES)
    assert not reader.is_cut


def test_a_file_of_another_kind_is_refused_at_its_begin():
    with pytest.raises(RecordingError, match=r"f\.mcap:0: it does not begin as an MCAP file \(Is it"):
        read(b"PK\x03\x04")


@pytest.mark.parametrize("compression", list(CompressionType))
def test_all_packings_are_read(compression):
    file = io.BytesIO()
    writer = Writer(file, compression=compression)
    writer.start()
    channel = writer.register_channel("/x", "json", 0)
    writer.add_message(channel, 1, b"{}", 1)
    writer.finish()
    assert sum(isinstance(record, Message) for record in read(file.getvalue())[0]) == 1


def test_a_bomb_is_refused_before_it_is_unpacked():
    bomb = zstandard.compress(bytes(100 << 20))
    with pytest.raises(RecordingError, match=r"f\.mcap:8: a chunk claims 104857600 bytes"):
        read(chunk(b"", 100 << 20, "zstd", bomb))
    with pytest.raises(RecordingError, match="a chunk is not as long as it claims"):
        read(chunk(b"", 1000, "zstd", bomb))


def test_zeros_are_no_records():
    for data in (MAGIC + bytes(1000), chunk(bytes(1000))):
        with pytest.raises(RecordingError, match=r"f\.mcap:8: a record has no kind"):
            read(data)


def test_many_small_bombs_are_counted_together():
    data = struct.pack("<BQ", 0x80, (1 << 20) - 9) + bytes((1 << 20) - 9)  # a record of another writer
    one = chunk(data, compression="zstd", packed=zstandard.compress(data))
    with pytest.raises(RecordingError, match="too large unpacked"):
        read(MAGIC + one[len(MAGIC) :] * 5, total_bytes=4 << 20)


def test_a_record_that_claims_more_than_any_record_is_refused():
    with pytest.raises(RecordingError, match=r"f\.mcap:8: a record claims 1099511627776 bytes"):
        read(MAGIC + struct.pack("<BQ", 5, 1 << 40))


def test_an_unknown_packing_is_named():
    with pytest.raises(RecordingError, match="a chunk is packed by 'rar'"):
        read(chunk(b"x", compression="rar"))


def test_a_message_without_a_channel_is_refused():
    builder = RecordBuilder()
    Message(channel_id=9, sequence=0, log_time=0, publish_time=0, data=b"").write(builder)
    with pytest.raises(RecordingError, match="a message is of channel 9, which does not exist"):
        read(chunk(builder.end()))


def test_a_channel_without_its_schema_is_refused():
    builder = RecordBuilder()
    Channel(id=1, topic="/x", message_encoding="cdr", metadata={}, schema_id=4).write(builder)
    with pytest.raises(RecordingError, match="channel 1 has no schema"):
        read(chunk(builder.end()))


def test_channels_and_messages_are_bounded():
    with pytest.raises(RecordingError, match="too many schemas"):
        read(whole(), channels=3)
    with pytest.raises(RecordingError, match="too many messages"):
        read(whole(), messages=3)


def test_a_flipped_bit_is_seen_by_the_checksum():
    builder = RecordBuilder()
    Chunk(
        compression="",
        data=b"\x00" * 9,
        message_start_time=0,
        message_end_time=0,
        uncompressed_crc=7,
        uncompressed_size=9,
    ).write(builder)
    with pytest.raises(RecordingError, match="does not match its checksum"):
        read(MAGIC + builder.end())


@given(st.data())
def test_changed_bytes_are_read_or_refused_in_words(data):
    content = bytearray(WHOLE)
    for _ in range(data.draw(st.integers(1, 8))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    said = "f.mcap:"
    try:
        read(bytes(content), chunk_bytes=1 << 20)
    except RecordingError as error:
        said = str(error)
    assert said.startswith("f.mcap:")


WHOLE = whole()


def test_a_chunk_is_read_again_by_its_offset():
    file = io.BytesIO()
    writer = Writer(file, chunk_size=40)
    writer.start()
    channel = writer.register_channel("/x", "json", 0)
    for t_ns in range(6):
        writer.add_message(channel, t_ns, b"{}" * 10, t_ns)
    writer.finish()
    reader = RecordReader(io.BytesIO(file.getvalue()), "f.mcap", Limits(messages=6))
    places: dict[int, list[int]] = {}
    for record in reader:
        if isinstance(record, Message):
            places.setdefault(reader.read_to, []).append(record.log_time)
    assert len(places) > 1
    for place, times in reversed(places.items()):
        assert [r.log_time for r in reader.at(place) if isinstance(r, Message)] == times
    assert list(reader.at(len(file.getvalue()) - 2)) == []
