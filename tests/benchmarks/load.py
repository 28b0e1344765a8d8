"""200 editors who save every 3 s: their waiting times, the possible rate of saves, and the cost of one.

`python -m tests.benchmarks.load [--editors 200] [--seconds 30] [--local] [--sqlite] [--workers N]`. The
server is one for a team, with PostgreSQL and Redis, and each editor has an account and is signed in; with
`--local` all are the one user of a server on localhost. The editors have a core of their own; web server,
PostgreSQL and Redis share the rest, so that figures are those of one core on a machine with two.
Each editor saves a diagram, and lists and opens projects now and then; 50 more look at nothing that happens.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from contextlib import AsyncExitStack, ExitStack
from pathlib import Path
from typing import Any

import psutil

from tests.backend.services import postgresql, redis
from tests.backend.serving import REPOSITORY, serving
from tests.benchmarks.editors import Editor, Measured

PERIOD_S = 3.0
WARM_UP_S = 6.0
IDLE_SOCKETS = 50
PARTS = {"postgres": "database", "redis-server": "Redis"}


def cpu_s() -> dict[str, float]:
    """Processor time by part: web server, database and Redis are all children of this process."""
    own = psutil.Process()
    times = own.cpu_times()
    total = {"web server": 0.0, "editors": times.user + times.system}
    for member in own.children(recursive=True):
        try:
            part, times = PARTS.get(member.name(), "web server"), member.cpu_times()
        except psutil.Error:
            continue
        total[part] = total.get(part, 0.0) + times.user + times.system
    return total


async def measure(port: int, people: list[tuple[str, str]], seconds: float) -> None:
    """Measures the editors at their normal pace, then a fifth of them at full speed."""
    measured = Measured()
    everyone = [Editor(number, port, person, measured) for number, person in enumerate(people)]
    for some in range(0, len(everyone), 10):
        await asyncio.gather(*(editor.open() for editor in everyone[some : some + 10]))
    async with AsyncExitStack() as viewers:
        for editor in everyone[:IDLE_SOCKETS]:
            await viewers.enter_async_context(editor.look())
        await asyncio.gather(*(editor.work(time.monotonic() + WARM_UP_S, PERIOD_S) for editor in everyone))
        await storm(everyone, measured, seconds)


async def storm(everyone: list[Editor], measured: Measured, seconds: float) -> None:
    """The two loads, one after the other."""
    few = everyone[: max(1, len(everyone) // 5)]
    for editors, pace_s, lasts_s, title in (
        (everyone, PERIOD_S, seconds, f"{len(everyone)} editors, a save every {PERIOD_S:g} s"),
        (few, 0.0, seconds / 2, f"{len(few)} editors without a pause"),
    ):
        measured.times_ms.clear()
        before, started = cpu_s(), time.monotonic()
        await asyncio.gather(*(editor.work(started + lasts_s, pace_s) for editor in editors))
        after = cpu_s()
        report(title, measured, started, {part: after[part] - before.get(part, 0.0) for part in after})


def report(title: str, measured: Measured, started: float, used_s: dict[str, float]) -> None:
    """Prints quantiles, the rate and the cost."""
    took = time.monotonic() - started
    print(f"{title}: {took:.0f} s, load average {os.getloadavg()[0]:.1f}")
    for kind, times in sorted(measured.times_ms.items()):
        cuts = statistics.quantiles(times, n=20) if len(times) > 1 else times * 19
        quantiles = f"p50 {cuts[9]:7.1f} ms  p95 {cuts[18]:7.1f} ms  max {max(times):7.1f} ms"
        print(f"  {kind:6} {len(times):6}  {quantiles}")
    saves = len(measured.times_ms.get("save", [])) or 1
    editors_s = used_s.pop("editors")
    costs = ", ".join(f"{part} {1000 * used / saves:.2f} ms" for part, used in used_s.items())
    all_ms = 1000 * sum(used_s.values()) / saves
    print(f"  {saves / took:.1f} saves a second; CPU a save {all_ms:.2f} ms ({costs})")
    print(f"  the editors used {100 * editors_s / took:.0f} % of their core")
    print(f"  errors: {measured.errors or 'none'}")


def team(stack: ExitStack, folder: Path, *, sqlite: bool) -> tuple[dict[str, str], int]:
    """The settings of a server with accounts, and its port."""
    services = {"BT_STUDIO_DATABASE_URL": f"sqlite:///{folder}/team.sqlite3"}
    if not sqlite:
        services = {
            "BT_STUDIO_DATABASE_URL": stack.enter_context(postgresql()),
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
    return settings_of(services)


def settings_of(services: dict[str, str]) -> tuple[dict[str, str], int]:
    """The settings of one server that uses these services, and its port."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    settings = {
        "BT_STUDIO_MODE": "team",
        "BT_STUDIO_UNSAFE_USERS_RUN_AS_SERVER": "true",
        "BT_STUDIO_PUBLIC_URL": f"http://127.0.0.1:{port}",
        "BT_STUDIO_SECRET_KEY": "k" * 40,
    }
    return settings | services, port


def sign_in(folder: Path, settings: dict[str, str], number: int) -> list[tuple[str, str]]:
    """Makes accounts that are signed in, without hashing a password; returns the cookie of each."""
    environment = os.environ | settings | {"BT_STUDIO_DATA_DIR": str(folder)}
    command = [sys.executable, "-m", "tests.benchmarks.people", str(number)]
    made = subprocess.run(
        command, cwd=REPOSITORY, env=environment, check=True, stdout=subprocess.PIPE, text=True
    )
    return [("Cookie", cookie) for cookie in json.loads(made.stdout)]


def main() -> None:
    """Starts database and server on another core than the editors', and measures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--editors", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("--sqlite", action="store_true")
    parser.add_argument("--local", action="store_true")
    parser.add_argument("--workers", type=int, default=0)
    options, _ = parser.parse_known_args()
    cores = sorted(os.sched_getaffinity(0))
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        os.sched_setaffinity(0, set(cores[:-1]) or set(cores))
        settings: dict[str, Any] = {}
        port = 0
        if not options.local:
            settings, port = team(stack, folder, sqlite=options.sqlite)
        elif not options.sqlite:
            settings["BT_STUDIO_DATABASE_URL"] = stack.enter_context(postgresql())
        print("SQLite" if options.sqlite else "PostgreSQL", "on localhost" if options.local else "for a team")
        more = ("--workers", str(options.workers)) if options.workers else ()
        served = stack.enter_context(serving(folder, "--port", str(port), *more, **settings))
        people = [("Authorization", f"Bearer {served.token}")] * options.editors
        if not options.local:
            people = sign_in(folder, settings, options.editors)
        os.sched_setaffinity(0, {cores[-1]})
        asyncio.run(measure(served.port, people, options.seconds))


if __name__ == "__main__":
    main()
