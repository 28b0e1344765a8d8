"""Runs the web server: prepares the data folder, binds the port, and serves until a signal to end."""

from __future__ import annotations

import ctypes
import errno
import fcntl
import gc
import json
import logging
import os
import secrets
import signal
import socket
import sys
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Final

from backend.config.environment import environment
from backend.core.clients import proxies
from backend.core.logs import set_up
from backend.core.processes.siblings import siblings

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    import uvicorn

log = logging.getLogger(__name__)

GRACE_S: Final = 2
QUEUE: Final = 2048
"""The largest number of connections that wait to be accepted."""
GARBAGE_EVERY_S: Final = 24 * 3600
LOOK_FOR_GARBAGE_S: Final = 600
DATABASE_PATIENCE_S: Final = 60.0
SWITCH_S: Final = 0.0005
"""Seconds for which a thread computes before another one may run.

A request releases the interpreter's lock at each query, and must then acquire it again. With Python's default
of 5 ms, two busy threads delay each query by about 10 ms.
"""
M_MMAP_THRESHOLD: Final = -3
M_ARENA_MAX: Final = -8
LARGE_BLOCK: Final = 64 * 1024
ARENAS: Final = 2
MIGRATION_LOCK: Final = 0x62742D73747564


class ServeError(Exception):
    """The server cannot start; the text tells the user the reason and what to do."""


@contextmanager
def ended_by_interrupt() -> Iterator[None]:
    """Makes Ctrl+C end the process immediately while the server starts, as SIGTERM does.

    Python drops a `KeyboardInterrupt` that is raised in the callback of a weak reference. Imports run many
    such callbacks, so without this the server could continue.
    """
    before = signal.getsignal(signal.SIGINT)
    if before is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def data_folder(folder: Path, *, is_shared: bool = False) -> Iterator[None]:
    """Makes the data folder with its secret key, and locks it against servers that cannot share it.

    Args:
        folder: the data folder.
        is_shared: whether other servers may use it at the same time, as those on one PostgreSQL do.

    Raises:
        ServeError: the folder cannot be written, or another server has locked it.
    """
    make_data_folder(folder)
    try:
        lock = (folder / "serve.lock").open("a+", encoding="utf-8")
    except OSError as error:
        raise ServeError(f"The data folder {folder} cannot be used: {error.strerror}.") from error
    with lock:
        try:
            fcntl.flock(lock, (fcntl.LOCK_SH if is_shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except OSError as error:
            lock.seek(0)
            holder = lock.read().strip()
            which = f"Another server (process {holder})" if holder else "Another server"
            raise ServeError(
                f"{which} uses the data folder {folder}: end it, or choose another folder with --data-dir. "
                "Only servers with accounts, PostgreSQL and containers share one."
            ) from error
        lock.truncate(0)
        if not is_shared:
            lock.write(str(os.getpid()))
            lock.flush()
        yield


def make_data_folder(folder: Path) -> None:
    """Makes the data folder with its secret key; only its owner can read it.

    Raises:
        ServeError: the folder cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        _make_secret_key(folder / "secret_key")
    except OSError as error:
        raise ServeError(f"The data folder {folder} cannot be used: {error.strerror}.") from error


def _make_secret_key(path: Path) -> None:
    """Makes the secret key if it does not exist.

    The file appears atomically, since another server may read it.
    """
    if path.exists():
        return
    partial = path.with_name(f"{path.name}.{secrets.token_hex(8)}")
    descriptor = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    try:
        with os.fdopen(descriptor, "w", encoding="ascii") as file:
            file.write(secrets.token_urlsafe(48))
        with suppress(FileExistsError):
            os.link(partial, path)
    finally:
        partial.unlink()


def bind(host: str, port: int) -> socket.socket:
    """Binds the port before the slow parts of the start.

    Raises:
        ServeError: the port is in use, or not permitted.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((host, port))
        listener.listen(QUEUE)
    except OSError as error:
        listener.close()
        if error.errno == errno.EADDRINUSE:
            raise ServeError(
                f"Port {port} is already in use: end the program that uses it, or choose another with --port."
            ) from error
        raise ServeError(f"Port {port} of {host} cannot be opened: {error.strerror}.") from error
    return listener


def migrate() -> None:
    """Migrates the database; an up-to-date database costs one query.

    Raises:
        ServeError: the database cannot be used, for example since it is read-only.
    """
    import django  # noqa: PLC0415 - the environment must be set first

    django.setup()
    from django.core.management import call_command  # noqa: PLC0415
    from django.db import OperationalError  # noqa: PLC0415

    if environment().is_postgresql:
        await_database(environment().database_url.get_secret_value())
    try:
        with _alone():
            call_command("migrate", verbosity=0, interactive=False)
    except OperationalError as error:
        raise ServeError(f"The database cannot be used: {error}.") from error


def await_database(url: str, patience_s: float = DATABASE_PATIENCE_S) -> None:
    """Waits for a PostgreSQL server that may still be starting.

    Raises:
        ServeError: PostgreSQL does not start, or refuses the connection.
    """
    import psycopg  # noqa: PLC0415 - localhost does without

    deadline = time.monotonic() + patience_s
    while True:
        try:
            # Connects without Django, whose pool would log each attempt.
            psycopg.connect(url, connect_timeout=5).close()
            return
        except psycopg.OperationalError as error:
            reason = str(error).strip().splitlines()[-1].strip()
            is_final = any(text in str(error) for text in ("authentication failed", "does not exist"))
            if is_final or time.monotonic() > deadline:
                raise ServeError(
                    f"The database of BT_STUDIO_DATABASE_URL cannot be used: {reason}"
                ) from error
            time.sleep(0.2)


@contextmanager
def _alone() -> Iterator[None]:
    """Prevents web servers that start together from migrating one PostgreSQL database at the same time."""
    from django.db import connection  # noqa: PLC0415

    if connection.vendor != "postgresql":
        yield
        return
    with connection.cursor() as cursor:
        cursor.execute("SELECT pg_advisory_lock(%s)", [MIGRATION_LOCK])
        try:
            yield
        finally:
            cursor.execute("SELECT pg_advisory_unlock(%s)", [MIGRATION_LOCK])


def run(
    listener: socket.socket,
    *,
    on_ready: Callable[[], None],
    log_level: str,
    accepts_at_once: int = QUEUE,
) -> None:
    """Serves until SIGINT or SIGTERM; then ends every session and returns.

    Args:
        listener: the listening socket.
        on_ready: called when requests are answered.
        log_level: the least severe line that is printed.
        accepts_at_once: the number of connections that the event loop accepts before it does other work. It
            is small for workers that share the socket: otherwise the first worker to wake would accept all
            connections.
    """
    set_up(log_level, environment().log_style)
    sys.setswitchinterval(SWITCH_S)
    return_large_blocks()
    if siblings.family is None:  # otherwise the parent has logged it
        proxies.at_start()
    with ended_by_interrupt():
        server = _make_server(on_ready, accepts_at_once)
    with suppress(KeyboardInterrupt):
        server.run(sockets=[listener])


def return_large_blocks() -> None:
    """Makes glibc return large blocks to the system as soon as they are freed.

    By default it keeps those of a size that it has seen once, up to 32 MB, in a heap of each thread: saves of
    30 MB left the process 800 MB larger.
    """
    with suppress(OSError, AttributeError):  # another C library
        libc = ctypes.CDLL(None)
        libc.mallopt(M_MMAP_THRESHOLD, LARGE_BLOCK)
        libc.mallopt(M_ARENA_MAX, ARENAS)


def _make_server(on_ready: Callable[[], None], accepts_at_once: int) -> uvicorn.Server:
    import uvicorn  # noqa: PLC0415 - slow to load

    from backend.core.connection_costs import LARGEST_MESSAGE  # noqa: PLC0415 - as above
    from backend.core.heads import PatientProtocol  # noqa: PLC0415 - it loads uvicorn
    from backend.core.websocket import PatientSocket  # noqa: PLC0415 - as above

    class Server(uvicorn.Server):
        async def startup(self, sockets: Sequence[socket.socket] | None = None) -> None:
            await super().startup(sockets=list(sockets) if sockets else None)
            if self.started:
                on_ready()

    config = uvicorn.Config(
        "backend.config.asgi:application",
        log_config=None,
        backlog=accepts_at_once,
        access_log=False,
        http=PatientProtocol,
        lifespan="on",
        ws=PatientSocket,
        ws_max_size=LARGEST_MESSAGE,
        ws_per_message_deflate=False,
        ws_ping_interval=20,
        ws_ping_timeout=40,
        server_header=False,
        proxy_headers=False,  # only `clients.address_of` decides which proxies are trusted
        timeout_graceful_shutdown=GRACE_S,
    )
    return Server(config)


def load() -> None:
    """Imports the modules of the first requests."""
    import backend.config.urls  # noqa: F401, PLC0415 - slow to load
    import translator  # noqa: F401, PLC0415 - as above

    # Imported objects live as long as the process: the garbage collector need not scan them.
    gc.collect()
    gc.freeze()


def tidy() -> None:
    """Cleans up once a day if no other server did; never returns."""
    from django.db import connection  # noqa: PLC0415 - after Django is set up

    from backend.config.objects import collect_daily  # noqa: PLC0415 - as above
    from backend.projects.storage.writes import collect_garbage  # noqa: PLC0415 - as above
    from backend.sessions.lease import GARBAGE, holder, is_alone  # noqa: PLC0415 - as above

    while True:
        try:
            with holder.chore(GARBAGE, GARBAGE_EVERY_S) as is_ours:
                if is_ours:
                    collect_garbage()
                    collect_daily()
        except Exception:
            log.exception("nothing was tidied up")
        connection.close()
        time.sleep(GARBAGE_EVERY_S if is_alone() else LOOK_FOR_GARBAGE_S)


def write_ready_file(path: Path, url: str, port: int) -> None:
    """Writes the server's address to a file for a program that waits for it.

    The file appears atomically, and only its owner can read it.
    """
    partial = path.with_name(path.name + ".partial")
    descriptor = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    with os.fdopen(descriptor, "w", encoding="utf-8") as file:
        json.dump({"url": url, "port": port, "pid": os.getpid()}, file)
    partial.replace(path)
