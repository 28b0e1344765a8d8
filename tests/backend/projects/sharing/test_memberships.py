"""Shares of a project."""

from __future__ import annotations

from backend.projects.models import Project
from backend.projects.sharing.memberships import etag, shares
from tests.backend.accounts.conftest import person, team  # noqa: F401 - fixtures
from tests.backend.accounts.test_sharing import project_of


def test_people_and_links_are_listed_with_a_tag_of_their_own(person):  # noqa: F811
    olga = person("olga")
    person("fred")
    one = project_of(olga)
    project = Project.objects.get(pk=one)
    before = etag(shares(project))
    olga.post(f"projects/{one}/shares", {"name": "fred", "role": "viewer"})
    olga.post(f"projects/{one}/shares/links", {}, expect=201)
    after = shares(project)
    assert [row["role"] for row in after["people"]] == ["viewer"]
    assert len(after["links"]) == 1
    assert etag(after) != before
