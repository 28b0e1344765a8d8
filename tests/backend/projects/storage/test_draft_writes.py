"""Drafts."""

from __future__ import annotations

import pytest

from backend.projects.errors import PreconditionFailedError, QuotaExceededError
from backend.projects.storage import queries
from backend.projects.storage.access import Need
from backend.projects.storage.draft_writes import discard_draft, save_draft


def test_a_draft_is_one_users_and_is_discarded(project, user):
    row = queries.project(project["id"], user=user, need=Need.READ)
    save_draft(project["id"], "a.txt", base_revision=0, content="half", acting_user=user)
    assert [draft.path for draft in queries.drafts(row, user=user)] == ["a.txt"]
    with pytest.raises(PreconditionFailedError):
        discard_draft(project["id"], "a.txt", acting_user=user, if_match='"other"')
    discard_draft(project["id"], "a.txt", acting_user=user)
    assert queries.drafts(row, user=user) == []


def test_all_drafts_of_a_user_are_no_larger_than_a_file(project, user, settings_of):
    settings_of(max_file_bytes=10)
    for content in ("x" * 6, "y" * 7):  # the second one replaces the first
        save_draft(project["id"], "a.txt", base_revision=0, content=content, acting_user=user)
    save_draft(project["id"], "b.txt", base_revision=0, content="z" * 3, acting_user=user)
    with pytest.raises(QuotaExceededError, match="unsaved texts"):
        save_draft(project["id"], "c.txt", base_revision=0, content="z", acting_user=user)
