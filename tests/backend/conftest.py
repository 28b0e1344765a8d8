"""Fixtures of all tests of the web server."""

from __future__ import annotations

import asyncio
import json
import threading
from typing import Any

import pytest
from django.conf import settings
from django.db import connections
from django.test import Client

from backend.accounts.identity import the_local_user
from backend.accounts.writes import local_user
from backend.config.environment import environment
from backend.core import guard
from backend.core.connection_costs import messages
from backend.core.readers import readers
from backend.core.scratch import scratch
from backend.ingress.handler import ThreadedHandler
from backend.projects.storage.cache import kept_stored
from backend.workers import priorities
from tests.backend import emptied, migrated
from tests.backend.bucket import bucket
from tests.backend.preloaded import preloading

HOST = "127.0.0.1:8000"


class Api:
    """A browser that has opened the link, reduced to JSON requests."""

    def __init__(self):
        self.client = Client(HTTP_HOST=HOST)
        self.client.cookies[guard.cookie_name(HOST)] = guard.keys().cookie_value

    def call(self, method, path, body=None, *, expect=200, **headers):
        address = path if path.startswith("/") else f"/api/v1/{path}"
        data: dict[str, Any] = (
            {} if body is None else {"data": json.dumps(body), "content_type": "application/json"}
        )
        response = self.client.generic(method, address, headers=headers, **data)
        content = response.getvalue()  # also for a file that is sent
        assert response.status_code == expect, (response.status_code, content[:2000])
        self.response = response
        is_json = "json" in response.headers.get("Content-Type", "")
        return json.loads(content) if is_json and content else content

    def get(self, path, **options):
        return self.call("GET", path, **options)

    def post(self, path, body=None, **options):
        return self.call("POST", path, {} if body is None else body, **options)

    def patch(self, path, body, **options):
        return self.call("PATCH", path, body, **options)

    def put(self, path, body, **options):
        return self.call("PUT", path, body, **options)

    def delete(self, path, *, expect=204, **options):
        return self.call("DELETE", path, expect=expect, **options)

    def save(self, project_id, *files, message="", **options):
        return self.post(
            f"projects/{project_id}/changes", {"message": message, "files": list(files)}, **options
        )


@pytest.fixture(scope="session", autouse=True)
def _workers_end():
    """Ends the workers of this process with its last test, and not only at its exit."""
    yield
    if priorities.pool.cache_info().currsize and isinstance(pools := priorities.pool(), priorities.Pools):
        pools.close()


@pytest.fixture(scope="session", autouse=True)
def _programs_are_forked():
    with preloading():
        yield


@pytest.fixture(scope="session")
def django_db_modify_db_settings(tmp_path_factory):
    """A file, as in production: SQLite's databases in memory lock whole tables among threads."""
    if environment().is_postgresql:
        return
    settings.DATABASES["default"]["TEST"]["NAME"] = str(tmp_path_factory.mktemp("database") / "test.sqlite3")


@pytest.fixture(scope="session")
def django_db_setup(django_db_setup, django_db_blocker):
    """Servers that tests start get a copy of the new database."""
    with django_db_blocker.unblock():
        emptied.begin()
        migrated.take_sqlite(connections["default"])


@pytest.fixture(scope="session")
def warm_postgresql():
    """A PostgreSQL for all tests that do not end it."""
    with migrated.warm_postgresql() as server:
        yield server


@pytest.fixture
def database_url(warm_postgresql):
    """The URL of a PostgreSQL database with all tables."""
    with warm_postgresql.database_url() as url:
        yield url


@pytest.fixture(autouse=True)
def _the_local_user():
    """Each test has a database, and so a local user, of its own."""
    the_local_user.cache_clear()


@pytest.fixture(autouse=True)
def _handlers_end(monkeypatch):
    """The threads of a handler keep one connection each, and PostgreSQL drops no database that is in use."""
    made, make = [], ThreadedHandler.__init__

    def made_and_noted(handler, *args, **kwargs):
        make(handler, *args, **kwargs)
        made.append(handler)

    monkeypatch.setattr(ThreadedHandler, "__init__", made_and_noted)
    yield
    for handler in made:
        asyncio.run(_without_connections(handler.threads))
        handler.threads.end()


async def _without_connections(threads):
    number = len(threads._threads)
    together = threading.Barrier(number)  # so that each thread gets one task

    def close():
        together.wait()
        connections.close_all()

    loop = asyncio.get_running_loop()
    await asyncio.gather(*(threads.run(loop, close) for _ in range(number)))


@pytest.fixture
def api(db):
    return Api()


@pytest.fixture
def user(db):
    return local_user()


@pytest.fixture
def project(api):
    return api.post("projects", {"name": "Robot"}, expect=201)


@pytest.fixture
def settings_of(monkeypatch):
    """Sets `BT_STUDIO_…` variables for one test."""

    def change(**values):
        for name, value in values.items():
            monkeypatch.setenv(f"BT_STUDIO_{name.upper()}", str(value))
        environment.cache_clear()
        scratch.cache_clear()
        readers.cache_clear()
        messages.cache_clear()

    yield change
    environment.cache_clear()
    scratch.cache_clear()
    readers.cache_clear()
    messages.cache_clear()


@pytest.fixture(scope="session")
def warm_bucket():
    with bucket() as made:
        yield made


@pytest.fixture
def objects(warm_bucket, settings_of):
    """A real object store, which is set, with an empty bucket."""
    warm_bucket.fresh()
    settings_of(**warm_bucket.settings)
    kept_stored.clear()
    return warm_bucket
