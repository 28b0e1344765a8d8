"""Links that grant a right, signed with the server's key.

A copy of the database is not enough to make such a link.
"""

from __future__ import annotations

from typing import Final
from uuid import UUID

from django.core.signing import BadSignature, Signer

from backend.config.environment import environment

MAX_TOKEN: Final = 120


def token_of(kind: str, identity: UUID) -> str:
    """Returns the secret part of the link of an invitation (`join`) or of a project (`shared`)."""
    return Signer(salt=f"bt-studio {kind}", sep=".").sign(identity.hex)


def identity_of(kind: str, token: str) -> UUID | None:
    """Returns the id of the row that a link names, or None if this server did not sign it."""
    if len(token) > MAX_TOKEN:
        return None
    try:
        return UUID(hex=Signer(salt=f"bt-studio {kind}", sep=".").unsign(token))
    except (BadSignature, ValueError):
        return None


def link_of(kind: str, identity: UUID) -> str:
    """Returns the complete URL of the link."""
    return f"{environment().public_url}/{kind}/{token_of(kind, identity)}"
