"""Rights in a project."""

from __future__ import annotations

import pytest

from backend.core.problems import NotFoundError
from backend.projects.storage import access, queries
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


def test_a_list_finds_the_roles_in_all_projects_of_others_with_one_query(
    person,  # noqa: F811
    django_assert_num_queries,
):
    olga, fred = person("olga"), person("fred")
    for role in ("viewer", "editor"):
        olga.post(f"projects/{project_of(olga, role)}/shares", {"name": "fred", "role": role})
    project_of(fred)
    with django_assert_num_queries(2):
        page, total = queries.page(queries.projects(user=fred.user, sort="created_at"), 0, 9, user=fred.user)
    assert ([row.role.label for row in page], total) == (["viewer", "editor", "owner"], 3)
    with django_assert_num_queries(1):
        queries.page(queries.projects(user=olga.user), 0, 9, user=olga.user)


def test_a_project_that_is_no_longer_shared_after_it_was_listed_is_left_out(person, monkeypatch):  # noqa: F811
    olga, fred = person("olga"), person("fred")
    one = project_of(olga)
    olga.post(f"projects/{one}/shares", {"name": "fred", "role": "viewer"})
    find_roles = access.find_roles

    def revoked_meanwhile(*listed):
        olga.delete(f"projects/{one}/shares/people/fred")
        find_roles(*listed)

    monkeypatch.setattr(access, "find_roles", revoked_meanwhile)
    assert queries.page(queries.projects(user=fred.user), 0, 9, user=fred.user)[0] == []
