"""Bags of ROS 2: MCAP and SQLite."""

from __future__ import annotations

import io
from typing import Any

import pytest
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.records import Channel, Message, Schema
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from executor.recorder.cdr import encode
from executor.recorder.outside import bags
from executor.recorder.outside.bags import files_of_bag, is_bag
from executor.recorder.outside.convert import convert_outside
from executor.recorder.outside.errors import OutsideError
from executor.recorder.reader import MAGIC, Limits
from tests.executor.recorder.messages import MESSAGES
from tests.executor.recorder.outside.logs import NAV, bag, bag_tables, converted, nav_message, read, results

WALL_NS = 1_700_000_000 * 10**9
TICKS = [
    [("root", 1, 0, 1), ("go", 3, 0, 1)],
    [("way", 2, 0, 2), ("way", 2, 2, 0), ("go", 3, 1, 3), ("root", 1, 1, 3)],
    [("go", 3, 3, 0), ("root", 1, 3, 0)],
]
MESSAGES_OF_BAG = [
    ("/behavior_tree_log", NAV, WALL_NS + number * 10**8, nav_message(tick))
    for number, tick in enumerate(TICKS)
]


def check(said):
    tree, _, *ticks = (each.fields for each in said)
    assert (tree["name"], tree["parent"]) == (["root", "way", "go"], [0, 1, 1])
    assert [each.t_ns for each in said if each.topic == "/bt/tick"] == [0, 10**8, 2 * 10**8]
    assert results(said) == {2: [2], 3: [3], 1: [3]}
    assert ticks[-1]["changed_status"] == b"\0\0"


def test_both_storages_say_the_same(tmp_path):
    check(converted(bag(MESSAGES_OF_BAG), tmp_path))
    check(converted(bag_tables(tmp_path / "b.db3", MESSAGES_OF_BAG), tmp_path))


@pytest.mark.parametrize("storage", list(StoragePlugin))
def test_a_folder_that_another_program_wrote_is_read(storage, tmp_path):
    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(get_types_from_msg("uint8 nothing_that_is_read", NAV))
    with Writer(tmp_path / "bag", version=9, storage_plugin=storage) as writer:
        connection = writer.add_connection("/behavior_tree_log", NAV, typestore=store)
        for _, _, t_ns, data in MESSAGES_OF_BAG:
            writer.write(connection, t_ns, data)
    assert is_bag(tmp_path / "bag")
    check(converted(tmp_path / "bag", tmp_path))


def test_numbered_files_follow_each_other(tmp_path):
    folder = tmp_path / "bag"
    folder.mkdir()
    for number in (10, 9, 2):
        (folder / f"bag_{number}.mcap").write_bytes(b"")
    (folder / "bag_1.mcap").symlink_to("/etc/passwd")
    assert [path.name for path in files_of_bag(folder)] == ["bag_2.mcap", "bag_9.mcap", "bag_10.mcap"]


def test_files_that_were_packed_one_by_one_are_unpacked(tmp_path):
    folder = tmp_path / "bag"
    folder.mkdir()
    for number, rows in enumerate((MESSAGES_OF_BAG[:1], MESSAGES_OF_BAG[1:])):
        (folder / f"bag_{number}.mcap.zstd").write_bytes(zstandard.compress(bag(rows)))
    check(converted(folder, tmp_path))
    table = bag_tables(tmp_path / "t.db3", MESSAGES_OF_BAG)
    tables = tmp_path / "tables"
    tables.mkdir()
    (tables / "bag_0.db3.zstd").write_bytes(zstandard.compress(table.read_bytes()))
    check(converted(tables, tmp_path))
    (tables / "bag_0.db3").write_bytes(table.read_bytes())  # the recorder may leave it there
    check(converted(tables, tmp_path))
    assert [path.name for path in files_of_bag(tables)] == ["bag_0.db3"]


def test_files_that_are_packed_in_order_of_their_numbers(tmp_path):
    for number in (10, 9, 2):
        (tmp_path / f"bag_{number}.db3.zstd").write_bytes(b"")
    assert [path.name for path in files_of_bag(tmp_path)] == [f"bag_{n}.db3.zstd" for n in (2, 9, 10)]


@pytest.mark.parametrize(
    ("name", "data", "text"),
    [
        ("bag_0.mcap.zstd", b"nonsense", "bag_0.mcap.zstd cannot be unpacked"),
        ("bag_0.mcap.zstd", zstandard.compress(bytes(1 << 20)), "too large unpacked"),
        ("bag_0.mcap.lz4", b"", "unpack them first"),
        ("bag_0.db3.gz", b"", "unpack them first"),
    ],
)
def test_packed_files_that_cannot_be_read_are_refused_by_name(name, data, text, tmp_path):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(OutsideError, match=text):
        convert_outside(tmp_path, io.BytesIO(), Limits(total_bytes=1 << 19))


@pytest.mark.parametrize("step_ns", [10**8, 5 * 10**9])
def test_messages_that_are_late_in_the_file_are_sorted_and_that_is_said(step_ns, tmp_path):
    rows = [(*row[:2], WALL_NS + number * step_ns, row[3]) for number, row in enumerate(MESSAGES_OF_BAG)]
    level = [
        ("/level", "std_msgs/msg/Float64", WALL_NS + number * step_ns, b"\0\1\0\0" + bytes([number]) * 8)
        for number in range(3)
    ]
    mixed = [rows[2], level[2], level[0], rows[0], rows[1], level[1]]
    for source in (bag(mixed), bag_tables(tmp_path / "b.db3", mixed)):
        said = converted(source, tmp_path)
        ticks = [each.t_ns for each in said if each.topic in {"/bt/tick", "/level"}]
        assert ticks == [number * step_ns for number in (0, 0, 1, 1, 2, 2)]
        assert results(said) == {2: [2], 3: [3], 1: [3]}
        (line,) = [each.fields["text"] for each in said if each.topic == "/bt/log"]
        assert line.startswith(f"4 messages were up to {2 * step_ns * 1e-9:.3g} s late")
    (tmp_path / "f.mcap").write_bytes(bag(mixed))
    assert convert_outside(tmp_path / "f.mcap", io.BytesIO()).late == 4
    assert convert_outside(bag_tables(tmp_path / "c.db3", rows), io.BytesIO()).late == 0


LEVEL = ("/level", "std_msgs/msg/Float64", 0, b"\0\1\0\0" + bytes(8))
LATE = [
    (*row[:2], WALL_NS + number * 10**7, row[3])
    for number, row in (
        *zip((3, 0), MESSAGES_OF_BAG[:2], strict=True),
        *((number, LEVEL) for number in (1, 2, 4, 6, 5, 8)),
        (7, MESSAGES_OF_BAG[2]),
    )
]


def test_chunks_of_several_files_give_what_sorting_in_parts_gives(tmp_path, monkeypatch):
    folder = tmp_path / "bag"
    folder.mkdir()
    for number, rows in enumerate((LATE[:5], LATE[5:])):
        (folder / f"bag_{number}.mcap").write_bytes(bag(rows, chunk_size=100))
    parts = converted(bag_tables(tmp_path / "b.db3", LATE), tmp_path)
    # The storage of SQLite has no chunks, so it was sorted in parts.
    monkeypatch.setattr(bags, "in_order", None)
    assert converted(folder, tmp_path) == parts
    assert [each.t_ns for each in parts if each.topic == "/level"] == [n * 10**7 for n in (1, 2, 4, 5, 6, 8)]


def test_a_channel_that_changes_its_topic_keeps_what_was_said_then(tmp_path):
    builder = RecordBuilder()
    for number, (topic, kind, t_ns, data) in enumerate(LATE):
        name = topic if number != 2 else "/other"
        Schema(id=1, name=kind, encoding="ros2msg", data=b"").write(builder)
        Channel(id=1, topic=name, message_encoding="cdr", metadata={}, schema_id=1).write(builder)
        Message(channel_id=1, log_time=t_ns, publish_time=t_ns, sequence=0, data=data).write(builder)
    said = converted(MAGIC + builder.end(), tmp_path)
    levels = [(each.topic, each.t_ns) for each in said if each.topic in {"/level", "/other"}]
    assert levels == [("/other", 10**7), *(("/level", n * 10**7) for n in (2, 4, 5, 6, 8))]


def test_our_own_types_scans_numbers_and_lines_are_kept_and_others_are_not(tmp_path):
    kinds = {"Tree": "/bt/tree", "Tick": "/bt/tick", "Log": "/bt/log"}
    ours = [
        (topic, f"bt_studio_msgs/msg/{name}", 10**9, encode(f"bt_studio_msgs/msg/{name}", MESSAGES[name]))
        for name, topic in kinds.items()
    ]
    more = [
        ("/scan", "sensor_msgs/msg/LaserScan", 2 * 10**9, bytes(80)),
        ("/level", "std_msgs/msg/Float64", 2 * 10**9, b"\0\1\0\0" + bytes(8)),
        ("/x", "std_msgs/msg/Byte", 3, b"\0\1\0\0a"),
    ]
    said = converted(bag([*ours, *more]), tmp_path)
    assert [each.topic for each in said] == ["/bt/tree", "/bt/tick", "/bt/log", "/scan", "/level"]
    assert said[0].fields == MESSAGES["Tree"]


def test_packed_messages_are_unpacked_within_bounds(tmp_path):
    packed = [(*row[:3], zstandard.compress(row[3])) for row in MESSAGES_OF_BAG]
    check(converted(bag_tables(tmp_path / "b.db3", packed), tmp_path))
    bomb = [("/behavior_tree_log", NAV, 1, zstandard.compress(bytes(70 << 20)))]
    with pytest.raises(OutsideError, match="too large unpacked"):
        converted(bag_tables(tmp_path / "bomb.db3", bomb), tmp_path)


@pytest.mark.parametrize(
    ("messages", "code", "text"),
    [
        ([("/x", "std_msgs/msg/Byte", 3, b"")], "no_tree", "no topic in it tells of a tree"),
        ([("/t", NAV, 3, b"\0\1\0\0nonsense")], "damaged", "message of /t cannot be read"),
        ([("/bt/tree", "bt_studio_msgs/msg/Tree", 3, b"\0\1\0\0")], "damaged", "/bt/tree: bt_studio_msgs"),
        ([*MESSAGES_OF_BAG, (*MESSAGES_OF_BAG[0][:2], 5, nav_message([]))], "times_run_back", "runs back"),
    ],
)
def test_wrong_bags_are_refused(messages, code, text, tmp_path):
    for source in (bag(messages), bag_tables(tmp_path / "b.db3", messages)):
        with pytest.raises(OutsideError, match=text) as caught:
            converted(source, tmp_path)
        assert caught.value.code == code


def test_too_many_messages_and_topics_are_refused(tmp_path):
    path = bag_tables(tmp_path / "b.db3", [(f"/t{n}", NAV, n, nav_message([])) for n in range(50)])
    for limits in (Limits(channels=20), Limits(messages=60)):
        with pytest.raises(OutsideError, match="too many"):
            convert_outside(path, io.BytesIO(), limits)


def test_what_was_made_is_read_by_other_readers(tmp_path):
    path = tmp_path / "made.mcap"
    with path.open("wb") as out:
        convert_outside(bag_tables(tmp_path / "b.db3", MESSAGES_OF_BAG), out)
    check(read(path.read_bytes()))
    with AnyReader([path]) as reader:
        ticks: list[Any] = [
            reader.deserialize(data, connection.msgtype)
            for connection, _, data in reader.messages()
            if connection.topic == "/bt/tick"
        ]
    assert [tick.number for tick in ticks] == [1, 2, 3]
