"""Reads bags of ROS 2: MCAP and SQLite, one file or a folder of them.

Of the topics those are kept that the page can show: `nav2_msgs/BehaviorTreeLog`, our own types, `/rosout`,
laser scans, JPEG pictures, and the small messages of which people plot numbers. The definitions of other
types in a bag are not read.
"""

from __future__ import annotations

import contextlib
import re
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Final

import zstandard

from executor.recorder.cdr import CdrError, decode
from executor.recorder.definitions import OURS, DefinitionError, names_of_ours
from executor.recorder.outside.mcap_file import McapFile
from executor.recorder.outside.nav_log import changes_of, line_of
from executor.recorder.outside.sorting import Chunks, Sent, in_order
from executor.recorder.outside.tables import BEGIN as SQLITE_BEGIN
from executor.recorder.outside.tables import Tables
from executor.recorder.outside.tree_log import LONGEST_NS, TimeLine, TreeLog
from executor.recorder.outside.tree_xml import MOST_NODES, flat_tree

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from executor.recorder.outside.limits import Counter
    from executor.recorder.outside.nav_log import NodeChange
    from executor.recorder.writer import RecordingWriter

__all__ = ["TABLES", "convert_bag", "files_of_bag", "is_bag", "packed_otherwise"]

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
_PACKED_ENDINGS: Final = tuple(f"{ending}.zstd" for ending in _ENDINGS)
"""The files of a bag that was recorded with `--compression-mode file`."""
_NUMBER: Final = re.compile(r"(\d{1,18})\D*\Z")
MOST_FILES: Final = 1000
_HINT: Final = "Is it a bag of ROS 2 with behavior_tree_log or our own topics?"
_LONGEST_NS: Final = 1 << 63


def files_of_bag(folder: Path) -> list[Path]:
    """Returns the files of a bag in their order; they are numbered. Links are left out."""
    found = [
        path
        for path in folder.iterdir()
        if path.name.endswith((*_ENDINGS, *_PACKED_ENDINGS)) and path.is_file() and not path.is_symlink()
    ]
    whole = {path.name for path in found}
    # The recorder may have left the unpacked file beside the packed one.
    return sorted(
        (path for path in found if path.name.removesuffix(".zstd") not in whole - {path.name}), key=_number
    )


def packed_otherwise(folder: Path) -> bool:
    """Returns whether a folder has files of a bag that are packed in a way that is not read."""
    return any(f"{ending}." in path.name for path in folder.iterdir() for ending in _ENDINGS)


def _number(path: Path) -> int:
    name = path.name.removesuffix(".zstd")
    found = _NUMBER.search(name[: name.rindex(".")])
    return int(found[1]) if found is not None else -1


def is_bag(folder: Path) -> bool:
    """Returns whether a folder is a bag."""
    return (folder / "metadata.yaml").is_file()


def convert_bag(
    files: Sequence[Path], counter: Counter, writer: RecordingWriter, folder: Path | None = None
) -> int:
    """Writes a bag as a recording; returns the number of messages that were not in the order of time.

    Args:
        files: its files; those that are packed are unpacked first.
        counter: the limits.
        writer: the recording.
        folder: where files may be meanwhile; None for the system's own folder.

    Raises:
        OutsideError: it is no bag, or has no tree.
        RecordingError: an MCAP file in it is damaged.
    """
    with contextlib.ExitStack() as opened:
        return _convert(_unpacked_files(files, counter, folder, opened), counter, writer, folder)


@dataclass
class _Survey:
    """The findings of a first pass: the topic of the tree, its nodes by number, and the order of times."""

    topic: str = ""
    names: list[tuple[int, str]] = field(default_factory=list)
    has_ours: bool = False
    late: int = 0
    back_ns: int = 0


def _unpacked_files(
    files: Sequence[Path], counter: Counter, folder: Path | None, opened: contextlib.ExitStack
) -> list[Path]:
    """Returns the files, those that are packed as copies that last as long as `opened`."""
    if not any(path.suffix == ".zstd" for path in files):
        return list(files)
    place = Path(opened.enter_context(tempfile.TemporaryDirectory(dir=folder)))
    left, found = counter.limits.total_bytes, []
    for number, path in enumerate(files):
        if path.suffix != ".zstd":
            found.append(path)
            continue
        target = place / f"{number}{Path(path.stem).suffix}"
        left -= _unpack_file(path, target, left, counter)
        found.append(target)
    return found


def _unpack_file(path: Path, target: Path, most: int, counter: Counter) -> int:
    """Unpacks a file; returns its size."""
    size = 0
    unpacker = zstandard.ZstdDecompressor(max_window_size=1 << 27)
    try:
        with path.open("rb") as source, target.open("wb") as out:
            for data in unpacker.read_to_iter(source, write_size=1 << 20):
                size += len(data)
                if size > most:
                    text = f"At most {counter.limits.total_bytes} bytes."
                    raise counter.error("too_large", 0, "the bag is too large unpacked", text)
                if counter.is_late():
                    raise counter.late(0)
                out.write(data)
    except zstandard.ZstdError as error:
        raise counter.error("damaged", 0, f"{path.name} cannot be unpacked", _HINT) from error
    return size


def _convert(files: Sequence[Path], counter: Counter, writer: RecordingWriter, folder: Path | None) -> int:
    opened, chunks = _opened(files, counter), Chunks()
    survey = _survey(opened, counter, chunks)
    topic, names = survey.topic, survey.names
    if not topic and not survey.has_ours:
        raise counter.error("no_tree", 0, "no topic in it tells of a tree", _HINT)
    # Where the clock was set meanwhile, times mean nothing: `TimeLine` refuses that.
    is_late = 0 < survey.back_ns <= LONGEST_NS
    writer.describe("outside", {"kind": "bag"} | ({"sorted": str(survey.late)} if is_late else {}))
    log, times = TreeLog(writer, counter.name), TimeLine(counter.name)
    if topic:
        log.tree(0, flat_tree({number: name for number, (_, name) in enumerate(names)}))
    if is_late:
        log.line(0, "bt-studio", "warning", sorted_sentence(survey.late, survey.back_ns))
    numbers = {key: number for number, key in enumerate(names)}
    messages = _sorted(opened, counter, chunks, folder) if is_late else _messages(opened, counter)
    for sent in _plain(messages, counter):
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
    return survey.late if is_late else 0


def sorted_sentence(late: int, back_ns: int) -> str:
    """Returns the sentence about messages that were not in the order of time."""
    one = late == 1
    were = "1 message was" if one else f"{late} messages were"
    return f"{were} up to {back_ns * 1e-9:.3g} s late in the file; all are in the order of their times now"


def _survey(files: Sequence[McapFile | Path], counter: Counter, chunks: Chunks) -> _Survey:
    found, newest_ns = _Survey(), 0
    names: dict[tuple[int, str], None] = {}
    for sent in _plain(_messages(files, counter, chunks), counter):
        newest_ns = max(newest_ns, sent.t_ns)
        found.late += sent.t_ns < newest_ns
        found.back_ns = max(found.back_ns, newest_ns - sent.t_ns)
        found.has_ours = found.has_ours or sent.kind == OUR_TREE
        if sent.kind != TREE_LOG:
            continue
        found.topic = found.topic or sent.topic
        for change in _changes(sent, counter) if sent.topic == found.topic else ():
            names[change.number, change.name] = None
            if len(names) > MOST_NODES:
                text = f"its tree has more than {MOST_NODES} nodes"
                raise counter.error("too_large", sent.place, text, _HINT)
    found.names = sorted(names, key=lambda key: key[0])
    return found


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


def _opened(files: Sequence[Path], counter: Counter) -> list[McapFile | Path]:
    """Returns the files as they are read; those of SQLite as paths."""
    found: list[McapFile | Path] = []
    for path in files:
        with path.open("rb") as file:
            is_sqlite = file.read(len(SQLITE_BEGIN)) == SQLITE_BEGIN
        found.append(path if is_sqlite else McapFile(path, _KEPT, counter))
    return found


def _messages(
    files: Sequence[McapFile | Path], counter: Counter, chunks: Chunks | None = None
) -> Iterator[Sent]:
    """Yields the messages of the known types as they lie in the files, and notes their chunks."""
    for number, file in enumerate(files):
        for sent in _of_tables(file, counter) if isinstance(file, Path) else file.messages():
            if chunks is not None:
                chunks.note(number, sent)
            yield sent


def _sorted(
    files: Sequence[McapFile | Path], counter: Counter, chunks: Chunks, folder: Path | None
) -> Iterator[Sent]:
    """Yields the messages by their times, from their chunks where these are known and few overlap."""
    mcaps = [file for file in files if isinstance(file, McapFile)]
    if len(mcaps) == len(files) and all(file.has_one_meaning for file in mcaps) and chunks.fit():
        try:
            yield from chunks.in_order(lambda number, place: mcaps[number].chunk(place))
        except ValueError as error:
            raise counter.error("damaged", 0, str(error), "Was the file written meanwhile?") from error
    else:
        yield from in_order(_messages(files, counter), folder)


def _plain(messages: Iterable[Sent], counter: Counter) -> Iterator[Sent]:
    """Counts messages, and unpacks those that are packed."""
    counter = counter.again()
    for sent in messages:
        counter.add(len(sent.data), sent.place)
        if sent.data.startswith(_PACKED):
            yield sent._replace(data=_unpacked(sent, counter))
        else:
            yield sent


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
