"""SQLite files that were made to do harm."""

from __future__ import annotations

import sqlite3

import pytest

from executor.recorder.outside.errors import OutsideError
from executor.recorder.outside.limits import Counter
from executor.recorder.outside.tables import Tables
from executor.recorder.reader import Limits

KNOWN = {"things": ("id", "name")}


def rows(path, limits=None, **more):
    with Tables(path, Counter("f.db3", limits or Limits(), **more), KNOWN) as tables:
        return [row for _, row in tables.rows("things")]


def made(path, sql):
    database = sqlite3.connect(path)
    database.executescript(sql)
    database.close()
    return path


PLAIN = "CREATE TABLE things (id INTEGER PRIMARY KEY, name TEXT, secret TEXT);"
PLAIN += "INSERT INTO things VALUES (1, 'a', 's');"


def test_known_columns_are_read_in_order(tmp_path):
    assert rows(made(tmp_path / "f", PLAIN)) == [(1, "a")]


@pytest.mark.parametrize(
    "sql",
    [
        "CREATE TABLE other (id, name); CREATE VIEW things AS SELECT id, name FROM other;",
        "CREATE VIEW things AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n) "
        "SELECT id, 'x' AS name FROM n;",
        "CREATE VIRTUAL TABLE things USING fts5(id, name);",
        "CREATE TABLE things (id, name AS (hex(zeroblob(100000000))));INSERT INTO things VALUES (1);",
        "CREATE TABLE other (id);",
        "CREATE TABLE things (id, label);",
    ],
)
def test_what_is_no_plain_table_is_refused(sql, tmp_path):
    with pytest.raises(OutsideError, match=r"f\.db3:\d+: (it has no table|a table cannot be read)") as caught:
        rows(made(tmp_path / "f", sql))
    assert caught.value.code == "damaged"


def test_triggers_do_nothing_and_the_file_stays(tmp_path):
    path = made(tmp_path / "f", f"{PLAIN} CREATE TRIGGER t AFTER UPDATE ON things BEGIN SELECT 1; END;")
    before = path.read_bytes()
    assert rows(path) == [(1, "a")]
    assert path.read_bytes() == before
    assert [each.name for each in tmp_path.iterdir()] == ["f"]


def test_limits_end_the_reading(tmp_path):
    path = made(
        tmp_path / "f",
        "CREATE TABLE things (id, name); WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n "
        "WHERE i < 5000) INSERT INTO things SELECT i, 'name' FROM n;",
    )
    with pytest.raises(OutsideError, match="too many messages"):
        rows(path, Limits(messages=100))
    with pytest.raises(OutsideError, match="too large unpacked"):
        rows(path, Limits(total_bytes=1000))
    with pytest.raises(OutsideError, match="more than -1 s") as caught:
        rows(path, seconds=-1.0)
    assert caught.value.code == "too_long"


def test_a_value_over_the_limit_is_not_read(tmp_path):
    path = made(
        tmp_path / "f", "CREATE TABLE things (id, name); INSERT INTO things VALUES (1, zeroblob(5000));"
    )
    with pytest.raises(OutsideError, match="cannot be read"):
        rows(path, Limits(chunk_bytes=1000))


def test_damaged_bytes_are_refused_or_read_without_harm(tmp_path):
    whole = made(tmp_path / "f", PLAIN).read_bytes()
    codes = set()
    for at in range(0, len(whole), 61):
        path = tmp_path / "damaged"
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 0xFF]) + whole[at + 1 :])
        try:
            rows(path)
        except OutsideError as error:
            codes.add(error.code)
    assert "too_long" not in codes
