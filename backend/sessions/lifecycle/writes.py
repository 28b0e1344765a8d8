"""All writes to sessions. A launch is slow, so a separate thread does it and stores the result."""

from __future__ import annotations

import hashlib
import hmac
import logging
import sys
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import suppress
from functools import lru_cache
from threading import Lock
from typing import TYPE_CHECKING, Any, Final

from django.conf import settings
from django.db import IntegrityError, OperationalError, connection, transaction
from django.utils import timezone

from backend.config.environment import environment
from backend.core.locks import transaction_lock
from backend.core.problems import NotFoundError, StudioError
from backend.core.process_locks import held_by_process
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
from backend.sessions import queries, turns
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.errors import HostFullError, LaunchError
from backend.sessions.launchers.base import OWN_NETWORK_DOMAIN, Launcher, Spec
from backend.sessions.launchers.docker import DockerLauncher
from backend.sessions.launchers.process import ProcessLauncher
from backend.sessions.lifecycle import drain, ros_domains
from backend.sessions.models import LIVE_STATES, RUNNING_STATES, Session
from backend.sessions.signals import session_ends
from backend.sessions.warm.claims import claim, key_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from datetime import datetime
    from uuid import UUID

    from backend.accounts.models import User
    from backend.projects.models import Project

log = logging.getLogger(__name__)

DOMAIN_ATTEMPTS: Final = 3
# A hanging executor does not end on request.
HUNG_STOP_TIMEOUT_S: Final = 1.0
KEPT_PLACES: Final = 1
"""Places that evaluations leave free for users who work."""
PLACES: Final = "places of sessions"
"""The name of the lock for counting the places of sessions and taking one."""
_launches: Final[dict[UUID, Future[None]]] = {}
_launches_lock: Final = Lock()


@lru_cache(maxsize=1)
def launcher() -> Launcher:
    """Returns the launcher of this server, which lives as long as the process."""
    settings = environment()
    if settings.launcher == "docker":
        return DockerLauncher(settings.keeper_folder)
    if settings.launcher == "kubernetes":
        from backend.sessions.launchers.kubernetes.launcher import Files, open_cluster  # noqa: PLC0415 - large, and rarely used

        files = Files(settings.pod_template, settings.tools_template, settings.rayjob_file)
        return open_cluster(files, settings.pod_namespace, settings.evaluation_namespace)
    return ProcessLauncher(settings.data_dir / "logs", recordings=settings.data_dir / "recordings")


@lru_cache(maxsize=1)
def workers() -> ThreadPoolExecutor:
    """Returns the threads in which executors start and end; they live as long as the process."""
    return ThreadPoolExecutor(max_workers=launcher().starts_at_once, thread_name_prefix="session")


def manager_token(session: Session) -> str:
    """Returns the secret that relay and manager share; it is derived from the session, and so not stored."""
    return token_of(key_of(session))


def token_of(made_id: str) -> str:
    """Returns the secret of the executor with an id: that of its session, or its own if it is a warm one."""
    return hmac.new(settings.SECRET_KEY.encode(), f"manager {made_id}".encode(), hashlib.sha256).hexdigest()


def start_session(project_id: UUID, *, acting_user: User) -> Session:
    """Starts an executor for the project, or returns the session that already runs, waits or starts.

    Raises:
        HostFullError: no ROS domain is free.
        DrainingError: the server is about to be upgraded.
    """
    project = projects.project(project_id, user=acting_user, need=Need.RUN)
    running = queries.live_session(project_id, user=acting_user)
    if running is not None and refresh(running).state in LIVE_STATES:
        return running
    drain.require_open()
    return begin(project, SessionKind.INTERACTIVE, acting_user)


def start_evaluation_session(project_id: UUID, *, acting_user: User, own_cluster: bool = False) -> Session:
    """Starts an executor for evaluations of the project, or returns the one that already runs or starts.

    With `own_cluster`, one that starts gets a Ray cluster of its own.

    Raises:
        HostFullError: no place is free beside the one that is kept for users who work.
        DrainingError: the server is about to be upgraded.
    """
    project = projects.project(project_id, user=acting_user, need=Need.RUN)
    running = queries.live_session(project_id, user=acting_user, kind=SessionKind.EVALUATION)
    if running is not None and refresh(running).state in LIVE_STATES:
        return running
    drain.require_open()
    return begin(project, SessionKind.EVALUATION, acting_user, own_cluster=own_cluster)


def has_room_for_evaluations() -> bool:
    """Returns whether this server has, when nobody works, a place for an evaluation."""
    limit = environment().max_sessions
    return not limit or limit > KEPT_PLACES


def begin(
    project: Project | None,
    kind: SessionKind,
    acting_user: User,
    target: str = "",
    *,
    own_cluster: bool = False,
) -> Session:
    """Starts a session, which waits if there is no place for it.

    Raises:
        HostFullError: an evaluation has no place, or no ROS domain is free.
        OwnPlacesTakenError: so many robots of the user wait that one more may not.
    """
    is_evaluation = kind == SessionKind.EVALUATION
    for attempt in range(DOMAIN_ATTEMPTS):
        try:
            with transaction.atomic():
                transaction_lock(PLACES)
                now = timezone.now()
                has_place = _has_place_for_evaluation() if is_evaluation else _has_place_for(acting_user, now)
                session = Session.objects.create(
                    project=project,
                    user=acting_user,
                    kind=kind,
                    target=target,
                    own_cluster=own_cluster,
                    launcher=launcher().name,
                    state=SessionState.STARTING if has_place else SessionState.QUEUED,
                    ros_domain_id=_domain_for(kind) if has_place else None,
                    created_at=now,
                )
            break
        except IntegrityError:
            # Another request was faster: it has made this session, or has only taken the domain.
            running = (
                queries.live_session(project.id, user=acting_user, kind=kind)
                if project is not None
                else queries.attached_session(target, user=acting_user)
            )
            if running is not None:
                return running
            if attempt == DOMAIN_ATTEMPTS - 1:
                raise
    if session.state == SessionState.STARTING:
        _submit(session)
    return session


def places_left(states: Iterable[SessionState] = RUNNING_STATES) -> int:
    """Returns the number of executors that may still start; sessions in `states` count as running."""
    limit = environment().max_sessions
    taken = Session.objects.filter(state__in=list(states)).count() if limit else 0
    if limit:
        return limit - taken
    return len(ros_domains.ROS_DOMAINS) if launcher().shares_network else sys.maxsize


def _has_place_for_evaluation() -> bool:
    """Returns True, unless it raises: evaluations do not wait here.

    Raises:
        HostFullError: no place is free beside the one that is kept, and those for which users wait.
    """
    if places_left() - len(turns.order_now().next) > KEPT_PLACES:
        return True
    raise HostFullError("All places of this server are taken, or kept for users who work.")


def _has_place_for(user: User, now: datetime) -> bool:
    """Returns whether a robot of a user may start now; those that go first have theirs.

    Raises:
        OwnPlacesTakenError: it would have to wait, and so many of its user wait already.
    """
    wish = turns.wish_of("", user, now)
    if wish in turns.order_now(wish).next[: max(0, places_left())]:
        return True
    turns.require_turn(user)
    return False


def start_queued() -> int:
    """Starts waiting sessions in their order while there are places; returns their number.

    Several web servers may call it at the same time: each session is started by one of them.
    """
    started = 0
    while drain.current() is None and (session := _next_with_place()) is not None:
        _submit(session)
        started += 1
    return started


def _next_with_place() -> Session | None:
    """Gives a place to the session that is next; those of users who work go before evaluations.

    Returns None if nobody waits who may start, or if no place is free.
    """
    with suppress(IntegrityError, HostFullError), transaction.atomic():
        transaction_lock(PLACES)
        session = _next_waiting(places_left())
        if session is not None:
            place = {"state": SessionState.STARTING, "ros_domain_id": _domain_for(session.kind)}
            if _moved(session, SessionState.QUEUED, used_at=timezone.now(), **place):
                return session
    return None


def _next_waiting(places: int) -> Session | None:
    rows = Session.objects.filter(state=SessionState.QUEUED)
    if found := turns.order_now().next:
        return rows.filter(id=str(found[0].key)).first() if places > 0 else None
    evaluations = rows.filter(kind=SessionKind.EVALUATION).order_by("created_at")
    return evaluations.first() if places > KEPT_PLACES else None


def _submit(session: Session) -> None:
    with _launches_lock:
        _launches[session.id] = workers().submit(_launch, session)


def refresh(session: Session) -> Session:
    """Checks the session's executor, and stores if it has died; returns the session."""
    if session.state == SessionState.READY:
        status = launcher().poll(session.launcher_state)
        if status is not None:
            launcher().stop(session.launcher_state, timeout_s=environment().session_stop_timeout_s)
            why = f" {reason}" if (reason := launcher().explain(session.launcher_state)) else ""
            died = f"The session ended by itself.{why}" if status else ""
            log.info("session %s: its executor ended with status %s", session.id, status)
            _look_again(session)
            died = session.error or died  # the caller that ended it has stored the reason
            state = SessionState.FAILED if died else SessionState.ENDED
            if not _moved(session, SessionState.READY, state=state, error=died, ended_at=timezone.now()):
                _look_again(session)  # the session did not end by itself, but was ended
    return session


def seen_again(session: Session) -> Session:
    """Checks the session as it is stored now, which another server may have ended; returns the session."""
    _look_again(session)
    return refresh(session)


def end_session(session: Session, why: str = "") -> Session:
    """Ends the executor and everything that it started; may be called twice. Returns the session."""
    with _launches_lock:
        launch = _launches.pop(session.id, None)
    if launch is not None and not launch.cancel():
        if session.own_cluster:
            _end_start(session, why)
        launch.result()
    _look_again(session)  # the executor may have started since the session was looked up
    if launch is None and _moved(session, SessionState.STARTING, **_over(SessionState.ENDED, why)):
        _await_launch(session)
        return session
    _look_again(session)
    if session.launcher_state:
        if session.state == SessionState.READY:
            session_ends.send_robust(Session, session=session)
        launcher().stop(session.launcher_state, timeout_s=environment().session_stop_timeout_s)
    if session.state in LIVE_STATES:
        finish(session, SessionState.ENDED, why)
    return session


def _end_start(session: Session, why: str) -> None:
    """Ends the start of a Ray cluster, which would take minutes: it is over when its RayJob is gone."""
    if _moved(session, SessionState.STARTING, **_over(SessionState.ENDED, why)):
        launcher().stop(launcher().state_of(str(session.id)), timeout_s=0)


def _await_launch(session: Session) -> None:
    """Waits until the web server that starts this session's executor has ended it again, or has itself ended.

    That server sees the end of the session when the executor has started, and ends the executor. During the
    launch it holds a lock of the database, which is released with its connection.
    """
    if session.own_cluster:
        launcher().stop(launcher().state_of(str(session.id)), timeout_s=0)  # so that its start ends soon
    # Inside the caller's transaction, others do not see the end of the session yet.
    if connection.vendor == "postgresql" and not connection.in_atomic_block:
        longest_s = 2 * queries.start_timeout_s(session)
        try:
            with transaction.atomic(), connection.cursor() as cursor:
                cursor.execute("SELECT set_config('lock_timeout', %s, true)", [f"{longest_s:.0f}s"])
                transaction_lock(_launch_lock(session.id))
        except OperationalError:
            log.warning("session %s: the server that starts it does not come to an end", session.id)
    if launcher().survives_server:  # an executor of a killed server still exists
        state = launcher().state_of(str(session.id))
        launcher().stop(state, timeout_s=environment().session_stop_timeout_s)


def _launch_lock(session_id: UUID) -> str:
    return f"launch {session_id}"


def fail_session(session_id: UUID, why: str) -> None:
    """Ends an executor that does not answer, and stores the reason."""
    try:
        ready = Session.objects.filter(id=session_id, state=SessionState.READY)
        session = ready.first()
        # Other servers may notice its end first, and then report this reason.
        if session is None or not ready.update(error=why):
            return
        log.warning("session %s: %s", session.id, why)
        launcher().stop(session.launcher_state, timeout_s=HUNG_STOP_TIMEOUT_S)
        _moved(session, SessionState.READY, state=SessionState.FAILED, error=why, ended_at=timezone.now())
    finally:
        connection.close()


def end_sessions_of(sender: object, *, project_id: UUID, **_: object) -> None:
    """Ends the sessions of a deleted project."""
    for session in Session.objects.filter(project_id=project_id, state__in=LIVE_STATES):
        end_session(session)


def end_sessions_of_user(sender: object, *, user: User, **_: object) -> None:
    """Ends the sessions of an account that will be deleted."""
    for session in Session.objects.filter(user=user, state__in=LIVE_STATES):
        end_session(session)


def require_right(session: Session) -> None:
    """Checks that the user of a session may still run its project.

    Raises:
        NotFoundError: the account is closed, or has no role in the project any more.
    """
    if not session.user.is_active:
        raise NotFoundError("The account is deactivated.")
    if session.project_id is not None:
        projects.project(session.project_id, user=session.user, need=Need.RUN)


def end_sessions_without_right(
    sender: object, *, user_id: int | None, project_id: UUID | None, **_: object
) -> None:
    """Ends the sessions of users who may no longer run their project."""
    rows = Session.objects.filter(state__in=LIVE_STATES).select_related("user")
    if user_id is not None:
        rows = rows.filter(user=user_id)
    if project_id is not None:
        rows = rows.filter(project_id=project_id)
    for session in rows:
        try:
            require_right(session)
        except StudioError:
            workers().submit(_end_and_disconnect, session, "You may no longer run this project.")


def end_all_sessions() -> None:
    """Ends, at the end of the server, every session that must not outlive it.

    On a team server, sessions in containers continue; on localhost all sessions end.
    """
    if launcher().survives_server and environment().is_team:
        return
    live = queries.live_sessions()
    with ThreadPoolExecutor(max_workers=max(1, len(live))) as pool:
        list(pool.map(_end_and_disconnect, live))


def _end_and_disconnect(session: Session, why: str = "") -> None:
    try:
        end_session(session, why)
    finally:
        connection.close()


def _launch(session: Session) -> None:
    limits = environment()
    spec = Spec(
        session_id=str(session.id),
        token=manager_token(session),
        ros_domain_id=session.ros_domain_id or (0 if launcher().shares_network else OWN_NETWORK_DOMAIN),
        start_timeout_s=queries.start_timeout_s(session),
        stop_timeout_s=limits.session_stop_timeout_s,
        target=session.target,
        own_cluster=session.own_cluster,
    )
    try:
        with held_by_process(_launch_lock(session.id)):
            _start_and_store(session, spec)
    except HostFullError as error:
        # The host's refusal counts more than our number. The session keeps its place in the queue.
        log.info("session %s waits: %s", session.id, error.detail)
        _moved(session, SessionState.STARTING, state=SessionState.QUEUED, ros_domain_id=None)
    except LaunchError as error:
        log.warning("session %s: %s", session.id, error.detail)
        _start_failed(session, "\n".join(filter(None, (error.detail, error.hint))))
    except Exception:
        log.exception("session %s", session.id)
        _start_failed(session, "The launcher failed; the server's log has the details.")
    finally:
        with _launches_lock:
            _launches.pop(session.id, None)
        connection.close()


def _start_failed(session: Session, why: str) -> None:
    """Stores why a start failed, unless the session was ended meanwhile."""
    _moved(session, SessionState.STARTING, **_over(SessionState.FAILED, why))


def _over(state: SessionState, why: str) -> dict[str, Any]:
    """Returns the fields of a session that ends now."""
    return {"state": state, "error": why, "ended_at": timezone.now()}


def _start_and_store(session: Session, spec: Spec) -> None:
    """Starts the executor of a session that has not ended before; the caller holds the lock of the launch."""
    if not Session.objects.filter(id=session.id, state=SessionState.STARTING).exists():
        return
    warm = None if session.target or session.own_cluster else claim(session.id, launcher())
    connection.close()  # many robots that start at once need no connection while they wait
    started = warm or launcher().start(spec)
    where = {"address": started.address, "launcher_state": started.state}
    ready = {"state": SessionState.READY, "used_at": timezone.now(), **where}
    if not _moved(session, SessionState.STARTING, **ready):
        launcher().stop(started.state, timeout_s=spec.stop_timeout_s)


def _look_again(session: Session) -> None:
    with suppress(Session.DoesNotExist):  # the session was deleted with its project or user
        session.refresh_from_db()


def _moved(session: Session, before: SessionState, **fields: Any) -> bool:
    """Changes a session that is in the state `before`; returns False if its state has changed meanwhile."""
    if Session.objects.filter(id=session.id, state=before).update(**fields) == 0:
        return False
    for name, value in fields.items():
        setattr(session, name, value)
    return True


def finish(session: Session, state: SessionState, error: str = "") -> None:
    """Stores that a session is over."""
    session.state, session.error, session.ended_at = state, error, timezone.now()
    session.save(update_fields=["state", "error", "ended_at"])


def _domain_for(kind: str) -> int | None:
    """Returns the domain of a session that starts; None if it joins no graph or has its own network."""
    needs_one = launcher().shares_network and kind != SessionKind.ATTACHED
    return ros_domains.free_domain() if needs_one else None
