"""Processor time of all web processes for a save, at one web server and spread over two.

`python -m tests.benchmarks two_servers [--rounds 10] [--saves 400] [--editors 40]`. Two servers on one
PostgreSQL and one Redis. In each round the same editors, who do not pause, save at one server alone, and half
of them at each; the order changes from round to round. Counted is user and system time of the process that
the saves reach, or of both, so that it holds on a busy machine, too: look at the ratio. PostgreSQL notes each
lock that is waited for longer than 1 ms.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import statistics
import tempfile
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tests.backend.services import cluster, redis
from tests.backend.serving import serving
from tests.benchmarks.editors import Measured
from tests.benchmarks.load import settings_of, sign_in
from tests.benchmarks.save_cost import Server

if TYPE_CHECKING:
    from tests.backend.services import Cluster

CONNECTIONS: Final = 120
NOTED: Final = {"log_lock_waits": "on", "deadlock_timeout": "1ms"}
WAITS: Final = "still waiting for"


class Alternately:
    """The rounds at one server, and at both.

    Attributes:
        ms: processor time for a save in each round, by the number of servers.
        waits: locks that were waited for in all rounds, by the number of servers.
    """

    def __init__(self, places: dict[int, list[Server]], database: Cluster, saves: int) -> None:
        self._places, self._database, self._saves = places, database, saves
        self.ms: dict[int, list[float]] = {1: [], 2: []}
        self.waits = {1: 0, 2: 0}

    async def measure(self, number: int) -> None:
        """Measures saves of all editors at one server, or of half of them at each of two."""
        servers, waits = self._places[number], self._waits()
        each = self._saves // sum(len(server.editors) for server in servers)
        before = sum(server.cpu_s() for server in servers)
        await asyncio.gather(*(server.save(each) for server in servers))
        saves = each * sum(len(server.editors) for server in servers)
        self.ms[number].append(1000 * (sum(server.cpu_s() for server in servers) - before) / saves)
        self.waits[number] += self._waits() - waits

    def _waits(self) -> int:
        return self._database.said().count(WAITS)

    def report(self, measured: Measured, saves: int) -> None:
        """Prints medians and ratios."""
        errors = measured.errors or "none"
        print(f"load average {os.getloadavg()[0]:.1f}, nice {os.nice(0)}; errors: {errors}")
        for number, ms in self.ms.items():
            share = 100 * self.waits[number] / saves
            spread = f"{min(ms):.2f} to {max(ms):.2f}"
            waited = f"{share:.2f} % of {saves} saves waited for a lock"
            print(f"{number} web server(s): {statistics.median(ms):.2f} ms a save ({spread}); {waited}")
        ratios = [two / one for one, two in zip(self.ms[1], self.ms[2], strict=True)]
        print(f"ratio {statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f}); target 1.1")


async def measure(
    places: dict[int, list[Server]],
    people: list[tuple[str, str]],
    database: Cluster,
    rounds: int,
    saves: int,
) -> None:
    """Prepares both servers, then measures."""
    measured = Measured()
    half, (alone,), (first, second) = len(people) // 2, places[1], places[2]
    await alone.open(people[: 2 * half], 0, measured)
    await first.open(people[:half], 2, measured)
    await second.open(people[half : 2 * half], 3, measured)
    alternately = Alternately(places, database, saves)
    for number in range(rounds):
        for kind in (1, 2) if number % 2 else (2, 1):
            await alternately.measure(kind)
    alternately.report(measured, rounds * saves)


def main() -> None:
    """Starts the servers, and measures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--saves", type=int, default=400)
    parser.add_argument("--editors", type=int, default=40)
    options, _ = parser.parse_known_args()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        # The web processes do not pay for waiting for the disk.
        database = stack.enter_context(cluster(fsync="off", max_connections=CONNECTIONS, **NOTED))
        services = {
            "BT_STUDIO_DATABASE_URL": database.url,
            "BT_STUDIO_REDIS_URL": stack.enter_context(redis()),
        }
        servers = []
        for name in ("first", "second"):
            own = folder / name
            own.mkdir()
            settings, port = settings_of(services)
            log = stack.enter_context((own / "log").open("wb"))
            running = serving(own, "--port", str(port), "--workers", "1", log=log, **settings)
            servers.append(stack.enter_context(running))
        places = {
            1: [Server("all", servers[0])],
            2: [Server("first", servers[0]), Server("second", servers[1])],
        }
        people = sign_in(folder / "first", settings, options.editors)
        asyncio.run(measure(places, people, database, options.rounds, options.saves))


if __name__ == "__main__":
    main()
