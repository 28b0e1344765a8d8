"""Keeps executors warm: the web server that maintains the sessions does it for all, in each round.

A row comes before its executor and goes before it: an executor without a row belongs to nobody, and is ended.
"""

from __future__ import annotations

import logging
import threading
import time
from datetime import timedelta
from typing import TYPE_CHECKING, Final

from django.db import connection
from django.utils import timezone

from backend.config.environment import environment
from backend.core.problems import StudioError
from backend.sessions import turns
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.idleness import Ages
from backend.sessions.launchers.base import OWN_NETWORK_DOMAIN, Spec
from backend.sessions.lifecycle import drain
from backend.sessions.lifecycle.writes import launcher, token_of, workers
from backend.sessions.models import LIVE_STATES, Session, WarmExecutor

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

__all__ = ["end_leftovers", "keep_warm"]

log = logging.getLogger(__name__)

OLDEST: Final = timedelta(minutes=30)
"""The age at which an executor that nobody uses is replaced."""
_ages: Final = Ages()
PAUSE_S: Final = 60.0
"""Seconds without a try after one has failed, so that a full cluster is left alone."""


class _Failure:
    """The time of the last failed start on this server."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._at_s: float | None = None

    def note(self) -> None:
        """Notes a failure."""
        with self._lock:
            self._at_s = time.monotonic()

    def is_recent(self) -> bool:
        """Returns whether a start failed within the pause."""
        with self._lock:
            return self._at_s is not None and time.monotonic() - self._at_s < PAUSE_S


failure: Final = _Failure()


def keep_warm() -> None:
    """Replaces executors that are old or have ended, and starts as many as are missing."""
    if not launcher().keeps_warm:
        return
    _retire()
    there = WarmExecutor.objects.filter(claimed_by=None).count()
    for _ in range(_wanted() - there):
        row = WarmExecutor.objects.create(created_at=timezone.now())
        workers().submit(_start, row)


def end_leftovers() -> None:
    """Ends warm executors without a row: those of a web server that was killed."""
    if not launcher().keeps_warm:
        return
    running = launcher().warm_running()  # first, since a row comes before its executor
    known = {str(one) for one in WarmExecutor.objects.values_list("id", flat=True)}
    for made_id, state in running.items():
        if made_id not in known:
            log.warning("the warm executor %s belongs to nobody and is ended", made_id)
            _end(state)


def _wanted() -> int:
    """Returns how many executors are kept; none while users wait for that room, or a drain begins."""
    evaluations = Session.objects.filter(state=SessionState.QUEUED, kind=SessionKind.EVALUATION)
    is_awaited = bool(turns.order_now().next) or evaluations.exists()
    if is_awaited or drain.current() is not None or failure.is_recent():
        return 0
    return environment().warm_sessions


def _retire() -> None:
    longest_start = timedelta(seconds=2 * environment().session_start_timeout_s)
    live = set(Session.objects.filter(state__in=LIVE_STATES).values_list("id", flat=True))
    rows = list(WarmExecutor.objects.all())
    ages = _ages.of({row.id: row.created_at for row in rows})
    for row in rows:
        age = ages[row.id]
        if row.claimed_by is not None:
            is_over = row.claimed_by not in live
        elif row.address:
            is_over = age > OLDEST or launcher().poll(row.launcher_state) is not None
        else:
            is_over = age > longest_start
        # A session may claim it in this moment.
        if is_over and WarmExecutor.objects.filter(id=row.id, claimed_by=row.claimed_by).delete()[0]:
            workers().submit(_end, row.launcher_state or launcher().warm_state_of(str(row.id)))


def _start(row: WarmExecutor) -> None:
    limits = environment()
    spec = Spec(
        session_id=str(row.id),
        token=token_of(str(row.id)),
        ros_domain_id=OWN_NETWORK_DOMAIN,
        start_timeout_s=limits.session_start_timeout_s,
        stop_timeout_s=limits.session_stop_timeout_s,
    )
    try:
        started = launcher().warm(spec)
        where = {"address": started.address, "launcher_state": started.state}
        if not WarmExecutor.objects.filter(id=row.id).update(**where):
            _end(started.state)
    except StudioError as error:
        failure.note()
        log.info("no executor is kept warm: %s", error.detail)
        WarmExecutor.objects.filter(id=row.id, address="").delete()
    except Exception:
        failure.note()
        log.exception("no executor is kept warm")
        WarmExecutor.objects.filter(id=row.id, address="").delete()
    finally:
        connection.close()


def _end(state: Mapping[str, Any]) -> None:
    launcher().stop(state, timeout_s=environment().session_stop_timeout_s)
