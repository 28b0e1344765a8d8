"""Stops processes, and measures when that is reported: `python -m tests.benchmarks.hangs --rounds 5`.

A world and an application are stopped (SIGSTOP) in every state, the waiting ones included; a manager in every
state too, which continues after a while: then it must blame nobody. Prints after how many seconds each was
reported and all was right again (minimum, median, maximum).

`--false-faults MINUTES` runs a session while all processors are busy with something else, and counts what was
reported that was none. Exit status 1 if something was not reported in time, or falsely.

A manager that stays stopped is reported by the web server's watch, which ends it: that is measured as well.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import logging
import os
import signal
import subprocess
import sys
import time
from statistics import median
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import django

from executor.session.ladder import State
from tests.executor.hanging import CASES, HangingSession, hanging_session
from tests.executor.session_client import TOKEN

if TYPE_CHECKING:
    from collections.abc import Iterator

REPORTED_WITHIN_S = 3.0
RIGHT_WITHIN_S = 12.0
MANAGER_REPORTED_WITHIN_S = 4.0
MANAGER_STOPPED_S = 6.0
CALM_S = 4.0
CYCLE_S = 20.0

Times = dict[str, list[tuple[float, float]]]


async def stop_children(rounds: int, times: Times, failed: list[str]) -> None:
    """Stops each child in each state."""
    async with hanging_session() as session:
        for number in range(rounds):
            for kind, state in CASES:
                what = f"{kind} in {state}"
                try:
                    outcome = await session.stop_child(kind, state)
                    await session.runs()
                except (AssertionError, TimeoutError) as error:
                    failed.append(f"{what}: {error!r}")
                    print(f"{number + 1:4} {what:40} failed: {error!r}", flush=True)
                    continue
                times.setdefault(kind, []).append((outcome.reported_s, outcome.right_s))
                print(
                    f"{number + 1:4} {what:40} reported {outcome.reported_s:6.2f} s  "
                    f"right {outcome.right_s:6.2f} s  load {os.getloadavg()[0]:.1f}",
                    flush=True,
                )
                session.client.events[:-50] = []


async def stop_managers(rounds: int, failed: list[str]) -> None:
    """Stops the manager in each state; it must not take its own pause for a hang of a child."""
    async with hanging_session() as session:
        for number in range(rounds):
            for state in State:
                await session.climb(state)
                at = len(session.client.events)
                os.kill(session.manager.pid, signal.SIGSTOP)
                await asyncio.sleep(MANAGER_STOPPED_S)
                os.kill(session.manager.pid, signal.SIGCONT)
                await asyncio.sleep(CALM_S)
                faults = [fault["message"] for fault in session.client.named("fault", after=at)]
                failed += [f"manager in {state}: {message}" for message in faults]
                print(f"{number + 1:4} manager in {state:29} {len(faults)} false faults", flush=True)


async def watch_managers(rounds: int, times: Times, failed: list[str]) -> None:
    """Stops the manager of a separate session in each state, and leaves it to the web server's watch."""
    for number in range(rounds):
        for state in State:
            async with hanging_session() as session:
                await session.climb(state)
                try:
                    reported_s, right_s = await stop_manager(session)
                except (AssertionError, TimeoutError) as error:
                    failed.append(f"manager in {state}: {error!r}")
                    continue
            times.setdefault("manager", []).append((reported_s, right_s))
            print(
                f"{number + 1:4} manager in {state:29} reported {reported_s:6.2f} s  right {right_s:6.2f} s",
                flush=True,
            )


async def stop_manager(session: HangingSession) -> tuple[float, float]:
    """Stops a manager; returns the seconds until the watch noticed, and until it ended the manager."""
    from backend.sessions import watch
    from backend.sessions.lifecycle import writes

    writes.manager_token = lambda session: TOKEN
    one: Any = SimpleNamespace(id="benchmark", address=f"127.0.0.1:{session.manager.ready['port']}")
    noted: list[float] = []
    handler = logging.Handler()
    handler.emit = lambda record: noted.append(time.monotonic())  # type: ignore[method-assign]
    watch.log.addHandler(handler)
    watching = asyncio.create_task(watch.until_silent(one))
    await asyncio.sleep(CALM_S)
    began_s = time.monotonic()
    os.kill(session.manager.pid, signal.SIGSTOP)
    try:
        await asyncio.wait_for(watching, 60)
    finally:
        watch.log.removeHandler(handler)
        os.kill(session.manager.pid, signal.SIGKILL)
    await session.manager.wait()
    return noted[0] - began_s, time.monotonic() - began_s


def tell(times: Times) -> list[str]:
    """Prints the figures; returns those that took too long."""
    late = []
    for kind, pairs in times.items():
        limit_s = MANAGER_REPORTED_WITHIN_S if kind == "manager" else REPORTED_WITHIN_S
        for name, values, most in [
            ("reported", [pair[0] for pair in pairs], limit_s),
            ("right", [pair[1] for pair in pairs], RIGHT_WITHIN_S),
        ]:
            low, middle, high = min(values), median(values), max(values)
            print(
                f"{kind:12} {name:9} after min {low:5.2f}  median {middle:5.2f}  max {high:5.2f} s"
                f"  ({len(values)} times, at most {most:g} s allowed)"
            )
            late += [f"{kind} {name} after {high:.2f} s"] if high > most else []
    return late


@contextlib.contextmanager
def busy_processors(count: int) -> Iterator[None]:
    """Keeps this many processors busy."""
    burners = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(count)]
    try:
        yield
    finally:
        for burner in burners:
            burner.kill()
            burner.wait()


async def count_false_faults(minutes: float) -> int:
    """Runs, pauses, resets and restarts on a busy machine; returns the number of faults."""
    end_s, faults, cycles = time.monotonic() + minutes * 60, 0, 0
    async with hanging_session() as session:
        while time.monotonic() < end_s:
            await session.runs()
            await asyncio.sleep(CYCLE_S)
            for command in ("pause", "reset_world", "resume", "restart_application"):
                await session.ask(command)
                await asyncio.sleep(1)
            if cycles % 3 == 2:
                await session.ask("disconnect")
            found = session.client.named("fault")
            faults += len(found)
            cycles += 1
            left = max(0.0, end_s - time.monotonic()) / 60
            print(
                f"{cycles:4} cycles, {faults} faults, load {os.getloadavg()[0]:.1f}, {left:.1f} minutes left",
                *(fault["message"] for fault in found),
                flush=True,
            )
            session.client.events.clear()
    return faults


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--rounds", type=int, default=1, help="times that each process is stopped in each state"
    )
    parser.add_argument("--false-faults", type=float, metavar="MINUTES", help="only count false faults")
    parser.add_argument(
        "--busy", type=int, default=os.cpu_count() or 1, help="processors kept busy meanwhile"
    )
    options = parser.parse_args()
    if options.false_faults is not None:
        with busy_processors(options.busy):
            faults = asyncio.run(count_false_faults(options.false_faults))
        print(f"{faults} false faults in {options.false_faults:g} minutes")
        return 1 if faults else 0
    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    django.setup()
    times: Times = {}
    failed: list[str] = []
    asyncio.run(stop_children(options.rounds, times, failed))
    asyncio.run(stop_managers(options.rounds, failed))
    asyncio.run(watch_managers(options.rounds, times, failed))
    failed += tell(times)
    print("\n".join(failed) or "all reported and right in time")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
