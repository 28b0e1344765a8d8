"""Logs for tests: real ones of BehaviorTree.CPP 4.10 and small ones; and what a recording of them says."""

from __future__ import annotations

import io
import sqlite3
import struct
from pathlib import Path
from typing import Any, NamedTuple

from mcap.reader import make_reader
from mcap.writer import Writer

from executor.recorder.cdr import decode
from executor.recorder.outside.btlog import BEGIN
from executor.recorder.outside.convert import convert_outside
from executor.recorder.outside.steps import STATUS_WORDS

SAMPLES = Path(__file__).with_name("samples")
XML = """<root BTCPP_format="4"><BehaviorTree ID="Main" _fullpath=""><Sequence name="all" _uid="1">
<Act name="go" _uid="2" speed="1"/>
<SubTree ID="Sub" _fullpath="sub" _uid="3"/></Sequence></BehaviorTree>
<BehaviorTree ID="Sub" _fullpath="sub">
<Inverter name="Inverter" _uid="4"><Way name="way" _uid="5"/></Inverter></BehaviorTree>
<TreeNodesModel><Action ID="Act"/><Condition ID="Way"/><Control ID="Sequence"/>
<Decorator ID="Inverter"/></TreeNodesModel></root>"""
CHANGES = [(100, 1, 1), (101, 2, 2), (102, 3, 1), (5000, 5, 3), (5001, 5, 0), (5002, 3, 2)]


class Said(NamedTuple):
    """A message of a recording."""

    topic: str
    t_ns: int
    fields: dict[str, Any]


def btlog(changes: Any = CHANGES, xml: str = XML, version: int = 1) -> bytes:
    """Returns a FileLogger2 file with changes of (µs, node, status)."""
    coded = xml.encode()
    head = BEGIN + struct.pack("<Bi", version, len(coded)) + coded + struct.pack("<q", 1_700_000_000_000_000)
    return head + b"".join(t.to_bytes(6, "little") + struct.pack("<HB", uid, to) for t, uid, to in changes)


def btsqlite(path: Path, sessions: Any = (CHANGES,), xml: str = XML) -> Path:
    """Writes a SqliteLogger file with the changes of each session."""
    database = sqlite3.connect(path)
    database.executescript(
        "CREATE TABLE Transitions (timestamp INTEGER PRIMARY KEY NOT NULL, session_id INTEGER NOT NULL, "
        "node_uid INTEGER NOT NULL, duration INTEGER, state INTEGER NOT NULL, extra_data VARCHAR);"
        "CREATE TABLE Nodes (session_id INTEGER NOT NULL, fullpath VARCHAR, node_uid INTEGER NOT NULL);"
        "CREATE TABLE Definitions (session_id INTEGER PRIMARY KEY AUTOINCREMENT, date TEXT NOT NULL, "
        "xml_tree TEXT NOT NULL);"
    )
    for session, changes in enumerate(sessions, 1):
        database.execute("INSERT INTO Definitions VALUES (?, 'today', ?)", (session, xml))
        for t, uid, to in changes:
            extra = "a line" if to == 3 else ""
            row = (session * 10**9 + t, session, uid, 0, to, extra)
            database.execute("INSERT INTO Transitions VALUES (?, ?, ?, ?, ?, ?)", row)
    database.commit()
    database.close()
    return path


def nav_message(changes: Any, *, with_number: bool = True) -> bytes:
    """Returns a `BehaviorTreeLog` with changes of (name, node, from, to)."""
    data = bytearray(struct.pack("<iII", 5, 6, len(changes)))

    def text(value: str) -> None:
        data.extend(
            bytes(-len(data) % 4) + struct.pack("<I", len(value.encode()) + 1) + value.encode() + b"\0"
        )

    for name, uid, before, to in changes:
        data.extend(bytes(-len(data) % 4) + struct.pack("<iI", 5, 6))
        text(name)
        if with_number:
            data.extend(bytes(-len(data) % 2) + struct.pack("<H", uid))
        text(STATUS_WORDS[before])
        text(STATUS_WORDS[to])
    return b"\0\1\0\0" + bytes(data)


NAV = "nav2_msgs/msg/BehaviorTreeLog"


def bag(messages: Any, **options: Any) -> bytes:
    """Returns an MCAP file with messages of (topic, type, time in ns, bytes)."""
    file = io.BytesIO()
    writer = Writer(file, **options)
    writer.start(profile="ros2", library="rosbag2")
    channels: dict[Any, int] = {}
    for topic, kind, t_ns, data in messages:
        if (topic, kind) not in channels:
            schema = writer.register_schema(kind, "ros2msg", b"uint8 nothing_that_is_read")
            channels[topic, kind] = writer.register_channel(topic, "cdr", schema)
        writer.add_message(channels[topic, kind], t_ns, data, t_ns)
    writer.finish()
    return file.getvalue()


def bag_tables(path: Path, messages: Any) -> Path:
    """Writes an SQLite bag with the same messages."""
    database = sqlite3.connect(path)
    database.executescript(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
        "CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
    )
    topics: dict[Any, int] = {}
    for topic, kind, t_ns, data in messages:
        number = topics.setdefault((topic, kind), len(topics) + 1)
        database.execute(
            "INSERT INTO messages (topic_id, timestamp, data) VALUES (?,?,?)", (number, t_ns, data)
        )
    for (topic, kind), number in topics.items():
        database.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", (number, topic, kind))
    database.commit()
    database.close()
    return path


def read(data: bytes) -> list[Said]:
    """Returns the messages of a recording; fields of our types only."""
    found = []
    for schema, channel, message in make_reader(io.BytesIO(data)).iter_messages():
        is_ours = schema is not None and schema.name.startswith("bt_studio_msgs/")
        fields = decode(schema.name, message.data) if schema is not None and is_ours else {}
        found.append(Said(channel.topic, message.log_time, fields))
    return found


def converted(source: Path | bytes, folder: Path, name: str = "f.log") -> list[Said]:
    """Converts a file, or its bytes, and returns what the recording says."""
    if isinstance(source, bytes):
        (folder / name).write_bytes(source)
        source = folder / name
    out = io.BytesIO()
    convert_outside(source, out)
    return read(out.getvalue())


def results(said: list[Said], generation: int = 1) -> dict[int, list[int]]:
    """Returns for each node of a tree what it returned, in order, without RUNNING."""
    found: dict[int, list[int]] = {}
    for topic, _, tick in said:
        if topic != "/bt/tick" or tick["generation"] != generation:
            continue
        for kind in ("flashed", "changed"):
            for uid, status in zip(tick[f"{kind}_uid"], tick[f"{kind}_status"], strict=True):
                if status > 1:
                    found.setdefault(uid, []).append(status)
    return found
