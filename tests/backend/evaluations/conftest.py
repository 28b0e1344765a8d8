"""A team that evaluates a project; nothing runs unless a test makes it."""

from __future__ import annotations

import json
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
from django.utils import timezone

from backend.evaluations import writes
from backend.evaluations.executor_events import Begun, Done, read_line
from backend.projects.choices import Role
from backend.projects.sharing import memberships
from backend.projects.storage import writes as projects
from backend.sessions.models import Session
from backend.workers.aside import sweeps
from tests.backend.accounts.conftest import person, stranger, team  # noqa: F401

if TYPE_CHECKING:
    from backend.evaluations.models import Evaluation

ROOM = b"format: bt-studio/evaluation\nversion: 1\nduration_s: 5\nruns: 4\n"


def line(seed: int, outcome: str = "success", margin: float = 0.5, **more: Any) -> str:
    item = {"item": "never collision", "holds": outcome == "success", "margin": margin, "unit": "m"}
    about = {"why": "so", "end_s": 2.5, "items": [item], "measures": {"path_length_m": float(seed)}}
    return json.dumps({"seed": seed, "outcome": outcome, **about, **more})


def done(seed: int, outcome: str = "success", number: int = 1, wanted: int = 4) -> Done:
    text = line(seed, outcome)
    return Done("a1", seed, text, 3.0, number, wanted, 1.0, 0.2, 1.0, 9.0)


def begin(found: Evaluation, wanted: int = 4, **more: Any) -> None:
    sequential, notes = more.pop("sequential", False), more.pop("notes", "")
    writes.begun(found, Begun("a1", 2, 0, wanted, sequential, 5.0, {"outlines": []}, notes))


def store(found: Evaluation, *told: Done, revision: int | None = None) -> bool:
    return writes.store(found, revision or found.revision, [(each, read_line(each)) for each in told])


def wish(people: Any, by: str = "owner", name: str = "room", runs: int = 0) -> Evaluation:
    return writes.start(people.project.id, name, runs, acting_user=getattr(people, by).user)


def session_for(people: Any, by: str = "owner", **more: Any) -> Session:
    own = {"project": people.project, "user": getattr(people, by).user, "created_at": timezone.now()}
    return Session.objects.create(**{"kind": "evaluation", "state": "ready", **own, **more})


@pytest.fixture
def people(person, monkeypatch) -> Any:  # noqa: F811
    """An owner, an editor, a viewer and another user, and the owner's project as `project`."""
    monkeypatch.setattr(sweeps, "ask", lambda *_: None)
    found = {name: person(name) for name in ("owner", "editor", "viewer", "other")}
    owner = found["owner"].user
    files = {"evaluations/room.yaml": ROOM, "universes/own.yaml": b"old", "trees/MainTree.json": b"{}"}
    project = projects.create_project(files, acting_user=owner, name="Robot")
    memberships.share_with_person(project.id, "editor", Role.EDITOR, acting_user=owner)
    memberships.share_with_person(project.id, "viewer", Role.VIEWER, acting_user=owner)
    return SimpleNamespace(project=project, **found)
