"""Finds the user of a request, or of a socket, by the browser's session."""

from __future__ import annotations

from functools import lru_cache
from importlib import import_module
from threading import Lock
from typing import TYPE_CHECKING, Any, Final
from uuid import UUID

from cachetools import LRUCache
from django.conf import settings
from django.contrib.auth import HASH_SESSION_KEY, SESSION_KEY, get_user
from django.contrib.sessions.models import Session
from django.db import connection
from django.http import HttpRequest
from django.utils import timezone
from django.utils.crypto import constant_time_compare

from backend.accounts.models import User
from backend.accounts.writes import local_user
from backend.config.environment import environment

if TYPE_CHECKING:
    from collections.abc import Mapping

LINKS: Final = "links"
"""The key in the session for opened read-only links: the ids of the links by the ids of their projects."""
MOST_SEEN: Final = 4096

seen_users: Final[LRUCache[str, int]] = LRUCache(MOST_SEEN)
_lock: Final = Lock()


def identify(cookies: Mapping[str, str]) -> User | None:
    """Returns the user of a request: the local user, the signed-in user, a guest with a link, or None.

    Session and user are read from the database at each request, so that a revoked right ends immediately. The
    process caches only the user id of each session, to read both in one query.
    """
    if not environment().is_team:
        return the_local_user()
    key = cookies.get(settings.SESSION_COOKIE_NAME)
    if not key:
        return None
    user = _read_at_once(key, last_seen(cookies)) or _read(key)
    if user is not None and not user.is_guest:
        with _lock:
            seen_users[key] = user.pk
    return user


def _read(key: str) -> User | None:
    """Returns the user of a session in the same way as Django, with two queries; None if there is none."""
    request = HttpRequest()
    request.session = _store()(key)
    links = _links(request.session)
    found = get_user(request)
    user = found if isinstance(found, User) else User(is_active=False) if links else None
    if user is not None:
        user.links = links
    return user


def _read_at_once(key: str, user_id: int | None) -> User | None:
    """Returns the user of a session with one query, if the session still belongs to `user_id`.

    Otherwise calls `_read`.
    """
    if user_id is None:
        return None
    now = connection.ops.adapt_datetimefield_value(timezone.now())
    user: Any = next(iter(User.objects.raw(_together(), [key, now, user_id])), None)
    if user is None or not user.is_active:
        return None
    session = _store()().decode(user.session_data)
    is_theirs = session.get(SESSION_KEY) == str(user.pk) and constant_time_compare(
        session.get(HASH_SESSION_KEY, ""), user.get_session_auth_hash()
    )
    if not is_theirs:
        return None
    user.links = _links(session)
    found: User = user
    return found


@lru_cache(maxsize=1)
def _together() -> str:
    session, user = (connection.ops.quote_name(model._meta.db_table) for model in (Session, User))
    return (
        f"SELECT {user}.*, {session}.session_data FROM {session}, {user} "  # noqa: S608 - names of ours alone
        f"WHERE {session}.session_key = %s AND {session}.expire_date > %s AND {user}.id = %s"
    )


@lru_cache(maxsize=1)
def _store() -> Any:
    return import_module(settings.SESSION_ENGINE).SessionStore


def last_seen(cookies: Mapping[str, str]) -> int | None:
    """Returns the id of the user whom these cookies last identified in this process, or None.

    The id grants no right.
    """
    with _lock:
        return seen_users.get(cookies.get(settings.SESSION_COOKIE_NAME, ""))


@lru_cache(maxsize=1)
def the_local_user() -> User:
    """Returns the only user on localhost. The user never changes, and so is read once."""
    return local_user()


def _links(session: Any) -> frozenset[UUID]:
    return frozenset(UUID(link) for link in session.get(LINKS, {}).values())
