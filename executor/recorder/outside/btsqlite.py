"""Reads the logs of BehaviorTree.CPP's SqliteLogger (`.db3`, `.btdb`).

A file holds one or more sessions: in `Definitions` the tree of each, in `Transitions` its changes. The
recording has one generation of the tree for each, a second apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor.recorder.outside.tables import Tables
from executor.recorder.outside.tree_log import TimeLine, TreeLog
from executor.recorder.outside.tree_xml import tree_of_xml

if TYPE_CHECKING:
    from pathlib import Path

    from executor.recorder.outside.limits import Counter
    from executor.recorder.outside.tree_xml import LoggedTree
    from executor.recorder.writer import RecordingWriter

__all__ = ["TABLES", "convert_btsqlite"]

TABLES: Final[dict[str, tuple[str, ...]]] = {
    "Definitions": ("session_id", "xml_tree"),
    "Transitions": ("timestamp", "session_id", "node_uid", "state", "extra_data"),
}
MOST_SESSIONS: Final = 1000
_APART_NS: Final = 1_000_000_000
_LONGEST_US: Final = 1 << 62
_HINT: Final = "Is it a file of BehaviorTree.CPP's SqliteLogger?"


def convert_btsqlite(path: Path, counter: Counter, writer: RecordingWriter) -> None:
    """Writes a log as a recording.

    Raises:
        OutsideError: the file is no such log.
    """
    log, times = TreeLog(writer, counter.name), TimeLine(counter.name)
    writer.describe("outside", {"kind": "btsqlite"})
    with Tables(path, counter, TABLES) as tables:
        trees = _trees(tables, counter)
        session: Any = None
        for row, (t_us, of, number, status, extra) in tables.rows("Transitions", order="timestamp"):
            if not all(type(value) is int for value in (t_us, of, number, status)) or abs(t_us) > _LONGEST_US:
                raise counter.error("damaged", row, "a change is not made of whole numbers", _HINT)
            if of != session:
                if of not in trees:
                    text = f"a change is of session {of}, which has no tree or was over"
                    raise counter.error("damaged", row, text, _HINT)
                if session is not None:
                    log.end_step()
                    times.join(_APART_NS)
                session = of
                log.tree(times.at(t_us * 1000, row), trees.pop(of))
            t_ns = times.at(t_us * 1000, row)
            log.change(t_ns, number, status, row)
            if isinstance(extra, str) and extra:
                log.line(t_ns, "log", "info", extra)
        for tree in trees.values() if session is None else ():
            log.tree(0, tree)
    log.end_step()


def _trees(tables: Tables, counter: Counter) -> dict[int, LoggedTree]:
    found: dict[int, LoggedTree] = {}
    for row, (session, xml) in tables.rows("Definitions"):
        if type(session) is not int or not isinstance(xml, str):
            raise counter.error("damaged", row, "a session has no number or no tree", _HINT)
        if len(found) >= MOST_SESSIONS:
            raise counter.error(
                "too_large", row, "it has too many sessions", f"At most {MOST_SESSIONS} are read."
            )
        found[session] = tree_of_xml(xml.encode(), counter.name, row)
    if not found:
        raise counter.error("no_tree", 0, "it has no tree", _HINT)
    return found
