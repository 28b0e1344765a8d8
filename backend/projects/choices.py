"""Closed sets of this app."""

from __future__ import annotations

from enum import IntEnum


class Role(IntEnum):
    """The rights of a user in a project; each role includes the ones below it."""

    NONE = 0
    VIEWER = 1
    EDITOR = 2
    OWNER = 3

    @property
    def label(self) -> str:
        """The name that the API and the database's forms show."""
        return self.name.lower()


SHARED_ROLES = (Role.VIEWER, Role.EDITOR)
