"""The robots that wait for a place on the server, and the order in which they get one."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from django.db.models import Count

from backend.config.environment import environment
from backend.core.processes.shares import Order, Wish, order
from backend.sessions.choices import OF_USERS, SessionState
from backend.sessions.errors import OwnPlacesTakenError
from backend.sessions.models import RUNNING_STATES, Session

if TYPE_CHECKING:
    from collections.abc import Hashable
    from datetime import datetime

    from backend.accounts.models import User

HINT = "End one that you no longer need, or wait until one ends."


class Turn(NamedTuple):
    """The turn of a session that waits.

    Attributes:
        before: the number of robots that get a place before it.
        is_own: whether it waits until another robot of its user ends.
    """

    before: int
    is_own: bool


def wish_of(key: Hashable, user: User, since: datetime) -> Wish:
    """Returns the wish for a place of a session that is not stored yet."""
    return Wish(key, user.pk, since.timestamp(), user.is_exempt)


def order_now(*more: Wish) -> Order:
    """Returns the order of the robots that wait, and of some more."""
    rows = Session.objects.filter(state=SessionState.QUEUED, kind__in=OF_USERS)
    wishes = [
        Wish(key, owner, since.timestamp(), is_exempt)
        for key, owner, since, is_exempt in rows.values_list("id", "user", "created_at", "user__is_exempt")
    ]
    wishes += more
    if not wishes:
        return Order([], [])
    limits = environment()
    running = Session.objects.filter(state__in=RUNNING_STATES, kind__in=OF_USERS)
    held: dict[Hashable, int] = dict(running.values_list("user").annotate(n=Count("id")))
    return order(wishes, held, limits.of_one_user(limits.max_user_sessions))


def turn_of(session: Session) -> Turn | None:
    """Returns the turn of a session; None if it does not wait."""
    if session.state != SessionState.QUEUED:
        return None
    found = order_now()
    for before, wish in enumerate([*found.next, *found.held_up]):
        if wish.key == session.id:
            return Turn(before, is_own=before >= len(found.next))
    return Turn(0, is_own=False)  # it got its place just now, or is of an evaluation


def require_turn(user: User) -> None:
    """Checks that one more robot of a user may wait.

    Raises:
        OwnPlacesTakenError: so many of theirs wait already.
    """
    limits = environment()
    most = limits.of_one_user(limits.max_user_waiting)
    waiting = Session.objects.filter(state=SessionState.QUEUED, kind__in=OF_USERS, user=user).count()
    if most and waiting >= most and not user.is_exempt:
        raise OwnPlacesTakenError(f"{waiting} robots of yours wait for a place already.", hint=HINT)
