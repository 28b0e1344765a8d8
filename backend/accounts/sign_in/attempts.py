"""Counts wrong passwords, to slow down attackers without locking out the users.

A browser in which a user has signed in is *known* to that account, by a signed cookie. It has a count of its
own, so its user can sign in even if others fail often. For other browsers, failures are counted three times:
by account and address together; by account, against many machines that guess one password; and by address,
against one machine that tries a password on many accounts. The last limit is so large that the typing errors
of a class behind one address do not reach it.
"""

from __future__ import annotations

import hashlib
import secrets
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from django.conf import settings
from django.core.cache import cache
from django.core.signing import BadSignature, TimestampSigner

from backend.core.clients import network_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from django.http import HttpRequest, HttpResponse

KNOWN_DAYS: Final = 180
KNOWN_ACCOUNTS: Final = 12
"""The largest number of accounts to which one browser is known, as in a laboratory."""
COOKIE: Final = "bt_studio_browser"
MINUTE_S: Final = 60


class Bound(NamedTuple):
    """A limit of failures in a period; the period is in seconds."""

    key: str
    most: int
    window_s: int


@dataclass(frozen=True, slots=True)
class Browser:
    """A browser in which a user has signed in.

    Attributes:
        identity: a random id, made at the first sign-in.
        accounts: the keys of the accounts, in order of sign-in.
    """

    identity: str
    accounts: tuple[int, ...] = ()

    def with_account(self, account: int) -> Browser:
        """Returns the same browser, known to one more account."""
        others = [each for each in self.accounts if each != account]
        return Browser(self.identity, (*others, account)[-KNOWN_ACCOUNTS:])


def bounds(account: int | str, address: str | None, browser: Browser | None) -> tuple[Bound, ...]:
    """Returns the limits of the next attempt to sign in.

    `account` is the key of the account, or the typed name.
    """
    if browser is not None and account in browser.accounts:
        return (Bound(f"browser {browser.identity} {account}", 10, 5 * MINUTE_S),)
    place = network_of(address)
    return (
        Bound(f"place {account} {place}", 5, 5 * MINUTE_S),
        Bound(f"account {account}", 50, 60 * MINUTE_S),
        Bound(f"address {place}", 300, 10 * MINUTE_S),
    )


class Attempt:
    """One attempt to sign in.

    It counts as failed until it succeeds, so that simultaneous attempts count, too.
    """

    def __init__(self, limits: Iterable[Bound]) -> None:
        self._keys = [(_cache_key(limit.key), limit) for limit in limits]
        self.is_allowed = True
        self._counted: list[str] = []
        for key, limit in self._keys:
            cache.add(key, 0, limit.window_s)
            if _more(key, 1) > limit.most:
                self.is_allowed = False
            self._counted.append(key)
        if not self.is_allowed:
            self.take_back()

    def take_back(self) -> None:
        """Removes the attempt from the counts, since it succeeded or was refused before the check."""
        for key in self._counted:
            _more(key, -1)
        self._counted = []


def forget(limits: Iterable[Bound]) -> None:
    """Resets the counts of an account that has a new password."""
    cache.delete_many([_cache_key(limit.key) for limit in limits])


def _more(key: str, number: int) -> int:
    try:
        return int(cache.incr(key, number))
    except ValueError:  # the count has just expired
        return max(number, 0)


def _cache_key(key: str) -> str:
    return f"sign-in-{hashlib.sha256(key.encode()).hexdigest()}"


def _signer() -> TimestampSigner:
    return TimestampSigner(salt="bt-studio browser")


def _cookie_name() -> str:
    return ("__Host-" if settings.ENVIRONMENT.is_https else "") + COOKIE


def browser_of(request: HttpRequest) -> Browser | None:
    """Returns the browser that sent a request, if a user has signed in there; otherwise None."""
    try:
        found: Any = _signer().unsign_object(
            request.COOKIES.get(_cookie_name(), ""), max_age=KNOWN_DAYS * 24 * 3600
        )
        return Browser(str(found["id"]), tuple(int(account) for account in found["accounts"]))
    except (BadSignature, ValueError, KeyError, TypeError):
        return None


def remember(request: HttpRequest, response: HttpResponse, account: int) -> None:
    """Marks the browser as known to the account that signed in."""
    browser = (browser_of(request) or Browser(secrets.token_urlsafe(16))).with_account(account)
    value = _signer().sign_object({"id": browser.identity, "accounts": list(browser.accounts)})
    response.set_cookie(
        _cookie_name(),
        value,
        max_age=KNOWN_DAYS * 24 * 3600,
        httponly=True,
        secure=settings.ENVIRONMENT.is_https,
        samesite="Lax",
    )
