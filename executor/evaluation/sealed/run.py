"""One sealed run: the world, the faults and the judge are here, the tree and its actions in a child."""

from __future__ import annotations

import contextlib
import os
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.outcome import CRASHED, ERROR, Outcome
from executor.evaluation.pool.accounting import SCRATCH_PREFIX
from executor.evaluation.run import EvaluationRun, actions_seed
from executor.evaluation.sealed.actions import MOST_TEXT, place_of
from executor.evaluation.sealed.confine import free_uid
from executor.evaluation.sealed.link import (
    Failed,
    Link,
    LinkClosedError,
    LinkError,
    Load,
    Loaded,
    Look,
    Resume,
    Seen,
    Switch,
    Tick,
    Ticked,
    Topic,
    Waits,
)
from executor.evaluation.sealed.remote import RemoteNode
from executor.ros.values import type_name
from executor.supervision.descendants import RunChildren
from executor.supervision.signal_names import signal_name
from tree_gardener import Status

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from executor.evaluation.plan import Plan
    from executor.evaluation.sealed.link import ToJudge
    from executor.headless.lockstep import Progress, Watch
    from executor.headless.report import Report

KEPT_VARIABLES: Final = ("PATH", "LANG", "LC_ALL", "LD_LIBRARY_PATH", "VIRTUAL_ENV", "TZ")
KEPT_PREFIXES: Final = ("PYTHONHASHSEED", "OPENBLAS_", "OMP_", "MKL_", "LP_", "ROS_", "RMW_", "FASTDDS_",
                        "FASTRTPS_", "RCUTILS_", "AMENT_")  # fmt: skip
HIDDEN: Final = ("evaluations/", "universes/", "robots/", "tests/")
"""Folders of the project that the actions never see."""
EXIT_MSEC: Final = 1_000
_STATUSES: Final = frozenset(status.name for status in Status)
_LETTERS: Final = frozenset("SFRK")


class _FailedError(Exception):
    """The tree cannot be loaded, or its process has ended; `outcome` is that of the run."""

    def __init__(self, outcome: str, why: str) -> None:
        super().__init__(why)
        self.outcome = outcome
        self.why = why


class SealedRun(EvaluationRun):
    """The run of one seed, with the actions in another process."""

    def __init__(self, plan: Plan, seed: int, say: Callable[[str], None]) -> None:
        super().__init__(plan, seed, None, say)
        self._remote = RemoteNode()
        self._child: Child | None = None
        self._letters: dict[str, str] = {}

    def run(self, progress: Progress | None) -> Outcome:
        """Runs the seed, and returns its outcome."""
        try:
            return super().run(progress)
        except _FailedError as failed:
            return self.outcome_of(failed.outcome, failed.why)

    def set_up(self) -> None:
        """Makes the world, and the process of the actions beside it."""
        self._stack.append(RunChildren().end)
        child = self._child = Child()
        self._stack.append(child.close)
        self.world = self.make_world(self._write_assets())
        self._stack.append(self.world.close)
        self.open_sensors()
        self.node = self.make_node(None, self._remote)
        self.make_stepper()
        self._stack.append(self.node.close)
        self._load()

    def _load(self) -> None:
        from translator.package.app import TREE_FILE, files_beside_engine  # noqa: PLC0415 - slow to load

        files = files_beside_engine(self._project)
        shown = {path: data for path, data in files.items() if not path.startswith(HIDDEN)}
        commands = [
            Topic(
                topic,
                tuple(map(type_name, self.node.types_of(topic))) or (type_name(subscription.msg_type),),
                subscription.depth,
            )
            for topic, subscription in self._remote.subscriptions.items()
        ]
        load = Load(
            shown,
            files[TREE_FILE].decode(),
            actions_seed(self._seed),
            self._tick_hz,
            self._on_finish,
            self._on_error,
            self._remote.publishers,
            commands,
            self._remote.take_sent(),
        )
        answer = self._ask(load)
        if not isinstance(answer, Loaded):
            raise _out_of_turn()
        self._remote.hear(answer.listeners, (), self._make_way)

    def play(self, progress: Progress | None, watch: Watch | None) -> Report:
        """Ticks until the end of the run, and returns its report."""
        del watch  # measurements watch unsealed runs
        ticks, last = self.ticks, Status.IDLE
        for number in range(ticks):
            self._advance(round(number / self._tick_hz / self.world.step_s))
            answer = self._ask(Tick(self.world.time_s, self._remote.take_sent()))
            if not isinstance(answer, Ticked):
                raise _out_of_turn()
            last = self._heed(answer)
            self.node.poll()
            if progress is not None and number % max(1, round(self._tick_hz)) == 0:
                progress(self.world.time_s)
            if answer.is_finished:
                self._note_end(_status(answer.status), last)
                if answer.faults:
                    return self.report
        self._advance(round(ticks / self._tick_hz / self.world.step_s))
        return self.report

    def _heed(self, answer: Ticked) -> Status:
        """Takes in the answer to a tick; returns the last result of the root, as it claims."""
        self._remote.hear(answer.listeners, answer.heard, self._make_way)
        for fault in answer.faults[:1]:
            self.report.errors.append({"text": place_of(fault)[:MOST_TEXT]})
        return _status(answer.last) or Status.IDLE

    def _ask(self, message: Load | Tick) -> ToJudge:
        """Sends a request, and returns the answer; time passes while an action waits."""
        link = self._link
        try:
            link.send(message)
            while isinstance(answer := link.receive_of_actions(), Waits):
                self._remote.hear(answer.listeners, answer.heard, self._make_way)
                is_over = self.world.time_s >= self._options.duration_s
                if not is_over:
                    self._let_time_pass()
                link.send(Resume(self.world.time_s, self._remote.take_sent(), is_over))
        except (LinkClosedError, LinkError) as error:
            raise self._ended(error) from error
        if isinstance(answer, Failed):
            raise _FailedError(ERROR, answer.text[:MOST_TEXT])
        return answer

    @property
    def _link(self) -> Link:
        assert self._child is not None  # noqa: S101 - set up
        return self._child.link

    def _ended(self, error: Exception) -> _FailedError:
        assert self._child is not None  # noqa: S101 - as above
        return _FailedError(CRASHED, str(error) or self._child.how_it_ended())

    def _make_way(self, topic: str, type_: str) -> None:
        for kind in self.node.types_of(topic):
            if type_name(kind) == type_:
                self.node.make_way(topic, kind)

    def switch_action(self, tree_id: str, node_id: str, *, on: bool) -> None:
        """Makes an action raise, or ends that."""
        with contextlib.suppress(LinkClosedError):  # its end is heard next
            self._link.send(Switch(tree_id, node_id, on))

    def count_seen(self) -> None:
        """Asks for the results of each node; what the other process claims is limited to letters."""
        if self._child is None:
            return
        try:
            self._link.send(Look())
            answer = self._link.receive_of_actions()
        except (LinkClosedError, LinkError):
            return
        if isinstance(answer, Seen):
            self._seen = {
                path[:MOST_TEXT]: letters
                for path, letters in answer.letters.items()
                if set(letters) <= _LETTERS and len(letters) <= len(_LETTERS)
            }

    def error_text(self) -> str:
        """Returns what the first error says."""
        for error in self.report.errors:
            return str(error["text"])
        return super().error_text()


class Child:
    """The process of the actions, which begins to load its libraries at once."""

    def __init__(self) -> None:
        uid = free_uid()
        self._folder = Path(tempfile.mkdtemp(prefix=SCRATCH_PREFIX))
        above = self._folder.parent
        if not above.stat().st_mode & 1:  # that of the run, which only its own user may enter
            above.chmod(above.stat().st_mode | 0o11)
        if uid is not None:
            os.chown(self._folder, uid, uid)
        ours, theirs = socket.socketpair()
        command = [sys.executable, "-P", "-m", "executor.evaluation.sealed.actions"]
        command += ["--link-fd", str(theirs.fileno()), "--scratch", str(self._folder)]
        with theirs:
            self._process = subprocess.Popen(
                command if uid is None else [*command, "--uid", str(uid)],
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                env=environment(os.environ, self._folder),
                cwd="/",
                start_new_session=True,
            )
        self._process_fd = os.pidfd_open(self._process.pid)
        self.link = Link(ours, self._process_fd)

    def how_it_ended(self) -> str:
        """Returns how the process has ended, in words; ends it if it still runs."""
        exit_ = select.poll()
        exit_.register(self._process_fd, select.POLLIN)
        exit_.poll(EXIT_MSEC)
        # It is not reaped here: its number stays its own until `close` has ended its group.
        found = os.waitid(os.P_PIDFD, self._process_fd, os.WEXITED | os.WNOWAIT | os.WNOHANG)
        if found is None:
            return "the process of the actions has closed its link"
        if found.si_code != os.CLD_EXITED:
            return f"the process of the actions ended with {signal_name(found.si_status)}"
        return f"the process of the actions ended by itself with status {found.si_status}"

    def close(self) -> None:
        """Ends the process with all that it has started, and removes its folder."""
        self.link.close()
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        os.close(self._process_fd)
        shutil.rmtree(self._folder, ignore_errors=True)


def environment(given: Mapping[str, str], folder: Path) -> dict[str, str]:
    """Returns the variables of the process of the actions: none that names the project or the evaluation."""
    kept = {
        name: value
        for name, value in given.items()
        if name in KEPT_VARIABLES or name.startswith(KEPT_PREFIXES)
    }
    code = Path(__file__).parents[3]
    if code.name != "site-packages":
        kept["PYTHONPATH"] = str(code)
    home = str(folder)
    return kept | {"HOME": home, "TMPDIR": home, "ROS_HOME": home, "PYTHONDONTWRITEBYTECODE": "1"}


def _out_of_turn() -> _FailedError:
    return _FailedError(CRASHED, "the process of the actions sent a message out of turn")


def _status(name: str | None) -> Any:
    return Status[name] if name in _STATUSES else None
