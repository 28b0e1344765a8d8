"""The space that users take."""

from __future__ import annotations

import pytest

from backend.projects.errors import QuotaExceededError
from backend.projects.storage.usage import room_for_archive, usage, usage_of_all


def test_the_bytes_of_projects_are_counted(project, user):
    found = usage(user)
    assert found["projects"] == 1
    assert found["bytes"] > 0
    assert room_for_archive(user) == found["max_bytes"] - found["bytes"]
    assert [row.used for row in usage_of_all()] == [found["bytes"]]


def test_without_room_nothing_is_imported(project, user):
    for field, value in (("max_projects", 1), ("max_bytes", 1)):
        user.max_projects, user.max_bytes = 10, None
        setattr(user, field, value)
        with pytest.raises(QuotaExceededError):
            room_for_archive(user)
