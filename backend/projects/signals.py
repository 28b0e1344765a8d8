"""Signals that projects send to other apps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from django.dispatch import Signal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


class MoreData(NamedTuple):
    """Data of a user that another app stores.

    Attributes:
        document: fields of `account.json`.
        files: paths in the zip, each with a function that yields the bytes.
    """

    document: dict[str, Any]
    files: list[tuple[str, Callable[[], Iterable[bytes]]]]


project_deleted = Signal()
"""Sent with `project_id` when the deletion of a project is committed."""

revision_made = Signal()
"""Sent with `change`, a `ChangeSet`, in its transaction."""

usage_asked = Signal()
"""Sent with `user`. Receivers return more fields of the answer of `/me/usage`, as a dict of numbers."""

data_asked = Signal()
"""Sent with `user`. Receivers return a `MoreData` for the zip with all data of the user."""
