"""Processor time of the web process for a save, with and without each of its fast paths.

`python -m tests.benchmarks.save_cost [--pieces NAME …] [--rounds 10] [--saves 120] [--editors 40]`. One
server for each piece that is left out (`without.py`), one with all pieces and one without any, on one
PostgreSQL and one Redis. In each round each server gets the same saves by editors who do not pause, one
server after the other, in another order each time. Printed are medians over the rounds. The time is user and
system time of the one process that answers requests, so that it holds on a busy machine, too: look at the
ratios.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import statistics
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path

import psutil

from tests.backend.services import postgresql, redis
from tests.backend.serving import Served, serving
from tests.benchmarks.editors import Editor, Measured
from tests.benchmarks.load import settings_of, sign_in
from tests.benchmarks.timing import processor_s
from tests.benchmarks.without import ALL, PIECES

WITH_ALL = ""
CONNECTIONS = 40
"""To the database, for each server: Django's handler makes one a request."""
WARM_UP = 3
"""Saves of each editor before the first round."""


@dataclass
class Server:
    """A web server without the pieces that `without` names, and its editors."""

    without: str
    served: Served
    editors: list[Editor] = field(default_factory=list)
    ms_a_save: list[float] = field(default_factory=list)

    def cpu_s(self) -> float:
        """Processor time of the web process so far, without its children."""
        return processor_s(psutil.Process(self.served.process.pid))

    async def open(self, people: list[tuple[str, str]], own: int, measured: Measured) -> None:
        """Connects the editors, and lets them save until all caches are warm."""
        numbers = range(own * len(people), (own + 1) * len(people))
        self.editors = [
            Editor(number, self.served.port, person, measured)
            for number, person in zip(numbers, people, strict=True)
        ]
        for editor in self.editors:
            await editor.open()
        await self.save(WARM_UP)

    async def save(self, each: int) -> None:
        """Makes this many saves for each editor, all editors at the same time."""

        async def work(editor: Editor) -> None:
            for _ in range(each):
                await editor.save()

        await asyncio.gather(*map(work, self.editors))

    async def measure(self, each: int) -> None:
        """Records the cost of a save."""
        before = self.cpu_s()
        await self.save(each)
        self.ms_a_save.append(1000 * (self.cpu_s() - before) / (each * len(self.editors)))


async def rounds(servers: list[Server], number: int, each: int) -> None:
    """Runs each server once in each round, with a different one first each time."""
    for start in range(number):
        first = start % len(servers)
        for server in servers[first:] + servers[:first]:
            await server.measure(each)


def report(servers: list[Server], measured: Measured) -> None:
    """Prints the gain of each fast path."""
    full = servers[0].ms_a_save
    print(f"load average {os.getloadavg()[0]:.1f}, nice {os.nice(0)}; errors: {measured.errors or 'none'}")
    print(f"{'without':22} {'ms a save':>10} {'more':>7} {'ratio':>6}   least to most")
    for server in servers:
        own = server.ms_a_save
        more = statistics.median(here - there for here, there in zip(own, full, strict=True))
        ratio = statistics.median(here / there for here, there in zip(own, full, strict=True))
        name = server.without or "(nothing)"
        spread = f"{min(own):.2f} to {max(own):.2f}"
        print(f"{name:22} {statistics.median(own):10.2f} {more:+7.2f} {ratio:6.2f}   {spread}")


async def measure(servers: list[Server], people: list[tuple[str, str]], number: int, saves: int) -> None:
    """Prepares all servers, then measures."""
    measured = Measured()
    for own, server in enumerate(servers):
        await server.open(people, own, measured)
    await rounds(servers, number, max(1, saves // len(people)))
    report(servers, measured)


def main() -> None:
    """Starts the servers, and measures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pieces", nargs="+", default=[*PIECES, ALL], metavar="NAME")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--saves", type=int, default=120)
    parser.add_argument("--editors", type=int, default=40)
    options, _ = parser.parse_known_args()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        # The web process does not pay for waiting for the disk.
        database = postgresql(fsync="off", max_connections=CONNECTIONS * (len(options.pieces) + 2))
        services = {
            "BT_STUDIO_DATABASE_URL": stack.enter_context(database),
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
        servers = []
        for number, pieces in enumerate([WITH_ALL, *options.pieces]):
            own = folder / str(number)
            own.mkdir()
            settings, port = settings_of(services)
            program = ("-m", "tests.benchmarks.without", pieces)
            running = serving(own, "--port", str(port), program=program, **settings)
            servers.append(Server(pieces, stack.enter_context(running)))
        people = sign_in(folder / "0", settings, options.editors)
        asyncio.run(measure(servers, people, options.rounds, options.saves))


if __name__ == "__main__":
    main()
