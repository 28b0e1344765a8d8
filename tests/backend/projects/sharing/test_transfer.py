"""A project gets another owner."""

from __future__ import annotations

import pytest

from backend.core.problems import InvalidInputError
from backend.projects.models import Project
from backend.projects.sharing.transfer import transfer_project
from tests.backend.accounts.conftest import person, team  # noqa: F401 - fixtures
from tests.backend.accounts.test_sharing import project_of


def test_an_editor_becomes_the_owner_and_the_owner_an_editor(person):  # noqa: F811
    olga, fred = person("olga"), person("fred")
    one = project_of(olga)
    with pytest.raises(InvalidInputError, match="not an editor"):
        transfer_project(one, "fred", acting_user=olga.user)
    olga.post(f"projects/{one}/shares", {"name": "fred", "role": "editor"})
    transfer_project(one, "fred", acting_user=olga.user)
    assert Project.objects.get(pk=one).owner == fred.user
    assert olga.get(f"projects/{one}")["role"] == "editor"
