"""Reads of stored runs."""

from __future__ import annotations

import pytest

from backend.core.problems import NotFoundError
from backend.projects.sharing import memberships
from backend.runs import queries, writes
from backend.runs.models import Run
from tests.backend.runs.conftest import SAMPLE, keep

pytestmark = pytest.mark.usefixtures("manager")


def body(response):
    return response.getvalue()


def test_parts_join_at_their_borders(people, monkeypatch):
    """A recording of several parts is the same at each of their borders."""
    monkeypatch.setattr(writes, "PART_BYTES", 1000)
    monkeypatch.setattr("backend.runs.queries.PART_BYTES", 1000)
    run = keep(people.owner, people.project).json()
    address = f"/api/v1/projects/{people.project.id}/runs/{run['id']}/recording"
    for begin, end in ((0, 1000), (999, 1001), (1000, 3000), (1500, 1501), (0, len(SAMPLE))):
        part = people.owner.client.get(address, headers={"Range": f"bytes={begin}-{end - 1}"})
        assert body(part) == SAMPLE[begin:end]


def test_a_run_belongs_to_its_project_and_to_those_who_may_see_it(people):
    run = Run.objects.get(id=keep(people.editor, people.project).json()["id"])
    assert queries.run(people.project.id, run.id, user=people.owner.user) == run
    for user in (people.viewer.user, people.other.user):
        with pytest.raises(NotFoundError):
            queries.run(people.project.id, run.id, user=user)


def test_a_keeper_who_lost_the_project_sees_the_run_no_more(people):
    run = keep(people.editor, people.project).json()
    memberships.unshare_with_person(people.project.id, "editor", acting_user=people.owner.user)
    with pytest.raises(NotFoundError):
        queries.run(people.project.id, run["id"], user=people.editor.user)


def test_room_shrinks_with_each_kept_run(people):
    before = queries.room(people.owner.user)
    keep(people.owner, people.project)
    assert before - queries.room(people.owner.user) == len(SAMPLE)
    assert queries.room(people.editor.user) == before


def test_keeper_and_owner_manage_a_run(people):
    run = keep(people.viewer, people.project).json()
    for person in (people.viewer, people.owner):
        found = queries.run(people.project.id, run["id"], user=person.user)
        assert queries.may_manage(found, user=person.user)
    Run.objects.update(is_shared=True)
    found = queries.run(people.project.id, run["id"], user=people.editor.user)
    assert not queries.may_manage(found, user=people.editor.user)
