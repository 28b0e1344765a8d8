"""The evaluations of a user in the zip of all their data."""

from __future__ import annotations

import json
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from django.core.serializers.json import DjangoJSONEncoder

from backend.evaluations import queries
from backend.evaluations.models import Evaluation
from backend.projects.signals import MoreData

if TYPE_CHECKING:
    from collections.abc import Iterator

    from backend.accounts.models import User

__all__ = ["data_of"]

_FIELDS: Final = ("project__name", "name", "revision", "older", "state", "results", "created_at", "ended_at")


def data_of(sender: object, *, user: User, **_: object) -> MoreData:
    """Returns the evaluations that the user has started, each with its `runs.jsonl`."""
    rows = Evaluation.objects.filter(user=user).order_by("created_at", "id")
    values = list(rows.values(*_FIELDS))
    document: dict[str, Any] = {"evaluations": json.loads(json.dumps(values, cls=DjangoJSONEncoder))}
    files = [
        (f"evaluations/{found.id}/revision-{revision}.jsonl", partial(_lines, found, revision))
        for found in rows.defer("plan")
        for revision in [found.revision, *([] if found.older is None else [found.older])]
    ]
    return MoreData(document, list(files))


def _lines(found: Evaluation, revision: int) -> Iterator[bytes]:
    for line in queries.lines(found, revision):
        yield line.encode() + b"\n"
