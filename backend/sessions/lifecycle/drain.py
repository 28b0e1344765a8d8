"""The drain before an upgrade: no robot starts, running ones continue, and users are notified."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

from django.db import transaction
from django.utils import timezone

from backend.accounts.audit import note
from backend.config.environment import environment
from backend.sessions import queries
from backend.sessions.errors import DrainingError
from backend.sessions.models import Drain

if TYPE_CHECKING:
    from collections.abc import Callable

    from backend.accounts.models import User

ONLY: Final = 1
LOOK_EVERY_S: Final = 2.0
SENTENCE: Final = "The server is about to be upgraded: no robot starts any more, those that run continue."
MAX_MESSAGE: Final = 300


def current() -> Drain | None:
    """Returns the drain with its message, or None if there is no drain."""
    return Drain.objects.filter(pk=ONLY).first() if environment().is_team else None


def text() -> str:
    """Returns the notice to users; "" without a drain."""
    found = current()
    return f"{SENTENCE} {found.message}".strip() if found is not None else ""


def require_open() -> None:
    """Raises a DrainingError during a drain."""
    found = current()
    if found is not None:
        raise DrainingError(
            SENTENCE, hint=found.message or "Your project is saved; run it after the upgrade."
        )


@transaction.atomic
def begin(message: str, *, acting_user: User | None) -> None:
    """Starts a drain; a second call replaces the message."""
    Drain.objects.update_or_create(
        pk=ONLY, defaults={"since": timezone.now(), "message": message.strip()[:MAX_MESSAGE]}
    )
    note("server.drain", actor=acting_user, message=message.strip()[:MAX_MESSAGE])


@transaction.atomic
def lift(*, acting_user: User | None) -> None:
    """Ends the drain."""
    if Drain.objects.all().delete()[0]:
        note("server.drain_off", actor=acting_user)


def wait_for_the_last(seconds: float, say: Callable[[str], object]) -> int:
    """Waits until no robot runs, or until the timeout.

    Prints each change of their number, and returns the last number.
    """
    deadline, told = time.monotonic() + seconds, -1
    while True:
        counts = queries.counts()
        running = counts["starting"] + counts["ready"]
        if running != told:
            say(f"Robots that run: {running}. Users who wait for one: {counts['queued']}.")
            told = running
        if not running or time.monotonic() >= deadline:
            return running
        time.sleep(LOOK_EVERY_S)
