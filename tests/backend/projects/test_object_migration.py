"""The tables for the object store, on data of the release before, which continues to read and write."""

from __future__ import annotations

import pytest
from django.db import connection
from django.db.migrations.executor import MigrationExecutor

BEFORE = [("projects", "0002_team"), ("runs", "0002_last")]
AFTER = [("projects", "0003_object_store"), ("runs", "0003_object_store")]
# What the release before asks of the database.
INSERT = "INSERT INTO projects_blob (sha256, size, data) VALUES (%s, %s, %s)"
SELECT = "SELECT sha256, data FROM projects_blob ORDER BY sha256"


def migrate(targets):
    executor = MigrationExecutor(connection)
    executor.migrate(targets)
    return executor.loader.project_state(targets).apps


def rows():
    with connection.cursor() as cursor:
        cursor.execute(SELECT)
        return [(sha256, bytes(data)) for sha256, data in cursor.fetchall()]


@pytest.mark.django_db(transaction=True)
def test_the_release_before_reads_and_writes_meanwhile():
    try:
        migrate(BEFORE)
        with connection.cursor() as cursor:
            cursor.execute(INSERT, ["a" * 64, 3, b"\0\xffa"])
        apps = migrate(AFTER)
        with connection.cursor() as cursor:
            cursor.execute(INSERT, ["b" * 64, 1, b"b"])
        assert rows() == [("a" * 64, b"\0\xffa"), ("b" * 64, b"b")]
        found = apps.get_model("projects", "Blob").objects.get(sha256="b" * 64)
        assert (found.stored_at, found.unreferenced_at, found.marked_at) == (None, None, None)
        migrate(BEFORE)
        assert len(rows()) == 2
    finally:
        migrate(AFTER)
