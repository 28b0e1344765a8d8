"""Roles in a project."""

from __future__ import annotations

from backend.projects.choices import SHARED_ROLES, Role


def test_a_role_includes_those_below_it() -> None:
    assert sorted(Role) == [Role.NONE, Role.VIEWER, Role.EDITOR, Role.OWNER]
    assert [role.label for role in SHARED_ROLES] == ["viewer", "editor"]
