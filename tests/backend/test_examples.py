"""The examples of the OpenAPI document are a server's answers; BT_STUDIO_RECORD=1 records them again."""

from __future__ import annotations

import json
import os
from types import SimpleNamespace

import jsonschema
import pytest

from backend.config import examples
from backend.config.schema_view import document
from backend.evaluations import views
from backend.imports import runner
from backend.imports import views as imports
from backend.language import behaviours, ruff
from backend.language import views as language
from backend.runs import logs, views_mine
from backend.runs import writes as run_writes
from backend.sessions.choices import SessionState
from backend.sessions.lifecycle import attaching
from backend.sessions.lifecycle import writes as session_writes
from tests.backend.accounts.conftest import PUBLIC, Person, person, stranger, team  # noqa: F401
from tests.backend.runs.conftest import SAMPLE
from tests.backend.story import Story, play
from tests.fakes.recordings import TOKEN, recordings


@pytest.fixture
def manager():
    with recordings(SAMPLE) as address:
        yield SimpleNamespace(address=address, state=SessionState.READY)


@pytest.fixture
def told(person, stranger, manager, monkeypatch):  # noqa: F811
    monkeypatch.setattr(session_writes, "workers", type("Idle", (), {"submit": lambda *_: None}))
    monkeypatch.setattr(attaching, "may_attach", lambda: True)
    monkeypatch.setattr(run_writes, "live_session", lambda *_, **__: manager)
    monkeypatch.setattr(run_writes, "manager_token", lambda _: TOKEN)
    monkeypatch.setattr(views, "round_soon", lambda: None)
    # A team's server reads logs and checks Python in containers.
    for module in (logs, views_mine):
        monkeypatch.setattr(module, "require_converter", lambda: None)
    monkeypatch.setattr(imports, "runner", lambda user: runner.run_beside)
    monkeypatch.setattr(language, "checker", lambda user: ruff.run_beside)
    monkeypatch.setattr(language, "runner", lambda user: behaviours.run_beside)
    teacher, student = person("tina", is_teacher=True), person("ben")

    def guest(url):
        browser = Person()
        assert browser.page(url.partition(PUBLIC)[2]).status_code == 302
        return browser

    story = Story(document())
    play(story, teacher, student, stranger, guest)
    return story.told


def operations():
    return {
        operation["operationId"]: operation
        for methods in document()["paths"].values()
        for operation in methods.values()
    }


def test_the_story_meets_every_endpoint_and_is_answered_as_the_examples_show(told):
    if os.environ.get("BT_STUDIO_RECORD") == "1":
        text = json.dumps(dict(sorted(told.items())), ensure_ascii=False, indent=1)
        examples.RECORDED.write_text(text + "\n", encoding="utf-8")
        examples.recorded.cache_clear()
        document.cache_clear()
    assert set(told) == set(operations())
    assert {name: shape(row) for name, row in examples.recorded().items()} == {
        name: shape(row) for name, row in told.items()
    }, "run BT_STUDIO_RECORD=1 pytest tests/backend/test_examples.py, then python -m backend.config.reference"


def shape(value):
    """Returns the names of the members; texts and numbers may differ."""
    if isinstance(value, dict):
        return {key: shape(inner) for key, inner in value.items()}
    return [shape(inner) for inner in value] if isinstance(value, list) else None


def test_every_operation_with_json_shows_an_example_that_its_schema_admits():
    components = document()["components"]
    for name, operation in operations().items():
        bodies = [*operation["responses"].values(), operation.get("requestBody", {})]
        for body in bodies:
            for kind, media in body.get("content", {}).items():
                if kind != "application/json":
                    continue
                assert "examples" in media, f"{name} shows no example"
                schema = media["schema"] | {"components": components}
                jsonschema.validate(media["examples"]["usual"]["value"], schema)
