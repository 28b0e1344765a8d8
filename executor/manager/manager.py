"""The manager of one session: the state machine between its sockets and its processes.

`python -m executor.manager` serves a session until its parent ends, it is stopped, or no client reconnects
within the grace period. It leaves no process behind.
"""

from __future__ import annotations

import argparse
import asyncio
import logging
import os
import random
import secrets
import signal
import socket
import sys
from collections import deque
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor import __version__
from executor.manager.admission import Admission, is_loopback
from executor.manager.environment import WrongVariableError, number
from executor.manager.gate import fetch_listener
from executor.manager.order import LATER, Order, await_order
from executor.manager.programs import attached_programs, session_programs
from executor.manager.tls import CertificateError, server_context
from executor.ros.environment import discovery_port, ros_environment
from executor.session.events import (
    AttachWanted,
    DropSnapshot,
    EndSession,
    Event,
    Inspect,
    Interrupt,
    Kill,
    Kind,
    RecordingWanted,
    Retire,
    Send,
    Spawn,
    Tell,
    TimePassed,
    Unpack,
    WakeSnapshot,
)
from executor.session.protocol import Session
from executor.session.stage import About
from executor.supervision.confine import die_with_parent
from executor.supervision.shared_memory import remove_abandoned_segments
from executor.supervision.supervisor import Supervisor

if TYPE_CHECKING:
    import ssl

    from executor.child_messages import Frame
    from executor.manager.folders import Folders
    from executor.manager.server import SessionServer
    from executor.ram.server import RamServer
    from executor.supervision.processes import Program

__all__ = ["Manager", "ManagerSettings", "free_domain_id", "main"]

_log = logging.getLogger(__name__)

GOODBYE_S: Final = 1.0
LAST_DOMAIN_ID: Final = 100
LARGEST_DOMAIN_ID: Final = 232


@dataclass(frozen=True)
class ManagerSettings:
    """Settings of a manager.

    Attributes:
        port: the port to listen on; 0 selects a free one.
        token: the token that clients must send; with "" none is needed, and only local clients are accepted.
        domain_id: the domain of the session's ROS graph; None selects an unused one.
        grace_s: the seconds for which a session without clients stays alive; 0 is without limit.
        patience_s: the seconds after the start at which the grace for the first client begins.
        listener: a unix socket on which the manager listens too.
        tls: what encrypts connections to the port; None leaves them as they are, for this machine.
        is_closed_off: whether the session's ROS graph is isolated, as in a container.
        is_ram: whether the manager speaks the RAM dialect, with one local client and without a token.
        records: whether runs are recorded.
        recordings: a folder for them that stays; None is a folder of the session.
        keeps_whole: whether they are kept whole, without budgets.
        groot2: the port at which Groot2 can look at the tree that runs; 0 for none.
        cluster: the address of the Ray cluster that runs evaluations; "" is this machine.
        attach: the address HOST:PORT of the program to follow, in place of an application; "" for none, and
            `LATER` for the one that the server writes to our standard input, with the folder for recordings.
        origins: pages that may connect; without a token, local pages may connect too.
    """

    host: str = "127.0.0.1"
    port: int = 7163
    token: str = ""
    domain_id: int | None = None
    grace_s: float = 300.0
    patience_s: float = 0.0
    is_closed_off: bool = False
    is_ram: bool = False
    records: bool = True
    recordings: Path | None = None
    keeps_whole: bool = False
    groot2: int = 0
    cluster: str = ""
    attach: str = ""
    origins: tuple[str, ...] = ()
    programs: dict[Kind, Program] | None = None
    listener: socket.socket | None = None
    tls: ssl.SSLContext | None = None


def free_domain_id() -> int:
    """Returns a ROS domain in which no participant of this host listens."""
    for domain_id in random.sample(range(1, LAST_DOMAIN_ID + 1), LAST_DOMAIN_ID):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            try:
                probe.bind(("127.0.0.1", discovery_port(domain_id)))
            except OSError:
                continue
            return domain_id
    raise OSError("every ROS domain of this host is in use")


def outside_domain_id() -> int:
    """Returns the ROS domain of the user's own programs, from the environment."""
    text = os.environ.get("ROS_DOMAIN_ID", "")
    return int(text) if text.isdecimal() and int(text) <= LARGEST_DOMAIN_ID else 0


class Manager:
    """One session with its sockets and processes; `run` it on an event loop."""

    def __init__(self, settings: ManagerSettings) -> None:
        self.domain_id = settings.domain_id if settings.domain_id is not None else free_domain_id()
        self._settings = settings
        loop = asyncio.get_running_loop()
        about = About(
            version=__version__,
            ros_domain_id=self.domain_id,
            ros_environment={} if settings.is_closed_off else ros_environment(self.domain_id),
            outside_domain_id=outside_domain_id(),
            grace_s=settings.grace_s,
            patience_s=settings.patience_s,
            hold_limit_s=60.0 * number("BT_STUDIO_HOLD_MINUTES", 15),
        )
        self.session = Session(about, now_s=loop.time())
        made = attached_programs() if settings.attach else None
        self._programs = (
            settings.programs or made or session_programs(self.domain_id, settings.groot2, settings.cluster)
        )
        self._supervisor = Supervisor(self._programs, self.take, self._on_frame, reaps_all=True)
        self._server: SessionServer | RamServer | None = None
        self._folders: Folders | None = None
        self._events: deque[Event] = deque()
        self._is_handling = False
        self._is_closing = False
        self._timer: asyncio.TimerHandle | None = None
        self._tasks: set[asyncio.Task[None]] = set()
        self._ended = loop.create_future()

    async def start(self) -> int:
        """Starts both spare processes and listens; returns the port.

        Raises:
            OSError: the port is in use.
        """
        self._do_all(self.session.prestart())
        await asyncio.sleep(0)  # both processes start now; the rest is loaded meanwhile
        self._folders = self._make_folders()
        port = await self._listen()
        if self._settings.attach != LATER:
            self._begin(self._settings.attach, self._settings.recordings)
        self._set_timer()
        return port

    def follow(self, order: Order) -> None:
        """Follows the program that could not be named at the start."""
        self._begin(order.target, Path(order.recordings) if order.recordings else None)

    def _begin(self, target: str, recordings: Path | None) -> None:
        assert self._folders is not None  # noqa: S101 - made by `start`, which comes first
        if "recorder" in self._programs and self._settings.records:
            self._record(self._recordings(self._folders, recordings))
        if target:
            self.take(AttachWanted(target, str(self._folders.diagrams())))

    async def _listen(self) -> int:
        settings = self._settings
        if settings.is_ram:
            from executor.ram.server import RamServer  # noqa: PLC0415 - after the start of the processes

            self._server = ram = RamServer(self.session, self.take, origins=settings.origins)
            return await ram.start(settings.host, settings.port)
        from executor.manager.server import SessionServer  # noqa: PLC0415 - as above

        admission = Admission(settings.token, frozenset(settings.origins))
        self._server = server = SessionServer(self.session, self.take, admission)
        port = await server.start(settings.host, settings.port, settings.tls)
        if settings.listener is not None:
            await server.start_at(settings.listener)
        return port

    @staticmethod
    def _recordings(folders: Folders, folder: Path | None) -> Path:
        if folder is None:
            return folders.recordings()
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        return folder

    def _record(self, folder: Path) -> None:
        from executor.manager.recordings import Recordings  # noqa: PLC0415 - as in `_listen`
        from executor.manager.server import SessionServer  # noqa: PLC0415 - as above

        self.take(RecordingWanted(str(folder), is_whole=self._settings.keeps_whole))
        if isinstance(self._server, SessionServer):
            self._server.recordings = Recordings(folder, self._supervisor.starting_others)

    def _make_folders(self) -> Folders:
        from executor.manager.folders import Folders  # noqa: PLC0415 - as above

        return Folders(is_alone=self._settings.is_closed_off)

    async def wait(self) -> str:
        """Waits for the end of the session; returns the reason."""
        return str(await self._ended)

    def end(self, reason: str) -> None:
        """Ends the session: `wait` returns."""
        if not self._ended.done():
            self._ended.set_result(reason)

    async def close(self) -> None:
        """Ends all connections and processes."""
        if self._timer is not None:
            self._timer.cancel()
        if self._server is not None:
            await self._server.close()
        self._is_closing = True
        if self._settings.records:
            await self._supervisor.end("application", GOODBYE_S)  # it sends its last ticks
            await self._supervisor.end("recorder", GOODBYE_S)
        await self._supervisor.close()
        if self._tasks:
            await asyncio.wait(self._tasks)
        if self._folders is not None:
            self._folders.remove()
        await asyncio.to_thread(remove_abandoned_segments)

    def take(self, event: Event) -> None:
        """Passes an event to the state machine. Events that effects cause are queued."""
        if self._is_closing:
            return  # it would start other processes in place of those that end
        self._events.append(event)
        if self._is_handling:
            return
        self._is_handling = True
        try:
            while self._events:
                now_s = asyncio.get_running_loop().time()
                self._do_all(self.session.handle(self._events.popleft(), now_s))
        finally:
            self._is_handling = False
        self._set_timer()

    def _do_all(self, effects: list[Any]) -> None:
        for effect in effects:
            match effect:
                case Send() if self._server is not None:
                    self._server.send(effect)
                case (
                    Spawn()
                    | Tell()
                    | Interrupt()
                    | Inspect()
                    | Retire()
                    | Kill()
                    | WakeSnapshot()
                    | DropSnapshot()
                ):
                    self._supervisor.apply(effect)
                case Unpack():
                    task = asyncio.get_running_loop().create_task(self._unpack(effect))
                    self._tasks.add(task)
                    task.add_done_callback(self._tasks.discard)
                case EndSession():
                    self.end(effect.reason)

    def _set_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        deadline_s = self.session.deadline_s
        if deadline_s is not None and not self._ended.done():
            self._timer = asyncio.get_running_loop().call_at(deadline_s, self.take, TimePassed())

    async def _unpack(self, effect: Unpack) -> None:
        assert self._folders is not None  # noqa: S101 - apps come from clients, and these after `start`
        self.take(await asyncio.to_thread(self._folders.unpack, effect))

    def _on_frame(self, message: Frame) -> None:
        if self._server is not None:
            self._server.send_frame(message)


async def serve(settings: ManagerSettings, ready_fd: int | None = None, *, shows_token: bool = False) -> str:
    """Serves one session; returns why it ended.

    Args:
        settings: the settings of the manager.
        ready_fd: a descriptor to which the port is written; without it, the port is written to stderr.
        shows_token: whether the token is reported with the port, as for a generated one.

    Raises:
        OSError: the port is in use, or not allowed without a token.
    """
    manager = Manager(settings)
    loop = asyncio.get_running_loop()
    for each in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        loop.add_signal_handler(each, manager.end, f"got {each.name}")
    try:
        port = await manager.start()
        if settings.attach == LATER:
            await_order(manager.follow, manager.end)
        if ready_fd is not None:
            ready = {"port": port, "domain_id": manager.domain_id, "pid": os.getpid()}
            own = {"token": settings.token} if shows_token else {}
            os.write(ready_fd, msgspec.json.encode(ready | own) + b"\n")
            os.close(ready_fd)
        else:
            sys.stderr.write(_welcome(settings, port, shows_token=shows_token))
        return await manager.wait()
    finally:
        await manager.close()


def _welcome(settings: ManagerSettings, port: int, *, shows_token: bool) -> str:
    host = f"[{settings.host}]" if ":" in settings.host else settings.host
    lines = [f"The manager listens on {host}:{port}."]
    if shows_token:
        lines += [
            f"Clients show its token, which is new at each start: Authorization: Bearer {settings.token}",
            f"or, where they can send no headers: ws://{host}:{port}/control?token={settings.token}",
        ]
    return "\n".join(lines) + "\n"


class _UsageError(Exception):
    """Options that cannot be used together; the text is for the user."""


def _token(options: argparse.Namespace) -> str:
    """Returns the token of the environment, or a random one."""
    if options.ram or options.no_token:
        if options.no_token and options.token_env:
            raise _UsageError("--no-token and --token-env exclude each other")
        if not is_loopback(options.host):
            raise _UsageError(f"without a token it listens on loopback alone, not on {options.host}")
        return ""
    if not options.token_env:
        return secrets.token_urlsafe(24)
    token = os.environ.pop(options.token_env, "")
    if not token:
        raise _UsageError(f"the environment variable {options.token_env} of --token-env holds no token")
    return token


def _tls(options: argparse.Namespace) -> ssl.SSLContext | None:
    """Returns what encrypts the connections, from the files of a certificate and its key."""
    if options.ram and options.tls_cert and options.tls_key:
        raise _UsageError("the RAM dialect is spoken on loopback alone, without TLS")
    try:
        return server_context(options.tls_cert, options.tls_key)
    except CertificateError as error:
        raise _UsageError(str(error)) from error


def main(arguments: list[str] | None = None) -> int:
    """Runs the command line of the manager; returns the exit status."""
    options = _parser().parse_args(arguments)
    grace_s = options.grace if options.grace is not None else 0.0 if options.ram else 300.0
    logging.basicConfig(level=logging.INFO, format="%(asctime)s %(levelname)s %(name)s: %(message)s")
    logging.getLogger("websockets").setLevel(logging.WARNING)
    if options.ready_fd is not None:
        die_with_parent()
    try:
        token, tls = _token(options), _tls(options)
    except _UsageError as error:
        sys.stderr.write(f"bt-studio manager: {error}\n")
        return 2
    try:
        listener = fetch_listener(options.gate, options.session, token) if options.gate else None
    except OSError as error:
        sys.stderr.write(f"bt-studio manager: no socket from the gate {options.gate}: {error}\n")
        return 1
    settings = ManagerSettings(
        options.host,
        options.port,
        token,
        options.domain_id,
        grace_s,
        options.patience,
        is_closed_off=listener is not None,
        is_ram=options.ram,
        records=not options.no_recording,
        recordings=options.recordings,
        attach=options.attach,
        cluster=options.cluster,
        origins=tuple(options.allow_origin),
        listener=listener,
        tls=tls,
    )
    try:
        ended = asyncio.run(
            serve(settings, options.ready_fd, shows_token=bool(token and not options.token_env))
        )
    except WrongVariableError as error:
        sys.stderr.write(f"bt-studio manager: {error}\n")
        return 2
    except OSError as error:
        sys.stderr.write(f"bt-studio manager: cannot listen on {options.host}:{options.port}: {error}\n")
        return 1
    _log.info("ended: %s", ended)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m executor.manager", description=__doc__)
    parser.add_argument("--host", default="127.0.0.1")
    parser.add_argument("--port", type=int, default=7163)
    parser.add_argument(
        "--token-env", default="", help="environment variable with the token; else one is made"
    )
    parser.add_argument(
        "--no-token", action="store_true", help="ask for no token, of this machine and its pages alone"
    )
    parser.add_argument("--ram", action="store_true", help="speak the RAM dialect, on loopback alone")
    parser.add_argument("--no-recording", action="store_true", help="keep no recording of the runs")
    parser.add_argument("--attach", default="", help="HOST:PORT of a program to follow by Groot2's protocol")
    parser.add_argument("--recordings", type=Path, help="folder for the recordings, which stays at the end")
    parser.add_argument(
        "--allow-origin",
        action="append",
        default=[],
        help="page that may drive it, such as https://example.org",
    )
    parser.add_argument("--ready-fd", type=int, help="where to write the port, as a line of JSON")
    parser.add_argument("--domain-id", type=int, help="ROS domain of the session")
    parser.add_argument(
        "--grace",
        type=float,
        help="seconds that a session lives without clients; 300, or no limit with --ram",
    )
    parser.add_argument(
        "--patience",
        type=float,
        default=0.0,
        help="seconds after the start at which the grace for the first client begins",
    )
    parser.add_argument("--tls-cert", help="certificate, as PEM, with which connections are encrypted")
    parser.add_argument("--tls-key", help="its private key, as PEM")
    parser.add_argument(
        "--cluster", default="", help="address of a Ray cluster that runs evaluations; `auto` is this one's"
    )
    parser.add_argument("--gate", type=Path, help="unix socket that hands out the session's own")
    parser.add_argument("--session", default="", help="the session's id, for the gate")
    return parser
