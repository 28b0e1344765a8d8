"""MCAP files from outside, chunk by chunk."""

from __future__ import annotations

import pytest
from mcap.data_stream import RecordBuilder
from mcap.records import Channel, Message, Schema

from executor.recorder.outside.errors import OutsideError
from executor.recorder.outside.limits import Counter
from executor.recorder.outside.mcap_file import McapFile
from executor.recorder.reader import MAGIC
from tests.executor.recorder.outside.logs import bag

KEPT = frozenset({"std_msgs/msg/Bool", "std_msgs/msg/Int8"})
ROWS = [(f"/t{n % 2}", "std_msgs/msg/Bool", n, bytes([n]) * 30) for n in range(10)]


def opened(data, tmp_path, **counts):
    path = tmp_path / "f.mcap"
    path.write_bytes(data)
    return McapFile(path, KEPT, Counter("f.mcap", **counts))


@pytest.mark.parametrize("options", [{"chunk_size": 100}, {"use_chunking": False}, {}])
def test_each_place_gives_its_messages_again(options, tmp_path):
    other = [("/other", "std_msgs/msg/Byte", 3, b"")]
    file = opened(bag([*ROWS[:5], *other, *ROWS[5:]], **options), tmp_path)
    sents = list(file.messages())
    assert [(s.topic, s.kind, s.t_ns, s.data) for s in sents] == ROWS
    assert file.has_one_meaning
    places = dict.fromkeys(sent.place for sent in sents)
    for place in reversed(places):
        assert file.chunk(place) == [sent for sent in sents if sent.place == place]
    assert list(file.messages()) == sents


def test_a_channel_that_changes_its_meaning_is_noticed(tmp_path):
    builder = RecordBuilder()
    Schema(id=1, name="std_msgs/msg/Int8", encoding="ros2msg", data=b"").write(builder)
    for topic in ("/a", "/b"):
        Channel(id=1, topic=topic, message_encoding="cdr", metadata={}, schema_id=1).write(builder)
        Message(channel_id=1, log_time=1, publish_time=1, sequence=0, data=b"").write(builder)
    file = opened(MAGIC + builder.end(), tmp_path)
    assert [sent.topic for sent in file.messages()] == ["/a", "/b"]
    assert not file.has_one_meaning


def test_a_chunk_is_no_way_round_the_limit_of_time(tmp_path):
    file = opened(bag(ROWS), tmp_path)
    place = next(iter(file.messages())).place
    late = McapFile(file.path, KEPT, Counter("f.mcap", seconds=-1))
    with pytest.raises(OutsideError, match="reading took more"):
        list(late.messages())
    with pytest.raises(OutsideError, match="reading took more"):
        late.chunk(place)
