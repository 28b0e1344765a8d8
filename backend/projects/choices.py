"""Closed sets of this app."""

from __future__ import annotations

from enum import IntEnum


class Role(IntEnum):
    """What a user may do with a project; each role may all that the ones below it may."""

    NONE = 0
    VIEWER = 1
    EDITOR = 2
    OWNER = 3

    @property
    def label(self) -> str:
        """The name that the API and the database's forms show."""
        return self.name.lower()


SHARED_ROLES = (Role.VIEWER, Role.EDITOR)
