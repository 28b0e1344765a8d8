"""Finds the user of a request or a socket by the browser's session."""

from __future__ import annotations

from functools import lru_cache
from importlib import import_module
from threading import Lock
from typing import TYPE_CHECKING, Any, Final, NamedTuple
from uuid import UUID

from django.conf import settings
from django.contrib.auth import HASH_SESSION_KEY, get_user
from django.contrib.sessions.models import Session
from django.db import connection
from django.http import HttpRequest
from django.utils import timezone
from django.utils.crypto import constant_time_compare

from backend.accounts.models import User
from backend.accounts.writes import local_user
from backend.config.environment import environment
from backend.core.instances import columns, instance

if TYPE_CHECKING:
    from collections.abc import Mapping

LINKS: Final = "links"
"""Where a session keeps the read-only links that were opened: ids of links by ids of projects."""


def identify(cookies: Mapping[str, str]) -> User | None:
    """Returns the local user, the user who is signed in, a guest with a link, or None."""
    if not environment().is_team:
        return the_local_user()
    key = cookies.get(settings.SESSION_COOKIE_NAME)
    if not key:
        return None
    return _known_user(key) or _asked_user(key)


def last_seen(cookies: Mapping[str, str]) -> int | None:
    """Returns the account whose cookies these were at the last check; it grants no right."""
    known = _known.get(cookies.get(settings.SESSION_COOKIE_NAME, ""))
    return None if known is None else known.user_id


def _asked_user(key: str) -> User | None:
    request = HttpRequest()
    request.session = import_module(settings.SESSION_ENGINE).SessionStore(key)
    links = _links(request.session)
    found = get_user(request)
    user = found if isinstance(found, User) else User(is_active=False) if links else None
    if user is not None:
        user.links = links
        _remember(key, user, request.session)
    return user


class _Known(NamedTuple):
    """The contents of a session when it was last read."""

    data: str
    user_id: int
    auth_hash: str
    links: frozenset[UUID]


_known: Final[dict[str, _Known]] = {}
_MAX_KNOWN: Final = 4096
_lock: Final = Lock()


def _known_user(key: str) -> User | None:
    """Whose session this is, if it is as it was when it was last read.

    What a session holds is costly to read. That it is there, unchanged, and its user active with the same
    password, is looked up each time, in one query, so that nobody is let in for longer.
    """
    known = _known.get(key)
    if known is None:
        return None
    now = connection.ops.adapt_datetimefield_value(timezone.now())
    with connection.cursor() as cursor:
        cursor.execute(_known_sql(connection.vendor), [key, now, known.user_id])
        row = cursor.fetchone()
    if row is None or row[-1] != known.data:
        return None
    user = instance(User, row)
    if not user.is_active or not constant_time_compare(user.get_session_auth_hash(), known.auth_hash):
        return None
    user.links = known.links
    return user


@lru_cache(maxsize=2)
def _known_sql(vendor: str) -> str:
    session, user = (connection.ops.quote_name(model._meta.db_table) for model in (Session, User))
    return (
        f"SELECT {columns(User)}, {session}.session_data FROM {session}, {user} "  # noqa: S608 - names of ours alone
        f"WHERE {session}.session_key = %s AND {session}.expire_date > %s AND {user}.id = %s"
    )


def _remember(key: str, user: User, session: Any) -> None:
    if user.is_guest:
        return
    data = Session.objects.filter(session_key=key).values_list("session_data", flat=True).first()
    if data is None or session.decode(data) != dict(session.items()):
        return
    with _lock:
        while len(_known) >= _MAX_KNOWN:
            del _known[next(iter(_known))]
        _known[key] = _Known(data, user.pk, session[HASH_SESSION_KEY], user.links)


@lru_cache(maxsize=1)
def the_local_user() -> User:
    """Returns the one user of localhost; looked up once, since nobody can change it."""
    return local_user()


def _links(session: Any) -> frozenset[UUID]:
    return frozenset(UUID(link) for link in session.get(LINKS, {}).values())
