"""Reads known columns of known tables of an SQLite file that nobody trusts.

The file is opened so that nothing is written or locked. Only `SELECT` on the named columns of real tables is
allowed: views, virtual tables, functions and triggers are refused before they do anything.
"""

from __future__ import annotations

import sqlite3
from typing import TYPE_CHECKING, Any, Final, Self

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from executor.recorder.outside.errors import OutsideError
    from executor.recorder.outside.limits import Counter

__all__ = ["BEGIN", "Tables"]

BEGIN: Final = b"SQLite format 3\0"
_DEFENSIVE: Final = 1010
_WRONG: Final = (sqlite3.Error, UnicodeError)  # also the text of an error may be damaged
_STEPS: Final = 10_000
_MASTER: Final = frozenset({"type", "name", "sql"})
_NAMES_OF_MASTER: Final = frozenset({"sqlite_master", "sqlite_schema"})
_HINT: Final = "The file is damaged, or was made to be."


class Tables:
    """An open file; use it as a context manager.

    Args:
        path: the file.
        counter: its limits.
        known: the columns that may be read, by table.

    Raises:
        OutsideError: it is no SQLite file.
    """

    def __init__(self, path: Path, counter: Counter, known: Mapping[str, Sequence[str]]) -> None:
        self._counter, self._known = counter, known
        self._may = {table: frozenset(columns) for table, columns in known.items()}
        uri = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
        self._database = sqlite3.connect(uri, uri=True, isolation_level=None)
        self._database.text_factory = lambda data: data.decode("utf-8", "replace")
        try:
            self._limit(counter.limits.chunk_bytes)
        except _WRONG as error:
            self._database.close()
            raise self._damaged(error, 0) from error

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._database.close()

    def names(self) -> set[str]:
        """Returns the known tables that the file has.

        Raises:
            OutsideError: the file is damaged.
        """
        rows = self._rows("SELECT type, name, sql FROM sqlite_master LIMIT 1000")
        return {
            name
            for kind, name, sql in rows
            if kind == "table" and name in self._may and str(sql).lstrip()[:12].upper() == "CREATE TABLE"
        }

    def rows(self, table: str, order: str = "") -> Iterator[tuple[int, tuple[Any, ...]]]:
        """Yields the rows of a known table, each with its number from 1; counts them.

        Args:
            table: the table.
            order: the column that orders the rows; "" for the order of the file.

        Raises:
            OutsideError: the table is not there, the file is damaged, or too large.
        """
        if table not in self.names():
            raise self._counter.error("damaged", 0, f"it has no table {table}", _HINT)
        sql = f"SELECT {', '.join(self._known[table])} FROM {table}"  # noqa: S608 - names of our own
        for number, row in enumerate(self._rows(f"{sql} ORDER BY {order}" if order else sql), 1):
            size = sum(len(value) if isinstance(value, str | bytes) else 8 for value in row)
            self._counter.add(size, number)
            yield number, row

    def _limit(self, longest: int) -> None:
        database = self._database
        database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, longest)
        database.setlimit(sqlite3.SQLITE_LIMIT_ATTACHED, 0)
        database.setlimit(sqlite3.SQLITE_LIMIT_VDBE_OP, 25_000)
        if (configure := getattr(database, "setconfig", None)) is not None:  # from Python 3.12
            configure(_DEFENSIVE, True)  # noqa: FBT003 - it takes no keywords
        database.execute("PRAGMA trusted_schema = OFF")
        database.execute("PRAGMA mmap_size = 0")
        database.execute("PRAGMA cell_size_check = ON")
        database.execute("PRAGMA cache_size = -4096")
        database.set_progress_handler(self._counter.is_late, _STEPS)
        database.set_authorizer(self._allow)

    def _allow(
        self, action: int, table: str | None, column: str | None, _: str | None, via: str | None
    ) -> int:
        if action == sqlite3.SQLITE_SELECT:
            return sqlite3.SQLITE_OK
        is_read = action == sqlite3.SQLITE_READ and via is None
        known = _MASTER if table in _NAMES_OF_MASTER else self._may.get(table or "", frozenset())
        return sqlite3.SQLITE_OK if is_read and column in known else sqlite3.SQLITE_DENY

    def _rows(self, sql: str) -> Iterator[tuple[Any, ...]]:
        number = 0
        try:
            for number, row in enumerate(self._database.execute(sql), 1):  # noqa: B007 - the place of an error
                yield row
        except _WRONG as error:
            if self._counter.is_late():
                raise self._counter.late(number + 1) from error
            raise self._damaged(error, number + 1) from error

    def _damaged(self, error: Exception, row: int) -> OutsideError:
        text = f"a table cannot be read ({str(error)[:100]})"
        return self._counter.error("damaged", row, text, _HINT)
