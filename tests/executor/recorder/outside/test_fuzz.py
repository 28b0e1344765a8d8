"""Hostile logs: each is converted, or refused with its place, in bounded memory; nothing in it runs."""

from __future__ import annotations

import io
import random
import sqlite3
import struct
import tracemalloc
import zlib

import pytest
from mcap.writer import CompressionType, Writer

from executor.recorder.outside.apart import convert_apart
from executor.recorder.outside.convert import convert_outside
from executor.recorder.outside.errors import OutsideError
from executor.recorder.reader import Limits, RecordingError
from executor.recorder.summary.facts import facts_of
from tests.budget import count
from tests.executor.recorder.outside.logs import (
    CHANGES,
    NAV,
    SAMPLES,
    bag,
    bag_tables,
    btlog,
    btsqlite,
    nav_message,
    read,
)

SMALL = Limits(
    chunk_bytes=1 << 20, total_bytes=4 << 20, attachment_bytes=1 << 20, channels=100, messages=5000
)
MOST_BYTES = 64 << 20
MESSAGES = [
    ("/log", NAV, t * 10**6, nav_message([("root", 1, 0, 1), ("go", 2, 1, t % 4)])) for t in range(1, 20)
]


def sources(folder):
    """Returns a sound log of each kind."""
    tables = bag_tables(folder / "bag.db3", MESSAGES).read_bytes()
    sqlite = btsqlite(folder / "bt.db3").read_bytes()
    ours = (SAMPLES.parents[1] / "samples" / "v1.mcap").read_bytes()
    real = (SAMPLES / "patrol.btlog").read_bytes()
    return [btlog(), real, sqlite, tables, bag(MESSAGES), ours]


def mutated(data, chance):
    """Returns a file with some bytes changed, removed, repeated, or numbers made huge."""
    out = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 5, 20))):
        at = chance.randrange(len(out) or 1)
        size = chance.choice((1, 2, 4, 8, 64))
        match chance.randrange(5):
            case 0:
                out[at : at + size] = chance.randbytes(size)
            case 1:
                out[at : at + size] = b"\xff" * size
            case 2:
                del out[at : at + chance.choice((1, 8, 500))]
            case 3:
                out[at:at] = out[at : at + chance.choice((16, 2000))]
            case _:
                del out[at:]
    return bytes(out)


def located(path, error):
    assert str(error).startswith(f"{path.name}:{error.offset}: ")
    assert error.hint
    return error


def outcome(path):
    """Converts a file; returns None, or the error that refused it."""
    out = io.BytesIO()
    try:
        convert_outside(path, out, SMALL)
    except RecordingError as error:
        return located(path, error)
    assert len(out.getvalue()) < MOST_BYTES
    read(out.getvalue())  # what was made of it is sound
    facts_of(io.BytesIO(out.getvalue()), "made")
    return None


def test_mutated_logs_are_converted_or_refused_with_their_place(tmp_path):
    chance = random.Random(19)  # noqa: S311 - not for secrets
    sound = sources(tmp_path)
    path = tmp_path / "f.log"
    refused = converted = 0
    tracemalloc.start()
    try:
        for number in range(count("executor_outside_fuzz")):
            path.write_bytes(mutated(sound[number % len(sound)], chance))
            tracemalloc.reset_peak()
            if outcome(path) is None:
                converted += 1
            else:
                refused += 1
            assert tracemalloc.get_traced_memory()[1] < MOST_BYTES, number
    finally:
        tracemalloc.stop()
    assert refused > 20
    assert converted > 20


def zeros(size):
    """A message that unpacks to many zeros."""
    file = io.BytesIO()
    writer = Writer(file, chunk_size=size, compression=CompressionType.ZSTD)
    writer.start(profile="ros2", library="rosbag2")
    schema = writer.register_schema(NAV, "ros2msg", b"")
    channel = writer.register_channel("/log", "cdr", schema)
    for t in range(3):
        writer.add_message(channel, t, bytes(size), t)
    writer.finish()
    return file.getvalue()


def channels(number):
    file = io.BytesIO()
    writer = Writer(file)
    writer.start(profile="ros2", library="rosbag2")
    schema = writer.register_schema(NAV, "ros2msg", b"")
    for each in range(number):
        writer.add_message(writer.register_channel(f"/{each}", "cdr", schema), each, nav_message([]), each)
    writer.finish()
    return file.getvalue()


def backwards():
    """The clock was set meanwhile."""
    return bag([("/log", NAV, t, nav_message([("a", 1, 0, 1)])) for t in (2 * 10**16, 10**9)])


def huge_head():
    return b"BTCPP4-FileLogger2" + struct.pack("<Bi", 1, 2**31 - 1) + b"<root/>"


def deep():
    return btlog(xml='<root BTCPP_format="4"><BehaviorTree ID="A">' + "<Inverter>" * 100_000)


def entities():
    lines = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 9))
    return btlog(xml=f'<!DOCTYPE root [<!ENTITY a0 "a">{lines}]><root>&a8;</root>')


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (zeros(3 << 20), "a chunk claims|too large"),
        (channels(200), "too many channels"),
        (backwards(), r"runs back by 2e\+07 s"),
        (huge_head(), "bytes|within its tree"),
        (deep(), "tree"),
        (entities(), "tree"),
        (btlog([*CHANGES, (2**47, 1, 1)]), "after the begin"),
        (zlib.compress(bytes(10**6)), "no log of a known kind"),
    ],
    ids=["bomb", "channels", "backwards", "head", "deep", "entities", "late", "packed"],
)
def test_a_file_that_was_made_to_harm_is_refused_in_little_memory(data, code, tmp_path):
    path = tmp_path / "f.log"
    path.write_bytes(data)
    tracemalloc.start()
    try:
        error = outcome(path)
        assert tracemalloc.get_traced_memory()[1] < MOST_BYTES
    finally:
        tracemalloc.stop()
    with pytest.raises(RecordingError, match=code):
        raise error


VIEW = "CREATE VIEW messages AS SELECT 1 AS topic_id, 2 AS timestamp, load_extension('/tmp/x') AS data"
BOMB = (
    "CREATE VIEW messages AS WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM n) "
    "SELECT x AS topic_id, x AS timestamp, randomblob(1000000) AS data FROM n"
)
GENERATED = (
    "CREATE TABLE messages (id INTEGER, topic_id INTEGER, timestamp INTEGER, "
    "data BLOB GENERATED ALWAYS AS (zeroblob(900000000)) VIRTUAL)"
)
TRIGGER = (
    "CREATE TRIGGER t AFTER INSERT ON messages BEGIN INSERT INTO topics VALUES (9, 'x', 'y', 'cdr', ''); END"
)
VIRTUAL = "CREATE VIRTUAL TABLE messages USING fts5(topic_id, timestamp, data)"


def hostile(path, *statements):
    """An SQLite bag in which the messages are something else."""
    bag_tables(path, MESSAGES)
    database = sqlite3.connect(path)
    for statement in statements:
        database.execute(statement)
    database.commit()
    database.close()
    return path


@pytest.mark.parametrize(
    "statements",
    [
        ("DROP TABLE messages", VIEW),
        ("DROP TABLE messages", BOMB),
        ("DROP TABLE messages", GENERATED, "INSERT INTO messages (id, topic_id, timestamp) VALUES (1, 1, 1)"),
        ("DROP TABLE messages", VIRTUAL, "INSERT INTO messages VALUES (1, 1, 'x')"),
        ("UPDATE messages SET timestamp = 'soon'",),
        ("UPDATE messages SET data = 17",),
        ("UPDATE messages SET data = zeroblob(3000000)",),
        ("DROP TABLE topics", "CREATE VIEW topics AS SELECT 1 AS id, 'a' AS name, 'b' AS type"),
    ],
    ids=["view", "recursion", "generated", "virtual", "times", "numbers", "large", "topics"],
)
def test_tables_that_are_not_what_they_seem_are_refused_by_the_child(statements, tmp_path):
    path = hostile(tmp_path / "f.db3", *statements)
    before = path.read_bytes()
    with pytest.raises(OutsideError) as caught:
        convert_apart(path, tmp_path / "f.mcap")
    assert str(caught.value).startswith("f.db3:")
    assert caught.value.hint
    assert path.read_bytes() == before
    assert sorted(file.name for file in tmp_path.iterdir()) == ["f.db3", "f.mcap"]


def test_triggers_do_not_run(tmp_path):
    path = hostile(tmp_path / "f.db3", TRIGGER)
    before = path.read_bytes()
    assert outcome(path) is None
    assert path.read_bytes() == before


def many_channels(path, number):
    """An MCAP file whose channels have the 65,535 numbers that there are again and again."""
    with path.open("wb") as file:
        writer = Writer(file, use_chunking=False)
        writer.start(profile="ros2", library="rosbag2")
        schema = writer.register_schema(NAV, "ros2msg", b"uint8 nothing_that_is_read")
        for channel in range(number):
            name = b"/log%d" % channel
            numbers = struct.pack("<HHI", 1 + channel % 65_535, schema, len(name))
            body = numbers + name + struct.pack("<I", 3) + b"cdr" + struct.pack("<I", 0)
            file.write(b"\x04" + struct.pack("<Q", len(body)) + body)
        writer.finish()


def many_topics(path, number):
    bag_tables(path, MESSAGES)
    database = sqlite3.connect(path)
    rows = ((key, f"/log{key}", NAV) for key in range(100, 100 + number))
    database.executemany("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", rows)
    database.commit()
    database.close()


def many_of(kind, sql):
    """Returns what writes an SQLite bag with so many views or triggers."""

    def write(path, number):
        bag_tables(path, MESSAGES)
        database = sqlite3.connect(path)
        database.execute("PRAGMA writable_schema = ON")
        rows = ((kind, f"a{key}", "messages", sql.format(f"a{key}")) for key in range(number))
        database.executemany("INSERT INTO sqlite_master VALUES (?, ?, ?, 0, ?)", rows)
        database.commit()
        database.close()

    return write


MANY = {
    "channels": many_channels,
    "topics": many_topics,
    "views": many_of("view", "CREATE VIEW {} AS SELECT data FROM messages"),
    "triggers": many_of(
        "trigger", "CREATE TRIGGER {} AFTER INSERT ON messages BEGIN DELETE FROM topics; END"
    ),
}


@pytest.mark.parametrize("what", MANY)
@pytest.mark.timeout(600)
def test_very_many_of_a_thing_are_refused_or_harmless(what, tmp_path):
    """The child has 256 MB and 60 s: more ends it, with an error that has a place and a hint."""
    path = tmp_path / "f.log"
    MANY[what](path, count("executor_outside_many"))
    try:
        made = convert_apart(path, tmp_path / "f.mcap")
    except OutsideError as error:
        refusal = error
    else:
        assert made.messages == len(read((tmp_path / "f.mcap").read_bytes()))
        return
    assert str(refusal).startswith("f.log")
    assert refusal.hint
    assert refusal.code in {"too_large", "too_long", "damaged"}
