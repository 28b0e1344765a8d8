"""Databases with all tables and no rows of users: migrations run once a process, what follows are copies."""

from __future__ import annotations

import os
import tempfile
from contextlib import contextmanager
from functools import cache
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any

import psycopg

from tests.backend.programs import run_program
from tests.backend.services import cluster

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.backend.services import Cluster

SQLITE = "bt-studio.sqlite3"
_taken: list[bytes] = []


def take_sqlite(connection: Any) -> None:
    """Takes the new database of the tests, so that none has to be made for their servers."""
    if connection.vendor == "sqlite":
        connection.ensure_connection()
        _taken.append(connection.connection.serialize())


@cache
def sqlite_content() -> bytes:
    """The file of a SQLite database with all tables."""
    if _taken:
        return _taken[0]
    with tempfile.TemporaryDirectory() as folder:
        run_program("tests.backend.migrated", BT_STUDIO_DATA_DIR=folder)
        return (Path(folder) / SQLITE).read_bytes()


def add_sqlite(folder: Path) -> None:
    """Writes a database with all tables to a data folder that has none."""
    folder.mkdir(parents=True, exist_ok=True)
    if not (folder / SQLITE).exists():
        (folder / SQLITE).touch(mode=0o600)
        (folder / SQLITE).write_bytes(sqlite_content())


class WarmPostgreSQL:
    """One server for all tests that do not end it, with a database a test."""

    def __init__(self, server: Cluster) -> None:
        self.url, self._server = server.url, server
        self._numbers = count(1)
        self._is_migrated = False

    def _do(self, statement: str) -> None:
        with psycopg.connect(self.url, autocommit=True) as connection:
            connection.execute(statement.encode())

    def url_of(self, name: str) -> str:
        """Returns the URL of one of its databases."""
        return self.url.replace("@/bts?", f"@/{name}?")

    @contextmanager
    def database(self, prefix: str = "", *, is_migrated: bool = True) -> Iterator[str]:
        """The name of a database with all tables, or of an empty one, that ends with the block."""
        name, template = f"{prefix}bts{next(self._numbers)}", "template1"
        if is_migrated:
            template = self._migrated()
        self._do(f"CREATE DATABASE {name} TEMPLATE {template}")
        try:
            yield name
        finally:
            self._do(f"DROP DATABASE IF EXISTS {name} WITH (FORCE)")

    @contextmanager
    def database_url(self, *, is_migrated: bool = True) -> Iterator[str]:
        """The URL of such a database."""
        with self.database(is_migrated=is_migrated) as name:
            yield self.url_of(name)

    @contextmanager
    def crashed(self) -> Iterator[None]:
        """Ends the server at once; it runs again after the block."""
        self._server.crash()
        try:
            yield
        finally:
            self._server.start()

    def _migrated(self) -> str:
        if not self._is_migrated:
            self._do("CREATE DATABASE migrated")
            with tempfile.TemporaryDirectory() as folder:
                run_program(
                    "tests.backend.migrated",
                    BT_STUDIO_DATABASE_URL=self.url_of("migrated"),
                    BT_STUDIO_DATA_DIR=folder,
                )
            self._is_migrated = True
        return "migrated"


@contextmanager
def warm_postgresql() -> Iterator[WarmPostgreSQL]:
    """Starts it. The machine does not fail, so that no sync is needed."""
    with cluster(fsync="off", synchronous_commit="off", max_connections=120, autovacuum="off") as running:
        yield WarmPostgreSQL(running)


def main() -> None:
    """Migrates the database of the settings as `bt-studio serve` does before it serves."""
    os.environ["DJANGO_SETTINGS_MODULE"] = "backend.config.settings"
    from backend.config.server import migrate

    migrate()
    from django.db import connections

    connections.close_all()  # the last connection writes SQLite's log into the file


if __name__ == "__main__":
    main()
