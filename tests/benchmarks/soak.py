"""Runs, pauses and restarts a session for a long time: `python -m tests.benchmarks.soak --minutes 60`.

Says at the end whether memory, descriptors, processes and shared memory stayed flat, and how far simulated
time drifted from real time while the world ran. Exit status 1 if something grew.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import sys
import time
from dataclasses import dataclass, field
from statistics import median

import psutil

from tests.executor.session_client import SessionClient, manager_process, run_data

RUN_S = 6.0
PAUSE_S = 1.0
WARM_CYCLES = 3
GROWTH_MB = 20.0
GROWTH_FDS = 4


@dataclass
class Sample:
    """The resources of the session, with the application just started."""

    cycle: int
    manager_mb: float
    tree_mb: float
    descriptors: int
    processes: int
    segments: int


@dataclass
class Soak:
    """One session and its measurements."""

    client: SessionClient
    manager: psutil.Process
    samples: list[Sample] = field(default_factory=list)
    drifts: list[float] = field(default_factory=list)
    faults: int = 0

    async def cycle(self, number: int) -> None:
        client = self.client
        if number % 5 == 4:
            await self.ask("disconnect")
        await self.ask("run", run_data())
        self.drifts.append(await self.drift_s())
        await self.ask("pause")
        await asyncio.sleep(PAUSE_S)
        await self.ask("resume")
        await asyncio.sleep(1)
        self.samples.append(self.sample(number))
        await self.ask("restart_application" if number % 3 else "terminate_application")
        self.faults += len(client.named("fault"))
        del client.events[:-50]
        client.frames.clear()

    async def ask(self, command: str, data: object = None) -> None:
        reply = await self.client.ask(command, data)
        if reply != "ack":
            raise SystemExit(f"{command} was refused: {reply}")

    async def drift_s(self) -> float:
        """Returns simulated minus real seconds over one period of running, from the world's own reports."""
        start = len(self.client.events)
        first = await self.client.event("sim", lambda d: not d["paused"], after=start)
        start = len(self.client.events)
        await asyncio.sleep(RUN_S)
        last = await self.client.event("sim", after=max(start, len(self.client.events) - 1))
        return float(last["t"] - first["t"] - (last["at"] - first["at"]))

    def sample(self, cycle: int) -> Sample:
        family = [self.manager, *self.manager.children(recursive=True)]
        used = 0
        for process in family:
            with contextlib.suppress(psutil.Error):
                # Counts private memory only: the shared part of a library depends on the other programs of
                # the machine.
                memory = process.memory_info()
                used += memory.rss - memory.shared
        return Sample(
            cycle,
            self.manager.memory_info().rss / 2**20,
            used / 2**20,
            self.manager.num_fds(),
            len(family),
            len(_segments(family)),
        )

    def verdict(self) -> list[str]:
        """Returns the resources that grew."""
        warm = self.samples[WARM_CYCLES:]
        third = max(1, len(warm) // 3)
        early, late = warm[:third], warm[-third:]

        def growth(name: str) -> float:
            return median(getattr(s, name) for s in late) - median(getattr(s, name) for s in early)

        bounds = {"manager_mb": GROWTH_MB, "tree_mb": GROWTH_MB, "descriptors": GROWTH_FDS, "processes": 1}
        found = [f"{name} grew by {growth(name):.1f}" for name, most in bounds.items() if growth(name) > most]
        for name in (*bounds, "segments"):
            first, last = getattr(warm[0], name), getattr(warm[-1], name)
            print(f"{name:12} first {first:8.1f}  last {last:8.1f}  growth {growth(name):+.1f}")
        return found


def _segments(family: list[psutil.Process]) -> set[str]:
    """Returns the shared memory of Fast DDS that the session's own processes have mapped."""
    found: set[str] = set()
    for process in family:
        with contextlib.suppress(psutil.Error):
            found |= {m.path for m in process.memory_maps() if "/dev/shm/fastrtps" in m.path}  # noqa: S108
    return found


async def soak(minutes: float) -> int:
    """Runs it; returns the exit status."""
    end_s = time.monotonic() + minutes * 60
    async with manager_process() as process:
        client = await SessionClient(process.ready["port"]).open()
        for stream in ("poses", "scan", "camera"):
            await client.ask("subscribe", {"stream": stream})
        it = Soak(client, psutil.Process(process.pid))
        number = 0
        while time.monotonic() < end_s or number <= 2 * WARM_CYCLES:
            await it.cycle(number)
            number += 1
            last, drift_ms = it.samples[-1], it.drifts[-1] * 1000
            print(
                f"{number:4} {last.manager_mb:6.1f} MB {last.tree_mb:6.1f} MB {last.descriptors:3} files "
                f"{last.processes} processes {last.segments} segments, drift {drift_ms:+.0f} ms",
                flush=True,
            )
        await client.close()
    grown = it.verdict()
    drifts = [abs(d) for d in it.drifts]
    print(
        f"{number} cycles, {it.faults} faults; simulated less real time over {RUN_S:g} s: "
        f"median {median(drifts) * 1000:.0f} ms, worst {max(drifts) * 1000:.0f} ms"
    )
    print("; ".join(grown) or "nothing grew")
    return 1 if grown or it.faults else 0


def main() -> int:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    return asyncio.run(soak(parser.parse_args().minutes))


if __name__ == "__main__":
    sys.exit(main())
