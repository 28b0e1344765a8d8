"""Rights in a project."""

from __future__ import annotations

import pytest

from backend.core.problems import NotFoundError
from backend.projects.storage import queries
from backend.projects.storage.access import Need, RoleTooLowError
from tests.backend.accounts.conftest import person, team  # noqa: F401 - fixtures
from tests.backend.accounts.test_sharing import project_of


def test_a_stranger_finds_nothing_and_a_viewer_only_reads(person):  # noqa: F811
    olga, fred = person("olga"), person("fred")
    one = project_of(olga)
    with pytest.raises(NotFoundError):
        queries.project(one, user=fred.user, need=Need.READ)
    olga.post(f"projects/{one}/shares", {"name": "fred", "role": "viewer"})
    assert queries.project(one, user=fred.user, need=Need.READ)
    with pytest.raises(RoleTooLowError):
        queries.project(one, user=fred.user, need=Need.WRITE)
