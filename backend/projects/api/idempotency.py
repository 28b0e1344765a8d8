"""`Idempotency-Key`: a repeated request takes effect once, and receives its first answer again."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING, Any

from django.db import transaction
from django.utils import timezone
from rest_framework.response import Response

from backend.core.locks import transaction_lock
from backend.core.problems import InvalidInputError
from backend.ingress.bodies import body_of
from backend.projects.errors import IdempotencyError
from backend.projects.models import IdempotencyKey

if TYPE_CHECKING:
    from collections.abc import Callable

    from rest_framework.request import Request

    from backend.accounts.models import User

HEADER = "Idempotency-Key"
MAX_KEY = 100
PART = 1024 * 1024


def once(request: Request, user: User, effect: Callable[[], Response]) -> Response:
    """Returns the stored answer if the request's key is known.

    Otherwise calls `effect` and stores its answer, in one transaction.
    """
    key = _key(request)
    if not key:
        return effect()
    fingerprint = _fingerprint(request)
    with transaction.atomic():
        transaction_lock(f"key {user.pk} {key}")
        known = _known(user, key, fingerprint)
        if known is not None:
            return known
        response = effect()
        answer: Any = response.data
        IdempotencyKey.objects.create(
            author=user,
            key=key,
            fingerprint=fingerprint,
            status=response.status_code,
            answer=answer,
            created_at=timezone.now(),
        )
        return response


def replayed(request: Request, user: User) -> Response | None:
    """Returns the stored answer if the request's key is known, before any work for it; otherwise None."""
    key = _key(request)
    return _known(user, key, _fingerprint(request)) if key else None


def _key(request: Request) -> str:
    key = request.headers.get(HEADER, "")
    if len(key) > MAX_KEY or not key.isprintable():
        raise InvalidInputError(f"An idempotency key has at most {MAX_KEY} visible characters.", field=HEADER)
    return key


def _known(user: User, key: str, fingerprint: str) -> Response | None:
    known = IdempotencyKey.objects.filter(author=user, key=key).first()
    if known is None:
        return None
    if known.fingerprint != fingerprint:
        raise IdempotencyError("This key belongs to another request.", hint="Use a new key.", field=HEADER)
    return Response(known.answer, status=known.status, headers={"Idempotency-Replayed": "true"})


def _fingerprint(request: Request) -> str:
    digest = hashlib.sha256(f"{request.method} {request.get_full_path()}\n".encode())
    if request.content_type.startswith("multipart/"):
        for name, uploaded in sorted(request.FILES.items()):
            digest.update(name.encode() + b"\0")
            for chunk in uploaded.chunks():
                digest.update(chunk)
            uploaded.seek(0)
    elif not request.content_type.endswith("json"):
        body = body_of(request)
        body.seek(0)  # the work has read it
        while part := body.read(PART):
            digest.update(part)
        body.seek(0)
    else:
        digest.update(json.dumps(request.data, sort_keys=True).encode())
    return digest.hexdigest()
