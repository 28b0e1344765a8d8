"""Decides which requests and sockets the server accepts; does no I/O.

On localhost three rules apply, on a server with accounts the first two. They are the same for pages, the API
and sockets:

* The `Host` is a name of this server, so that a foreign page cannot reach it by DNS rebinding (421).
* The `Origin`, if there is one, is the same host, by http or https as users open it (403). Sockets need an
`Origin`, because browsers let every page open them; programs that send the token do not.
* The request has the token, or the cookie that the browser got in exchange for the token (403).

The token is new at each start. The cookie's value is derived from it, so that a stolen cookie does not reveal
the token. The cookie's name contains the port, since browsers share cookies among ports.
"""

from __future__ import annotations

import hashlib
import hmac
import secrets
from dataclasses import dataclass
from functools import lru_cache
from typing import Final
from urllib.parse import urlsplit

from backend.config.environment import environment

LOOPBACK_HOSTS: Final = frozenset({"localhost", "127.0.0.1", "[::1]"})
SAFE_METHODS: Final = frozenset({"GET", "HEAD", "OPTIONS"})
COOKIE_PREFIX: Final = "bt_studio_session"
LINK_HINT: Final = (
    "Open the link that `bt-studio serve` printed in the terminal: "
    "it ends in /?token=… and is new at each start."
)


@dataclass(frozen=True, slots=True)
class Facts:
    """The facts about a request, or about the opening of a socket, by which the guard decides."""

    method: str
    host: str
    schemes: tuple[str, ...] = ("http",)
    origin: str | None = None
    fetch_site: str | None = None
    cookie: str | None = None
    bearer: str | None = None
    socket: bool = False


@dataclass(frozen=True, slots=True)
class Refusal:
    """The reason why a request is refused."""

    status: int
    code: str
    detail: str
    hint: str


@dataclass(frozen=True, slots=True)
class Keys:
    """The token of this start of the server, and the cookie value that is derived from it."""

    token: str

    @property
    def cookie_value(self) -> str:
        """The value that a browser's cookie must have."""
        return hmac.new(self.token.encode(), b"bt-studio cookie", hashlib.sha256).hexdigest()

    def is_token(self, candidate: str | None) -> bool:
        """Returns whether the candidate is the token.

        The comparison takes constant time, so that timing reveals nothing.
        """
        return candidate is not None and hmac.compare_digest(candidate.encode(), self.token.encode())

    def is_cookie(self, candidate: str | None) -> bool:
        """Returns whether the candidate is the cookie's value. The comparison takes constant time."""
        return candidate is not None and hmac.compare_digest(candidate.encode(), self.cookie_value.encode())


@lru_cache(maxsize=1)
def keys() -> Keys:
    """Returns the keys of this process. The token comes from the environment, or is random."""
    return Keys(environment().token.get_secret_value() or secrets.token_urlsafe(24))


def host_name(host: str) -> str:
    """Returns the name in a `Host` header, without the port, in lower case."""
    name, _, port = host.rpartition(":")
    return (name if name and port.isdigit() else host).lower()


def cookie_name(host: str) -> str:
    """Returns the name of the cookie for the server that this `Host` header names."""
    _, _, port = host.rpartition(":")
    return f"{COOKIE_PREFIX}_{port}" if port.isdigit() else COOKIE_PREFIX


def judge(
    facts: Facts, keys: Keys, *, extra_hosts: tuple[str, ...] = (), accounts: bool = False
) -> Refusal | None:
    """Returns the reason to refuse the request, or None if it is accepted.

    With `accounts` there is no token to check; the session identifies the user later.
    """
    if refusal := judge_host(facts.host, extra_hosts):
        return refusal
    if accounts:
        return _judge_origin(facts)
    is_program = keys.is_token(facts.bearer)
    if not is_program and (refusal := _judge_origin(facts)):
        return refusal
    if not is_program and not keys.is_cookie(facts.cookie):
        return Refusal(
            403,
            "link_required",
            "This browser has not opened the link of this start of the server.",
            LINK_HINT,
        )
    return None


def judge_host(host: str, extra_hosts: tuple[str, ...]) -> Refusal | None:
    """Returns the reason to refuse a host, or None if it is a name of this server."""
    if host_name(host) in LOOPBACK_HOSTS or host_name(host) in extra_hosts:
        return None
    return Refusal(
        421,
        "host_refused",
        f"This server does not answer for the host “{host[:100]}”.",
        "Open it under its own address, or name the host in BT_STUDIO_ALLOWED_HOSTS.",
    )


def _judge_origin(facts: Facts) -> Refusal | None:
    if facts.origin is None:
        foreign = facts.socket or facts.fetch_site not in {None, "same-origin", "none"}
        is_harmless = facts.method in SAFE_METHODS and not facts.socket
        allowed = is_harmless or not foreign
    else:
        # A GET with a foreign Origin is a cross-origin read. No header of ours allows a page to see the
        # answer.
        own = {f"{scheme}://{facts.host.lower()}" for scheme in facts.schemes}
        allowed = facts.origin.lower() in own
    if allowed:
        return None
    return Refusal(
        403,
        "origin_refused",
        f"A page of {facts.origin or 'another site'} may not use this server."[:200],
        "Use the page that this server itself serves.",
    )


def known_hosts() -> tuple[str, ...]:
    """Returns the host names of this server in addition to those of the loopback interface."""
    settings = environment()
    public = (host_name(settings.public_host),) if settings.public_url else ()
    return public + tuple(host.lower() for host in settings.allowed_hosts)


def schemes_of(host: str, connection: str) -> tuple[str, ...]:
    """Returns the schemes by which pages of this host may be opened.

    `connection` is the scheme of this request.

    If users open the server by https, a page that was loaded by plain http is not accepted, since any machine
    on the network may have changed it.
    """
    settings = environment()
    if settings.public_url and host.lower() == settings.public_host:
        return (urlsplit(settings.public_url).scheme,)
    if host_name(host) in LOOPBACK_HOSTS:
        return (connection,)
    # The settings do not say how an additional name is opened: a tunnel in front of it may add TLS.
    return ("https",) if settings.is_https else ("http", "https")


def check(facts: Facts) -> Refusal | None:
    """Decides about a request with the settings of this server; returns the reason to refuse it, or None."""
    return judge(facts, keys(), extra_hosts=known_hosts(), accounts=environment().is_team)
