"""Gives evaluations their sessions: in each round of maintenance, and soon after a wish.

Users who work go first: a session of an evaluation ends when one of theirs waits for a place; what it has
done is kept. When another user's evaluation waits, one that had its turn gives its place up.
"""

from __future__ import annotations

import logging
import threading
import time
from contextlib import suppress
from datetime import timedelta
from typing import TYPE_CHECKING, Any, Final

from django.db import connection
from django.utils import timezone

from backend.accounts.models import User
from backend.config.environment import environment
from backend.core.problems import StudioError
from backend.evaluations import work, writes
from backend.evaluations.choices import LIVE, JobState
from backend.evaluations.collector import Collector
from backend.evaluations.models import Evaluation, Replay
from backend.evaluations.work import Place
from backend.sessions import queries as session_queries
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.errors import DrainingError, HostFullError
from backend.sessions.lifecycle import writes as sessions
from backend.sessions.lifecycle.drain import current as current_drain
from backend.sessions.models import LIVE_STATES, Session
from backend.workers.aside import sweeps

if TYPE_CHECKING:
    from datetime import datetime
    from uuid import UUID

__all__ = ["collect", "one_round", "round_soon"]

log = logging.getLogger(__name__)

START_LOOK_S: Final = 0.1
TURN: Final = timedelta(minutes=3)
_collecting: Final[dict[UUID, threading.Thread]] = {}
_ending: Final[set[UUID]] = set()
_lock: Final = threading.Lock()


def round_soon(sender: object = None, **_: object) -> None:
    """Begins a round in a thread, unless there is nothing to do."""
    if not (_is_work() or _sessions().exists()):
        return
    with suppress(StudioError):  # enough of it waits already
        sweeps.ask("evaluations", one_round)


def one_round() -> None:
    """Starts, reads and ends sessions of evaluations."""
    with _lock:
        running = {Place(row.project_id, row.user_id): row for row in _sessions()}
        waiting = work.waiting_places()
        somebody_works = work.somebody_waits_for_place()
        _count_lost(running, waiting)
        _end_starts(running, waiting)
        _make_room(running, waiting, somebody_works=somebody_works)
        if not somebody_works:
            _give_turns(running, waiting)
        for place, session in running.items():
            if session.state != SessionState.QUEUED:
                collect(session, place)
        for session_id, thread in list(_collecting.items()):
            if not thread.is_alive():
                del _collecting[session_id]
                _ending.discard(session_id)


def _is_work() -> bool:
    return (
        Evaluation.objects.filter(state__in=LIVE).exists() or Replay.objects.filter(state__in=LIVE).exists()
    )


def _sessions() -> Any:
    return Session.objects.filter(kind=SessionKind.EVALUATION, state__in=LIVE_STATES)


def _count_lost(running: dict[Place, Session], waiting: dict[Place, datetime]) -> None:
    """Counts a try for each evaluation whose executor was lost while it worked; `lost` lets it wait again."""
    for place in waiting.keys() - running.keys():
        rows = Session.objects.filter(
            kind=SessionKind.EVALUATION, project=place.project, user=place.user
        ).order_by("created_at")
        last, item = rows.last(), work.next_of(place)
        if last is None or last.state != SessionState.FAILED or not isinstance(item, Evaluation):
            continue
        if item.state == JobState.RUNNING:
            writes.lost(item, last.error)


def _end_starts(running: dict[Place, Session], waiting: dict[Place, datetime]) -> None:
    """Ends sessions that have not started and have nothing left to do, such as after a cancellation."""
    for place, session in list(running.items()):
        if session.state != SessionState.READY and place not in waiting:
            sessions.end_session(session, "Nothing is left to do.")
            del running[place]


def _make_room(
    running: dict[Place, Session], waiting: dict[Place, datetime], *, somebody_works: bool
) -> None:
    """Ends the session that has run longest, if somebody who works or another user's evaluation waits."""
    if not running:
        return
    place, longest = min(running.items(), key=lambda item: item[1].created_at)
    turn = TURN
    if longest.own_cluster:  # a Ray cluster may take longer to start than a turn lasts
        turn += timedelta(seconds=session_queries.start_timeout_s(longest))
    is_late = timezone.now() - longest.created_at > turn
    others = [each for each in waiting if each.user not in {there.user for there in running}]
    is_full = len(running) >= environment().max_evaluations
    if somebody_works or (is_late and is_full and others):
        _end(longest, place)
        del running[place]
        waiting.pop(place, None)  # its turn is not in this round


def _give_turns(running: dict[Place, Session], waiting: dict[Place, datetime]) -> None:
    """Starts sessions while the server has room; each one that starts changes whose turn is next."""
    last = work.last_turns(waiting)
    left = dict(waiting)
    while len(running) < environment().max_evaluations and current_drain() is None:
        place = next(iter(work.in_turn(left, running, last)), None)
        if place is None:
            return
        del left[place]
        session = _start(place)
        if session is not None:
            running[place] = session


def _end(session: Session, place: Place) -> None:
    """Ends a session; its evaluation waits for its next turn."""
    _ending.add(session.id)
    rows = Evaluation.objects.filter(project=place.project, user=place.user, state=JobState.RUNNING)
    for found in rows.defer("plan"):
        writes.wait_again(found)
    sessions.end_session(session, "It gave its place to others.")


def _start(place: Place) -> Session | None:
    """Starts a session; without a right, what waits for it fails."""
    user = User.objects.get(id=place.user)
    item = work.next_of(place)
    if item is None:
        return None  # the user has no processor hours left
    try:
        own_cluster = work.has_own_cluster(item)
        return sessions.start_evaluation_session(place.project, acting_user=user, own_cluster=own_cluster)
    except (HostFullError, DrainingError) as error:
        log.info("an evaluation waits: %s", error)
    except StudioError as error:
        for found in Evaluation.objects.filter(project=place.project, user=user, state__in=LIVE):
            writes.finish(found, JobState.FAILED, error.detail)
        for replay in Replay.objects.filter(evaluation__project=place.project, user=user, state__in=LIVE):
            writes.replayed(replay, JobState.FAILED, error.detail)
    return None


def _is_ready(session: Session, place: Place) -> bool:
    """Waits until a session has started; one that does not start counts as lost."""
    until_s = time.monotonic() + 2 * session_queries.start_timeout_s(session)
    while time.monotonic() < until_s:
        session.refresh_from_db()
        if session.state != SessionState.STARTING:
            break
        time.sleep(START_LOOK_S)
    item = work.next_of(place) if session.state == SessionState.FAILED else None
    if item is not None:
        writes.lost(item, session.error)
    return session.state == SessionState.READY


def collect(session: Session, place: Place) -> None:
    """Starts a thread that reads the outcomes of a session, unless one runs already."""
    thread = _collecting.get(session.id)
    if thread is not None and thread.is_alive():
        return

    def run() -> None:
        try:
            if _is_ready(session, place):
                Collector(session, place, lambda: session.id not in _ending).run()
        except Exception:
            log.exception("session %s: its evaluation is not read", session.id)
        finally:
            connection.close()

    thread = threading.Thread(target=run, name="evaluation", daemon=True)
    _collecting[session.id] = thread
    thread.start()
