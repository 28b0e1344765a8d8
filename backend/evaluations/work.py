"""Chooses the next work: of which evaluation, in which order, and for which user. It writes nothing."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING, NamedTuple

from django.db.models import Max

from backend.config.environment import environment
from backend.evaluations import queries
from backend.evaluations.choices import LIVE, NOT_COUNTED, JobState, WaitsFor
from backend.evaluations.models import Evaluation, Replay
from backend.evaluations.writes import hours_left
from backend.sessions import turns
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.models import Session

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from uuid import UUID


class Place(NamedTuple):
    """A project and a user; a session for evaluations belongs to one of each."""

    project: UUID
    user: int


class Side(NamedTuple):
    """A revision of an evaluation, and the seeds that are known; `seeds` is empty if all are to be run."""

    revision: int
    known: list[tuple[int, str]]
    seeds: list[int]


def next_of(place: Place) -> Replay | Evaluation | None:
    """Returns what a session does next: a replay first, since somebody waits for it."""
    replays = Replay.objects.filter(user=place.user, evaluation__project=place.project, state__in=LIVE)
    replay = replays.select_related("evaluation__project", "user").order_by("created_at").first()
    if replay is not None:
        return replay
    rows = Evaluation.objects.filter(project=place.project, user=place.user, state__in=LIVE)
    found = rows.select_related("project", "user").order_by("state", "asked_at").first()  # running first
    return found if found is not None and hours_left(found.user) else None


def has_own_cluster(item: Replay | Evaluation) -> bool:
    """Returns whether something is to be done in a Ray cluster of its own; one run needs none."""
    return environment().evaluations == "rayjob" and isinstance(item, Evaluation)


def has_replay(place: Place) -> bool:
    """Returns whether somebody waits for a replay."""
    rows = Replay.objects.filter(user=place.user, evaluation__project=place.project, state__in=LIVE)
    return rows.exists()


def next_side(found: Evaluation) -> Side | None:
    """Returns the revision of an evaluation that is to be run next; None if all is done."""
    known = queries.known(found, found.revision)
    about = found.results.get(str(found.revision), {})
    counted = [seed for seed, outcome in known if outcome not in NOT_COUNTED]
    if found.wanted is None or len(known) < about.get("wanted", found.wanted) or not about:
        return Side(found.revision, known, [])
    if found.older is None:
        return None
    older = queries.known(found, found.older)
    there = {seed for seed, _ in older}
    missing = [seed for seed in counted if seed not in there]
    return Side(found.older, older, missing) if missing else None


def waits_for(rows: Iterable[Evaluation]) -> dict[UUID, WaitsFor]:
    """Returns what those of some evaluations that wait are waiting for."""
    waiting = [row for row in rows if row.state == JobState.WAITING]
    if not waiting:
        return {}
    has_hours = {user.pk: hours_left(user) for user in {row.user for row in waiting}}
    free = WaitsFor.USERS if somebody_waits_for_place() else WaitsFor.TURN
    found = {row.id: free if has_hours[row.user_id] else WaitsFor.HOURS for row in waiting}
    return found | {each: WaitsFor.CLUSTER for each in _with_starting_cluster() if each in found}


def _with_starting_cluster() -> list[UUID]:
    """Returns the evaluations for which a Ray cluster starts now."""
    if environment().evaluations != "rayjob":
        return []
    rows = Session.objects.filter(kind=SessionKind.EVALUATION, state=SessionState.STARTING, own_cluster=True)
    items = [next_of(Place(project, user)) for project, user in rows.values_list("project", "user")]
    return [item.id for item in items if isinstance(item, Evaluation)]


def somebody_waits_for_place() -> bool:
    """Returns whether a user who works waits for a place, not for the end of another robot of theirs."""
    return bool(turns.order_now().next)


def waiting_places() -> dict[Place, datetime]:
    """Returns the places with something to do, each with the time of the oldest wish."""
    found: dict[Place, datetime] = {}
    replays = Replay.objects.filter(state__in=LIVE).values_list("evaluation__project", "user", "created_at")
    rows = Evaluation.objects.filter(state__in=LIVE).values_list("project", "user", "asked_at")
    for project, user, at in [*replays, *rows]:
        place = Place(project, user)
        found[place] = min(at, found.get(place, at))
    return found


def last_turns(places: Iterable[Place]) -> dict[int, datetime]:
    """Returns when each user of some places was last given a session for evaluations."""
    users = {place.user for place in places}
    rows = Session.objects.filter(kind=SessionKind.EVALUATION, user__in=users)
    return dict(rows.values("user").annotate(last=Max("created_at")).values_list("user", "last"))


def in_turn(
    waiting: Mapping[Place, datetime], running: Iterable[Place], last: Mapping[int, datetime]
) -> list[Place]:
    """Returns the places that wait, in the order of their turns.

    Users with the fewest running ones go first; of these, who never had a turn or had it longest ago, so that
    somebody with many wishes does not keep the others waiting; then the oldest wish.

    Args:
        waiting: the places with something to do, each with the time of the oldest wish.
        running: the places that have a session.
        last: when users had their last turn (`last_turns`).
    """
    there = list(running)
    by_user: dict[int, int] = {}
    for place in there:
        by_user[place.user] = by_user.get(place.user, 0) + 1
    left = [place for place in waiting if place not in there]
    never = datetime.min.replace(tzinfo=UTC)

    def turn(place: Place) -> tuple[int, datetime, datetime, Place]:
        return by_user.get(place.user, 0), last.get(place.user, never), waiting[place], place

    return sorted(left, key=turn)
