"""Reads bags of ROS 2: MCAP and SQLite, one file or a folder of them.

Of the topics those are kept that the page can show: `nav2_msgs/BehaviorTreeLog`, our own types, `/rosout`,
laser scans, JPEG pictures, and the small messages of which people plot numbers. The definitions of other
types in a bag are not read.
"""

from __future__ import annotations

import contextlib
import re
from typing import TYPE_CHECKING, Final, NamedTuple

import zstandard
from mcap.records import Channel, Message, Schema

from executor.recorder.cdr import CdrError, decode
from executor.recorder.definitions import OURS, DefinitionError, names_of_ours
from executor.recorder.outside.nav_log import changes_of, line_of
from executor.recorder.outside.tables import BEGIN as SQLITE_BEGIN
from executor.recorder.outside.tables import Tables
from executor.recorder.outside.tree_log import TimeLine, TreeLog
from executor.recorder.outside.tree_xml import MOST_NODES, flat_tree
from executor.recorder.reader import RecordReader

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from executor.recorder.outside.limits import Counter
    from executor.recorder.outside.nav_log import NodeChange
    from executor.recorder.writer import RecordingWriter

__all__ = ["TABLES", "convert_bag", "files_of_bag", "is_bag"]

TABLES: Final[dict[str, tuple[str, ...]]] = {
    "topics": ("id", "name", "type", "serialization_format"),
    "messages": ("topic_id", "timestamp", "data"),
}
TREE_LOG: Final = "nav2_msgs/msg/BehaviorTreeLog"
OUR_TREE: Final = f"{OURS}/msg/Tree"
ROSOUT: Final = "rcl_interfaces/msg/Log"
_SHOWN: Final = frozenset({"sensor_msgs/msg/LaserScan", "sensor_msgs/msg/CompressedImage"})
_PLOTTED: Final = frozenset(
    f"{package}/msg/{name}"
    for package, names in {
        "geometry_msgs": "PointStamped PoseStamped PoseWithCovarianceStamped Twist TwistStamped",
        "nav_msgs": "Odometry",
        "sensor_msgs": "BatteryState Imu JointState NavSatFix Range Temperature",
        "std_msgs": "Bool Float32 Float64 Int8 Int16 Int32 Int64 UInt8 UInt16 UInt32 UInt64",
    }.items()
    for name in names.split()
)
_OURS: Final = frozenset(names_of_ours())
_KEPT: Final = _SHOWN | _PLOTTED | _OURS | {TREE_LOG, ROSOUT}
_PACKED: Final = b"\x28\xb5\x2f\xfd"
_ENDINGS: Final = (".mcap", ".db3")
MOST_FILES: Final = 1000
_HINT: Final = "Is it a bag of ROS 2 with behavior_tree_log or our own topics?"
_LONGEST_NS: Final = 1 << 63


class Sent(NamedTuple):
    """A message of a bag; `place` is its offset or row."""

    topic: str
    kind: str
    t_ns: int
    data: bytes
    place: int


def files_of_bag(folder: Path) -> list[Path]:
    """Returns the files of a bag in their order; they are numbered. Links are left out."""
    found = [
        path
        for path in folder.iterdir()
        if path.suffix in _ENDINGS and path.is_file() and not path.is_symlink()
    ]
    return sorted(found, key=lambda path: [int(part) for part in re.findall(r"\d{1,18}", path.stem)[-1:]])


def is_bag(folder: Path) -> bool:
    """Returns whether a folder is a bag."""
    return (folder / "metadata.yaml").is_file()


def convert_bag(files: Sequence[Path], counter: Counter, writer: RecordingWriter) -> None:
    """Writes a bag as a recording.

    Raises:
        OutsideError: it is no bag, or has no tree.
        RecordingError: an MCAP file in it is damaged.
    """
    topic, names, has_ours = _survey(files, counter)
    if not topic and not has_ours:
        raise counter.error("no_tree", 0, "no topic in it tells of a tree", _HINT)
    writer.describe("outside", {"kind": "bag"})
    log, times = TreeLog(writer, counter.name), TimeLine(counter.name)
    if topic:
        log.tree(0, flat_tree({number: name for number, (_, name) in enumerate(names)}))
    numbers = {key: number for number, key in enumerate(names)}
    for sent in _messages(files, counter):
        t_ns = times.at(sent.t_ns, sent.place)
        if sent.kind == TREE_LOG:
            if sent.topic == topic:
                log.end_step()
                for change in _changes(sent, counter):
                    log.change(t_ns, numbers[change.number, change.name], change.status, sent.place)
                log.end_step()
        elif sent.kind == ROSOUT:
            with contextlib.suppress(CdrError):  # a line less, the tree stays
                level, text = line_of(sent.data)
                log.line(t_ns, "ros", level, text)
        else:
            _copy(sent, t_ns, counter, writer)


# --- inside ---


def _survey(files: Sequence[Path], counter: Counter) -> tuple[str, list[tuple[int, str]], bool]:
    """Returns the topic of the tree, its nodes by number, and whether there is a tree of ours."""
    topic, has_ours = "", False
    names: dict[tuple[int, str], None] = {}
    for sent in _messages(files, counter):
        has_ours = has_ours or sent.kind == OUR_TREE
        if sent.kind != TREE_LOG:
            continue
        topic = topic or sent.topic
        for change in _changes(sent, counter) if sent.topic == topic else ():
            names[change.number, change.name] = None
            if len(names) > MOST_NODES:
                text = f"its tree has more than {MOST_NODES} nodes"
                raise counter.error("too_large", sent.place, text, _HINT)
    return topic, sorted(names, key=lambda key: key[0]), has_ours


def _changes(sent: Sent, counter: Counter) -> list[NodeChange]:
    try:
        return changes_of(sent.data)
    except CdrError as error:
        text = f"a message of {sent.topic} cannot be read ({error})"
        raise counter.error("damaged", sent.place, text, "Is its type that of Nav2?") from error


def _copy(sent: Sent, t_ns: int, counter: Counter, writer: RecordingWriter) -> None:
    """Copies a message unchanged; messages of our types are checked first, since pages rely on them."""
    try:
        if sent.kind in _OURS:
            decode(sent.kind, sent.data)
        writer.write(sent.topic, sent.kind, t_ns, sent.data)
    except CdrError as error:
        raise counter.error("damaged", sent.place, f"{sent.topic}: {error}"[:200], _HINT) from error
    except DefinitionError:
        pass  # the packages of ROS are not there, so that nobody can read it


def _messages(files: Sequence[Path], counter: Counter) -> Iterator[Sent]:
    """Yields the messages of the known types."""
    counter = counter.again()
    for path in files:
        with path.open("rb") as file:
            is_sqlite = file.read(len(SQLITE_BEGIN)) == SQLITE_BEGIN
        for sent in _of_tables(path, counter) if is_sqlite else _of_mcap(path, counter):
            counter.add(len(sent.data), sent.place)
            if sent.data.startswith(_PACKED):
                yield sent._replace(data=_unpacked(sent, counter))
            else:
                yield sent


def _of_mcap(path: Path, counter: Counter) -> Iterator[Sent]:
    kinds: dict[int, str] = {}
    channels: dict[int, tuple[str, str]] = {}
    with path.open("rb") as file:
        reader = RecordReader(file, counter.name, counter.limits)
        for number, record in enumerate(reader):
            if number % 1000 == 0 and counter.is_late():
                raise counter.late(reader.read_to)
            match record:
                case Schema():
                    kinds[record.id] = record.name
                case Channel():
                    kind = kinds.get(record.schema_id, "")
                    if kind in _KEPT and record.message_encoding == "cdr":
                        channels[record.id] = record.topic, kind
                case Message() if record.channel_id in channels:
                    yield Sent(*channels[record.channel_id], record.log_time, record.data, reader.read_to)
                case _:
                    pass


def _of_tables(path: Path, counter: Counter) -> Iterator[Sent]:
    with Tables(path, counter, TABLES) as tables:
        topics: dict[int, tuple[str, str]] = {}
        for row, (number, name, kind, form) in tables.rows("topics"):
            if row > counter.limits.channels:
                text = f"At most {counter.limits.channels} are read."
                raise counter.error("too_large", row, "the file has too many topics", text)
            if kind in _KEPT and form == "cdr" and isinstance(name, str):
                topics[number] = name, kind
        for row, (number, t_ns, data) in tables.rows("messages"):
            if number not in topics:
                continue
            if type(t_ns) is not int or not 0 <= t_ns < _LONGEST_NS or not isinstance(data, bytes):
                raise counter.error("damaged", row, "a message has no time or no bytes", _HINT)
            yield Sent(*topics[number], t_ns, data, row)


def _unpacked(sent: Sent, counter: Counter) -> bytes:
    """Returns a message that the bag holds packed."""
    most = counter.limits.chunk_bytes
    try:
        with zstandard.ZstdDecompressor(max_window_size=1 << 27).stream_reader(sent.data) as stream:
            data = stream.read(most + 1)
    except zstandard.ZstdError as error:
        raise counter.error("damaged", sent.place, "a message cannot be unpacked", _HINT) from error
    if len(data) > most:
        raise counter.error(
            "too_large", sent.place, "a message is too large unpacked", f"At most {most} bytes."
        )
    counter.add(len(data), sent.place)
    return bytes(data)
