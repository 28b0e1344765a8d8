"""A statement that was prepared before a migration changed a column works afterwards."""

from __future__ import annotations

import time

import pytest
from django.db import OperationalError
from django.db.utils import ConnectionHandler

from backend.config import team
from backend.core.stale_plans import watch_plans

pytestmark = pytest.mark.django_db(transaction=True)
ASKED = "SELECT address FROM places"


@pytest.fixture
def connections(warm_postgresql):
    """A PostgreSQL, which tests on SQLite do not have; the first connection has prepared a statement."""
    watch_plans()
    with warm_postgresql.database_url(is_migrated=False) as url:
        handler = ConnectionHandler({"default": team.postgresql(url), "migrating": team.postgresql(url)})
        with handler["migrating"].cursor() as cursor:
            cursor.execute("CREATE TABLE places (address varchar(200))")
            cursor.execute("INSERT INTO places VALUES ('here')")
        yield handler
        handler.close_all()


def asked(connection):
    with connection.cursor() as cursor:
        cursor.execute(ASKED)
        return cursor.fetchall()


def prepared_and_changed(connections):
    connection = connections["default"]
    for _ in range(5):
        asked(connection)
    with connections["migrating"].cursor() as cursor:
        cursor.execute("ALTER TABLE places ALTER address TYPE varchar(400)")
    return connection


def test_it_is_executed_again_on_a_new_connection(connections):
    connection = prepared_and_changed(connections)
    before = connection.connection
    assert asked(connection) == [("here",)]
    assert connection.connection is not before
    assert asked(connection) == [("here",)]


def test_in_a_transaction_the_request_may_be_tried_again(connections):
    connection = prepared_and_changed(connections)
    # `transaction.atomic` knows the connections of the settings alone.
    connection.set_autocommit(False)
    connection.in_atomic_block = True
    with pytest.raises(OperationalError):
        asked(connection)
    connection.in_atomic_block = False
    connection.rollback()
    connection.set_autocommit(True)
    assert connection.close_at < time.monotonic()
    connection.close_if_unusable_or_obsolete()
    assert asked(connection) == [("here",)]
