"""Who asks, by the session that a browser shows; for the API and for sockets alike."""

from __future__ import annotations

from functools import lru_cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final
from uuid import UUID

from django.conf import settings
from django.contrib.auth import get_user
from django.http import HttpRequest

from backend.accounts.actions import local_user
from backend.accounts.models import User
from backend.config.environment import environment

if TYPE_CHECKING:
    from collections.abc import Mapping

LINKS: Final = "links"
"""Where a session keeps the read-only links that were opened: ids of links by ids of projects."""


def identify(cookies: Mapping[str, str]) -> User | None:
    """The local user, whoever is signed in, a guest with a link, or nobody."""
    if not environment().is_team:
        return the_local_user()
    key = cookies.get(settings.SESSION_COOKIE_NAME)
    if not key:
        return None
    request = HttpRequest()
    request.session = import_module(settings.SESSION_ENGINE).SessionStore(key)
    links = _links(request.session)
    found = get_user(request)
    user = found if isinstance(found, User) else User(is_active=False) if links else None
    if user is not None:
        user.links = links
    return user


@lru_cache(maxsize=1)
def the_local_user() -> User:
    """On localhost nobody can change the one user, so one look is enough."""
    return local_user()


def _links(session: Any) -> frozenset[UUID]:
    return frozenset(UUID(link) for link in session.get(LINKS, {}).values())
