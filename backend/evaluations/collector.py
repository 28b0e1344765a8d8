"""Reads the outcomes of one session for evaluations, and stores them. It needs no page.

A thread holds a lease of the database for its session, so that of several web servers one reads. Whatever
ends it, nothing is lost: another one asks the manager again, which sends what it knows, and the outcomes that
are stored stay as they are.
"""

from __future__ import annotations

import hashlib
import logging
import time
from typing import IO, TYPE_CHECKING, Any, Final

from django.utils import timezone
from websockets.exceptions import WebSocketException

from backend.core.problems import StudioError
from backend.core.scratch import NoRoomError
from backend.evaluations import executor_events, work, writes
from backend.evaluations.bundle import archive_of, message_with
from backend.evaluations.choices import JobState
from backend.evaluations.models import Evaluation, Replay
from backend.projects.storage import queries as projects
from backend.projects.storage.access import Need
from backend.runs import queries as runs
from backend.runs import writes as stored_runs
from backend.sessions.choices import SessionState
from backend.sessions.lease import holder
from backend.sessions.lifecycle import writes as sessions
from backend.sessions.manager.address import open_sync_socket
from backend.sessions.models import Session

if TYPE_CHECKING:
    from collections.abc import Callable
    from uuid import UUID

    from websockets.sync.client import ClientConnection

    from backend.evaluations.work import Place, Side

log = logging.getLogger(__name__)

LEASE_S: Final = 20.0
LOOK_S: Final = 0.5
STORE_S: Final = 0.5
LINGER_S: Final = 30.0
"""For so long a session stays when it has nothing to do, since a click on a cell may follow."""
OPEN_S: Final = 10.0
MOST_MESSAGE: Final = 4 << 20


class _Over(Exception):  # noqa: N818 - a way out
    """The session is to end, or another server reads it."""


class _LostError(Exception):
    """The executor was lost, or said what cannot be."""


class Collector:
    """Does what is to be done in one session, until there is nothing for a while.

    Args:
        session: the session; it is ready.
        place: its project and user.
        is_wanted: whether the session may continue; asked about twice a second.
    """

    def __init__(self, session: Session, place: Place, is_wanted: Callable[[], bool]) -> None:
        self._session = session
        self._place = place
        self._is_wanted = is_wanted
        self._lease = f"eval {session.id.hex}"
        self._held_s = 0.0
        self._socket: ClientConnection | None = None
        self._begun: UUID | None = None

    def run(self) -> None:
        """Works until there is nothing to do; then the session ends."""
        if not holder.hold(self._lease, LEASE_S):
            return
        try:
            with _connect(self._session) as self._socket:
                self._serve()
            sessions.end_session(self._session)
        except _Over:
            pass
        except (OSError, WebSocketException, TimeoutError) as error:
            log.info("session %s: its evaluation is read again soon: %s", self._session.id, error)
            time.sleep(LOOK_S)
        finally:
            holder.give_back(self._lease)

    def _serve(self) -> None:
        idle_s = time.monotonic()
        while time.monotonic() - idle_s < LINGER_S:
            self._look()
            item = work.next_of(self._place)
            if self._is_over(item):
                return
            if item is None:
                time.sleep(LOOK_S)
                continue
            try:
                done = self._replay(item) if isinstance(item, Replay) else self._evaluate(item)
            except _LostError as error:
                writes.lost(item, str(error))
                sessions.end_session(self._session, str(error))
                raise _Over from error
            idle_s = time.monotonic()
            if not done and work.next_of(self._place) is None:
                return  # it was cancelled, so its runs are to end now

    def _is_over(self, item: Replay | Evaluation | None) -> bool:
        """Returns whether this session is not to do what comes next: a Ray cluster has one evaluation.

        A replay that is wished for meanwhile runs on the head of that cluster.
        """
        if item is None or isinstance(item, Replay):
            return item is None and self._session.own_cluster
        if self._session.own_cluster:
            self._begun = self._begun or item.id
            return self._begun != item.id
        return work.has_own_cluster(item)

    def _look(self) -> None:
        """Renews the lease, and sees whether the session continues.

        Raises:
            _Over: it does not.
        """
        now_s = time.monotonic()
        if now_s - self._held_s > LEASE_S / 4:
            self._held_s = now_s
            if not holder.hold(self._lease, LEASE_S):
                raise _Over
            Session.objects.filter(id=self._session.id).update(used_at=timezone.now())
        if not self._is_wanted():
            raise _Over
        if not Session.objects.filter(id=self._session.id, state=SessionState.READY).exists():
            raise _Over

    def _evaluate(self, found: Evaluation) -> bool:
        """Runs what an evaluation lacks; returns whether it came to an end."""
        try:
            found = Evaluation.objects.select_related("project", "user").get(id=found.id)
            side = work.next_side(found)
            if side is None:
                writes.finish(found, JobState.DONE)
                return True
            archive = archive_of(found, side.revision)
        except Evaluation.DoesNotExist:
            return False
        except NoRoomError:
            return _later()
        except StudioError as error:
            writes.finish(found, JobState.FAILED, error.detail)
            return True
        return self._run_side(found, side, archive)

    def _run_side(self, found: Evaluation, side: Side, archive: IO[bytes]) -> bool:
        name = _job_name(found.id.hex, side.revision, found.attempt)
        self._ask(
            name,
            archive,
            evaluation=found.name,
            seeds=side.seeds,
            known=side.known,
            runs=0 if side.seeds else found.runs,
            sealed=found.sealed,
        )
        waiting: list[tuple[executor_events.Done, executor_events.Line]] = []
        stored_s = 0.0
        while True:
            message = self._hear(name)
            match message:
                case executor_events.Begun():
                    if side.revision == found.revision:
                        writes.begun(found, message)
                    else:
                        writes.continues(found)
                case executor_events.Done():
                    waiting.append((message, _line(message)))
                case _:
                    pass
            ended = message if isinstance(message, executor_events.Ended) else None
            if ended is None and time.monotonic() - stored_s < STORE_S:
                continue
            stored_s = time.monotonic()
            self._look()
            if not writes.store(found, side.revision, waiting):
                return False
            waiting.clear()
            if ended is not None:
                return _ended(found, side, ended)
            if work.has_replay(self._place):
                return True  # it continues after the replay
            if not writes.hours_left(found.user):
                writes.wait_again(found)
                return False

    def _replay(self, item: Replay) -> bool:
        """Runs a seed again, and keeps its recording."""
        try:
            archive = archive_of(item.evaluation, item.revision)
        except NoRoomError:
            return _later()
        except StudioError as error:
            writes.replayed(item, JobState.FAILED, error.detail)
            return True
        name = _job_name(item.id.hex, item.revision, item.tries)
        self._ask(name, archive, evaluation=item.evaluation.name, seeds=[item.seed], record=True)
        while not isinstance(message := self._hear(name), executor_events.Ended):
            self._look()
            if not Replay.objects.filter(id=item.id).exists():
                return False
        if not Replay.objects.filter(id=item.id).exists():
            return False  # nobody waits for it
        if message.end != "complete" or not message.run:
            writes.replayed(item, JobState.FAILED, message.message or "The run could not be recorded.")
            return True
        try:
            run = self._keep(item, message.run)
        except StudioError as error:
            writes.replayed(item, JobState.FAILED, error.detail)
        else:
            writes.replayed(item, JobState.DONE, run=run)
        return True

    def _keep(self, item: Replay, recorded_as: str) -> Any:
        project = projects.project(item.evaluation.project_id, user=item.user, need=Need.RUN)
        token = sessions.manager_token(self._session)
        source = stored_runs.Source(project, self._session.address, token, runs.room(item.user))
        fetched = stored_runs.fetch(source, recorded_as, item.user_id)
        name = f"{item.evaluation.name}, seed {item.seed}, revision {item.revision}"[:100]
        values = {"recorded_as": recorded_as, "name": name}
        return stored_runs.keep(fetched, project, values, acting_user=item.user)

    def _ask(self, job: str, archive: IO[bytes], **data: Any) -> None:
        assert self._socket is not None  # noqa: S101 - `run` has opened it
        with archive:
            message = {"id": job, "command": "evaluate", "data": {"job": job, **data}}
            self._socket.send(message_with(archive, message))

    def _hear(self, job: str) -> Any:
        """Returns the next message about a job; None if nothing comes for a moment.

        Raises:
            _LostError: the executor said what cannot be, or refuses the job.
        """
        assert self._socket is not None  # noqa: S101 - `run` has opened it
        try:
            message = executor_events.read(self._socket.recv(timeout=LOOK_S))
        except TimeoutError:
            return None
        except ValueError as error:
            raise _LostError(f"The session sent what is no message: {error}.") from error
        if isinstance(message, executor_events.Refusal):
            raise _LostError(f"The session refuses: {message.message}")
        return message if getattr(message, "job", "") == job else None


def _later() -> bool:
    """Pauses, since other large files take all the space; then the same is tried again."""
    time.sleep(LOOK_S)
    return True


def _line(done: executor_events.Done) -> executor_events.Line:
    try:
        return executor_events.read_line(done)
    except ValueError as error:
        raise _LostError(f"The session sent what is no outcome: {error}.") from error


def _ended(found: Evaluation, side: Side, ended: executor_events.Ended) -> bool:
    if ended.end == "complete":
        writes.side_done(found, side.revision, ended.wanted)
        found.refresh_from_db()
        following = work.next_side(found)
        if following is None:
            writes.finish(found, JobState.DONE)
        elif following.revision == side.revision:
            raise _LostError("Some runs came to no outcome.")
    elif ended.end == "replaced":
        raise _LostError("Another evaluation took the place of this one.")
    elif ended.end == "failed":
        raise _LostError(ended.message)
    else:
        writes.finish(found, JobState.FAILED, ended.message)
    return True


def _job_name(name: str, revision: int, attempt: int) -> str:
    return hashlib.sha256(f"{name} {revision} {attempt}".encode()).hexdigest()[:32]


def _connect(session: Session) -> ClientConnection:
    return open_sync_socket(
        session.address,
        "control",
        additional_headers={"Authorization": f"Bearer {sessions.manager_token(session)}"},
        compression=None,
        max_size=MOST_MESSAGE,
        open_timeout=OPEN_S,
        close_timeout=2,
    )
