"""Stored runs as JSON."""

from __future__ import annotations

import pytest

from backend.runs import queries
from backend.runs.serializers import RunSerializer, presented
from tests.backend.runs.conftest import keep


@pytest.mark.usefixtures("manager")
def test_a_run_has_all_fields_of_its_schema(people):
    run = keep(people.owner, people.project).json()
    found = queries.run(people.project.id, run["id"], user=people.owner.user)
    assert presented(found, people.owner.user) == run
    assert set(run) == set(RunSerializer().fields)
