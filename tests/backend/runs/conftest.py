"""A team whose members run a project, with a manager that gives a real recording."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from backend.projects.choices import Role
from backend.projects.sharing import memberships
from backend.projects.storage import writes as projects
from backend.runs import writes
from backend.sessions.choices import SessionState
from tests.backend.accounts.conftest import person, stranger, team  # noqa: F401
from tests.fakes.recordings import TOKEN, recordings

if TYPE_CHECKING:
    from collections.abc import Iterator

SAMPLE = (Path(__file__).parents[2] / "executor" / "recorder" / "samples" / "v1.mcap").read_bytes()


@pytest.fixture
def people(person) -> Any:  # noqa: F811
    """Returns an owner, an editor, a viewer and another user, and the owner's project as `project`."""
    found = {name: person(name) for name in ("owner", "editor", "viewer", "other")}
    owner = found["owner"].user
    project = projects.create_project({}, acting_user=owner, name="Robot")
    memberships.share_with_person(project.id, "editor", Role.EDITOR, acting_user=owner)
    memberships.share_with_person(project.id, "viewer", Role.VIEWER, acting_user=owner)
    return SimpleNamespace(project=project, **found)


@pytest.fixture
def manager(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Gives every user a session. Its manager records the sample, as the run `a1`."""
    with recordings(SAMPLE) as address:
        session = SimpleNamespace(address=address, state=SessionState.READY)
        monkeypatch.setattr(writes, "live_session", lambda *_, **__: session)
        monkeypatch.setattr(writes, "manager_token", lambda _: TOKEN)
        yield


def keep(by: Any, project: Any, **more: Any) -> Any:
    """Keeps the run `a1`; returns the answer."""
    address = f"/api/v1/projects/{project.id}/runs"
    return by.client.post(address, data={"run": "a1", "name": "Kept"} | more, content_type="application/json")
