"""Measures the cost of a thousand running sessions for one web server: its watch, and its rounds.

The managers are websocket servers in another process, which only answer pings. What the launcher knows of its
executors is a lookup, as it is on Kubernetes, where a thread follows the pods.

    python -m tests.benchmarks known_sessions
"""

from __future__ import annotations

import asyncio
import itertools
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final
from unittest.mock import patch

from websockets.asyncio.server import unix_serve

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection

    from backend.sessions.models import Session

SESSIONS: Final = 1_000
OPENED_AT_ONCE: Final = 50
"""More connections at a time do not fit the backlog of one listener."""
MEASURED_S: Final = 20.0
ROUNDS: Final = 8


async def _managers(path: str) -> None:
    async def answer_pings(socket: ServerConnection) -> None:
        await socket.wait_closed()

    async with unix_serve(answer_pings, path, ping_interval=None, compression=None, backlog=4096):
        print("up", flush=True)
        await asyncio.get_running_loop().create_future()


def _rows(address: str) -> list[Session]:
    """Stores sessions that run."""
    from django.core.management import call_command
    from django.utils import timezone

    from backend.accounts.writes import local_user
    from backend.sessions.choices import SessionKind, SessionState
    from backend.sessions.models import Session

    call_command("migrate", verbosity=0)
    user, now = local_user(), timezone.now()
    shared = {"user": user, "kind": SessionKind.ATTACHED, "state": SessionState.READY, "created_at": now}
    rows = [
        Session(target=f"robot{number}:1667", address=address, launcher="process", used_at=now, **shared)
        for number in range(SESSIONS)
    ]
    return list(Session.objects.bulk_create(rows))


async def _watch(sessions: list[Session]) -> float:
    """Returns the cores that the watch takes."""
    from backend.sessions.watch import Watchmen

    watchmen = Watchmen()
    for known in range(0, len(sessions), OPENED_AT_ONCE):
        watchmen.keep_to(sessions[: known + OPENED_AT_ONCE])
        await asyncio.sleep(0.2)
    await asyncio.sleep(3)
    used_s, began_s = time.process_time(), time.monotonic()
    await asyncio.sleep(MEASURED_S)
    cores = (time.process_time() - used_s) / (time.monotonic() - began_s)
    watchmen.keep_to([])
    await asyncio.sleep(1)
    return cores


async def _rounds() -> float:
    """Returns the processor time of a round of maintenance in s."""
    from backend.sessions import maintenance
    from backend.sessions.lifecycle import writes
    from backend.sessions.watch import watchmen

    counted = itertools.count(1)  # the first round of a server also looks for what another one left
    # The watch is measured alone, and the managers are no processes that a launcher could ask for.
    with patch.object(watchmen, "keep_to"), patch.object(writes.launcher(), "poll", lambda _: None):
        await maintenance.one_round(counted)
        used_s = time.process_time()
        for _ in range(ROUNDS):
            await maintenance.one_round(counted)
    return (time.process_time() - used_s) / ROUNDS


def main() -> None:
    """Prints the cores that sessions take of a web server."""
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "managers")
        command = [sys.executable, "-m", "tests.benchmarks.known_sessions", path]
        with subprocess.Popen(command, stdout=subprocess.PIPE) as managers:
            try:
                assert managers.stdout is not None
                managers.stdout.readline()
                _measure(Path(folder), path)
            finally:
                managers.kill()


def _measure(folder: Path, path: str) -> None:
    os.environ |= {"DJANGO_SETTINGS_MODULE": "backend.config.settings", "BT_STUDIO_DATA_DIR": str(folder)}
    import django

    django.setup()
    from backend.sessions.maintenance import EVERY_S

    sessions = _rows(f"unix:{path}")
    watch, a_round = asyncio.run(_watch(sessions)), asyncio.run(_rounds())
    print(f"{SESSIONS} sessions: watch {watch:.1%} of a core, {a_round * 1e3:.0f} ms a round")
    print(f"together {watch + a_round / EVERY_S:.1%} of a core; target 5 %")


if __name__ == "__main__":
    asyncio.run(_managers(sys.argv[1]))
