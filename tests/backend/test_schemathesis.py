"""Every operation of the OpenAPI document with generated requests: no 5xx, answers as described."""

from __future__ import annotations

import functools
import json
from pathlib import Path

import hypothesis
import pytest
import schemathesis
from django.core import signals
from django.core.handlers.wsgi import WSGIHandler
from django.db import close_old_connections
from django.utils import timezone
from hypothesis import HealthCheck
from hypothesis import strategies as st
from schemathesis.specs.openapi import checks

from backend.accounts.writes import create_account
from backend.config.schema_view import document
from backend.core import guard
from backend.projects.storage import queries
from backend.projects.storage.access import Need
from backend.projects.storage.writes import create_project
from backend.sessions.lifecycle import attaching, writes
from backend.sessions.models import Session
from tests.backend.accounts.conftest import PUBLIC, Person, team  # noqa: F401 - the fixture of that name
from tests.budget import count

# `tests/backend/config/test_reference.py` shows that the stored document is the current one.
OPENAPI = Path(__file__).parents[2] / "docs" / "reference" / "openapi.json"
OPERATIONS = [
    (path, method)
    for path, methods in json.loads(OPENAPI.read_bytes())["paths"].items()
    for method in methods
]
HEADERS = {"Host": "127.0.0.1:8000", "Authorization": f"Bearer {guard.keys().token}"}
# A refusal of a request that the schema allows must be a problem document: names and revisions have more
# rules than a schema can express.
CHECKS = [
    schemathesis.checks.not_a_server_error,
    checks.status_code_conformance,
    checks.content_type_conformance,
    checks.response_headers_conformance,
    checks.response_schema_conformance,
    checks.unsupported_method,
]


@functools.cache
def schema():
    """The document that the server makes, with its application."""
    found = schemathesis.openapi.from_dict(document())
    found.app = WSGIHandler()
    return found


@pytest.fixture
def one_transaction(monkeypatch):
    """The transaction of the test outlives its requests, and no robot is started."""

    def start(project_id, *, acting_user):
        found = queries.project(project_id, user=acting_user, need=Need.RUN)
        return Session(project=found, user=acting_user, created_at=timezone.now())

    monkeypatch.setattr(writes, "start_session", start)
    monkeypatch.setattr(attaching, "prepare", lambda: None)
    for moment in (signals.request_started, signals.request_finished):
        moment.disconnect(close_old_connections)
    yield
    for moment in (signals.request_started, signals.request_finished):
        moment.connect(close_old_connections)


@pytest.mark.parametrize(("path", "method"), OPERATIONS, ids=[f"{m} {p}" for p, m in OPERATIONS])
def test_operation(path, method, project, one_transaction):
    ask_anything(path, method, project["id"], HEADERS, count("backend_schemathesis"))


@pytest.mark.usefixtures("team", "one_transaction")
def test_every_operation_on_a_server_with_accounts(settings_of, monkeypatch):
    settings_of(expensive_calls_per_minute=10**6)  # in addition to those of `team`
    monkeypatch.setattr(schema(), "app", WSGIHandler())
    teacher = create_account("tea", email="tea@example.org", password="", is_teacher=True)
    browser = Person(teacher).quick().client
    cookies = "; ".join(f"{name}={morsel.value}" for name, morsel in browser.cookies.items())
    headers = {"Host": PUBLIC, "Cookie": cookies}
    for number, (path, method) in enumerate(OPERATIONS):
        project = create_project({}, acting_user=teacher, name=f"Project {number}")
        ask_anything(path, method, str(project.id), headers, count("backend_schemathesis_team"))


def ask_anything(path, method, known_project, headers, times):
    """Sends generated requests of one operation, and checks the answers."""
    operation = schema()[path][method]

    @hypothesis.settings(
        max_examples=times,
        derandomize=True,
        database=None,
        suppress_health_check=list(HealthCheck),
    )
    @hypothesis.given(case=operation.as_strategy(), known=st.booleans())
    def fuzz(case, known):
        if known and "project_id" in (case.path_parameters or {}):
            case.path_parameters["project_id"] = known_project
            if "number" in case.path_parameters:
                case.path_parameters["number"] = 1
        case.call_and_validate(headers=headers, checks=CHECKS)

    fuzz()
