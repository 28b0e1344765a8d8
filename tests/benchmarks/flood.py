"""The effect of a flood on others: of commands on a client of the session, of requests on another user.

`--parts clients`: a viewer sends 20,000 commands while the driver drives, first at the manager itself, then
through the web server. The flood comes from a separate process and is sent as fast as it is accepted.
`--parts users`: `user_floods`, with `--rounds`, `--phase-s` and `--kinds`.
"""

from __future__ import annotations

import argparse
import asyncio
import contextlib
import json
import multiprocessing
import statistics
import sys
import tempfile
import time
import urllib.request
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from websockets.asyncio.client import ClientConnection, connect

from tests.benchmarks import user_floods
from tests.benchmarks.figures import Figure, show
from tests.benchmarks.session import Client
from tests.e2e.server import serving
from tests.executor.session_client import TOKEN, manager_process, run_data

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable, Iterable, Sequence

COMMANDS = 20_000
QUIET_S = 5.0
DRIVE_EVERY_S = 0.02
HEALTH_EVERY_S = 0.1
MIX = ("list_topics", "subscribe", "echo_topic", "describe_type")
DATA: dict[str, Any] = {
    "list_topics": {},
    "subscribe": {"stream": "poses", "max_hz": 30},
    "echo_topic": {"topic": "/scan", "max_hz": 5},
    "describe_type": {"type": "sensor_msgs/msg/LaserScan"},
}
Headers = dict[str, str]


def opened(url: str, headers: Headers) -> connect:
    """A control socket."""
    origin = headers.get("Origin")
    rest = {name: value for name, value in headers.items() if name != "Origin"}
    options: dict[str, Any] = {
        "additional_headers": rest,
        "max_size": None,
        "compression": None,
        "proxy": None,
    }
    return connect(url, **options | ({"origin": origin} if origin else {}))


async def flood(url: str, headers: Headers) -> Counter[str]:
    """Sends all commands, and counts the kinds of answers."""
    answers: Counter[str] = Counter()
    async with opened(url, headers) as socket:

        async def read() -> None:
            while answers.total() < COMMANDS:
                message = json.loads(await socket.recv())
                if message["id"].startswith("f") and message["command"] in {"ack", "error"}:
                    answers[message["data"].get("code", "ack")] += 1

        reading = asyncio.create_task(read())
        for n in range(COMMANDS):
            command = MIX[n % len(MIX)]
            await socket.send(json.dumps({"id": f"f{n}", "command": command, "data": DATA[command]}))
        await reading
    return answers


def flood_in_process(url: str, headers: Headers, report: Any) -> None:
    """Runs the flood in a process of its own."""
    began = time.monotonic()
    answers = asyncio.run(flood(url, headers))
    report.send((time.monotonic() - began, answers))


async def answered(socket: ClientConnection, command: str, data: Any, request: str) -> None:
    """Sends a command and waits for its answer."""
    await socket.send(json.dumps({"id": request, "command": command, "data": data}))
    while (message := json.loads(await socket.recv()))["id"] != request:
        pass
    assert message["command"] == "ack", message


async def repeated(
    every_s: float, once: Callable[[int], Awaitable[None]], until: Callable[[], bool]
) -> list[float]:
    """Returns the duration of each command, in ms."""
    times, n = [], 0
    while not until():
        began = time.monotonic()
        await once(n)
        times.append(1000 * (time.monotonic() - began))
        n += 1
        await asyncio.sleep(every_s)
    return times


def spread(what: str, times: list[float]) -> list[Figure]:
    """Returns one time with its spread."""
    ordered = sorted(times)
    late = ordered[int(0.99 * (len(ordered) - 1))]
    values = {"median": statistics.median(ordered), "p99": late, "worst": ordered[-1]}
    return [Figure(f"{what}, {name}", value, "ms") for name, value in values.items()]


async def driving(where: str, url: str, headers: Headers, health: str) -> list[Figure]:
    """Drives without and with a simultaneous flood, and returns the figures of both."""
    figures: list[Figure] = []

    def ask_health() -> None:
        with urllib.request.urlopen(health, timeout=60) as reply:
            reply.read()

    async with opened(url, headers) as driver:
        await answered(driver, "run", run_data(), "run")

        async def drive(n: int) -> None:
            await answered(driver, "teleop", {"linear": 0.1, "angular": 0.0}, f"d{n}")

        async def look(_: int) -> None:
            await asyncio.to_thread(ask_health)

        async def both(when: str, until: Callable[[], bool]) -> None:
            driven, looked = await asyncio.gather(
                repeated(DRIVE_EVERY_S, drive, until), repeated(HEALTH_EVERY_S, look, until)
            )
            figures.extend(spread(f"{where}, {when}: driver", driven))
            figures.extend(spread(f"{where}, {when}: /health", looked))

        end = time.monotonic() + QUIET_S
        await both("quiet", lambda: time.monotonic() > end)
        ours, theirs = multiprocessing.Pipe()
        flooding = multiprocessing.get_context("spawn").Process(
            target=flood_in_process, args=(url, headers, theirs)
        )
        flooding.start()
        await both("beside a flood", lambda: ours.poll() or not flooding.is_alive())
        took_s, answers = ours.recv()
        flooding.join()
        figures.append(Figure(f"{where}: {COMMANDS:,} commands answered in", took_s, "s"))
        figures += [Figure(f"{where}: answers {kind}", count, "") for kind, count in answers.items()]
        await answered(driver, "disconnect", {}, "end")
    return figures


async def at_the_manager() -> list[Figure]:
    """Measures without a web server."""
    async with manager_process() as process:
        port = process.ready["port"]
        url, headers = f"ws://127.0.0.1:{port}/control", {"Authorization": f"Bearer {TOKEN}"}
        return await driving("manager", url, headers, f"http://127.0.0.1:{port}/health")


def through_the_web_server() -> list[Figure]:
    """Measures through the web server, as browsers do."""
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as server:
        client = Client(server)
        project = client.call("POST", "/projects", {"template": "laser_bump_and_go"})["id"]
        session = client.call("POST", f"/projects/{project}/session")
        cookie = "; ".join(f"{c.name}={c.value}" for c in client.cookies)
        url = server.origin.replace("http", "ws") + session["control_url"]
        headers = {"Cookie": cookie, "Origin": server.origin}
        figures = asyncio.run(driving("web server", url, headers, f"{server.origin}/health/live"))
        with contextlib.suppress(OSError):
            client.call("DELETE", f"/sessions/{session['id']}")
        return figures


def of_clients() -> Iterable[Figure]:
    """Yields the figures at the manager, then those through the web server."""
    yield from asyncio.run(at_the_manager())
    yield from through_the_web_server()


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields the figures of both parts."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--parts", nargs="+", choices=["clients", "users"], default=["clients", "users"])
    parts = parser.parse_known_args(options)[0].parts
    if "clients" in parts:
        yield from of_clients()
    if "users" in parts:
        yield from user_floods.measure(options)


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


if __name__ == "__main__":
    main()
