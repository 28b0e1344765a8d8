"""Reads the files of BehaviorTree.CPP's FileLogger2 (`.btlog`).

    "BTCPP4-FileLogger2", 1 byte version, 4 bytes length of the XML, the XML, 8 bytes time of the begin in µs
    then for each change: 6 bytes time since the begin in µs, 2 bytes number of the node, 1 byte status

Numbers are little-endian. A last change may be cut off.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, BinaryIO, Final

from executor.recorder.outside.tree_log import TimeLine, TreeLog
from executor.recorder.outside.tree_xml import MOST_XML_BYTES, tree_of_xml

if TYPE_CHECKING:
    from executor.recorder.outside.limits import Counter
    from executor.recorder.writer import RecordingWriter

__all__ = ["BEGIN", "convert_btlog"]

BEGIN: Final = b"BTCPP4-FileLogger2"
_VERSION: Final = 1
_CHANGE: Final = struct.Struct("<IHHB")  # the time is its low 4 and high 2 bytes
_AT_ONCE: Final = 4096
_HINT: Final = "Is it a whole file of BehaviorTree.CPP's FileLogger2?"


def convert_btlog(file: BinaryIO, counter: Counter, writer: RecordingWriter) -> None:
    """Writes a log as a recording.

    Raises:
        OutsideError: the file is no such log.
    """
    head = file.read(len(BEGIN) + 5)
    if len(head) < len(BEGIN) + 5 or not head.startswith(BEGIN):
        raise counter.error("damaged", 0, "it ends within its head", _HINT)
    version, length = struct.unpack_from("<Bi", head, len(BEGIN))
    if version != _VERSION:
        text = f"it has version {version} of the format"
        raise counter.error("not_a_log", len(BEGIN), text, f"Version {_VERSION} is known.")
    if not 0 < length <= MOST_XML_BYTES:
        text = f"its tree claims {length} bytes"
        raise counter.error("too_large", len(BEGIN) + 1, text, f"At most {MOST_XML_BYTES} are read.")
    xml, begin = file.read(length), file.read(8)
    if len(begin) < 8:
        raise counter.error("damaged", len(head), "it ends within its tree", _HINT)
    (began_us,) = struct.unpack("<q", begin)
    writer.describe("outside", {"kind": "btlog", "began_us": str(began_us)})
    log, times = TreeLog(writer, counter.name), TimeLine(counter.name)
    log.tree(times.at(0, 0), tree_of_xml(xml, counter.name, len(head)))
    place = len(head) + length + len(begin)
    while data := file.read(_CHANGE.size * _AT_ONCE):
        whole = len(data) - len(data) % _CHANGE.size
        for low, high, number, status in _CHANGE.iter_unpack(data[:whole]):
            counter.add(_CHANGE.size, place)
            log.change(times.at((high << 32 | low) * 1000, place), number, status, place)
            place += _CHANGE.size
    log.end_step()
