"""Enumerations of projects."""

from __future__ import annotations

from enum import IntEnum


class Role(IntEnum):
    """The role of a user in a project; each role includes the rights of the lower ones."""

    NONE = 0
    VIEWER = 1
    EDITOR = 2
    OWNER = 3

    @property
    def label(self) -> str:
        """The name of the role in the API and in the administration."""
        return self.name.lower()


SHARED_ROLES = (Role.VIEWER, Role.EDITOR)
