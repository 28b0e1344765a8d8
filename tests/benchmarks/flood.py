"""The effect of one client's flood of commands on another: a viewer sends 20,000 while the driver drives.

Both are clients of a session that runs, first at the manager itself, then through the web server. The flood
comes from a process of its own and is sent as fast as it is accepted.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import multiprocessing
import statistics
import tempfile
import time
import urllib.request
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from websockets.asyncio.client import ClientConnection, connect

from tests.benchmarks.session import Client
from tests.e2e.server import serving
from tests.executor.session_client import TOKEN, manager_process, run_data

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

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


def told(what: str, times: list[float]) -> str:
    """Returns one figure with its spread."""
    ordered = sorted(times)
    worst, late = ordered[-1], ordered[int(0.99 * (len(ordered) - 1))]
    return f"{what} median {statistics.median(ordered):.1f} ms, p99 {late:.1f} ms, worst {worst:.1f} ms"


async def measure(where: str, url: str, headers: Headers, health: str) -> None:
    """Drives without and with a simultaneous flood, and prints both."""

    def ask_health() -> None:
        with urllib.request.urlopen(health, timeout=60) as reply:
            reply.read()

    async with opened(url, headers) as driver:
        await answered(driver, "run", run_data(), "run")

        async def drive(n: int) -> None:
            await answered(driver, "teleop", {"linear": 0.1, "angular": 0.0}, f"d{n}")

        async def look(_: int) -> None:
            await asyncio.to_thread(ask_health)

        async def both(until: Callable[[], bool]) -> str:
            driven, looked = await asyncio.gather(
                repeated(DRIVE_EVERY_S, drive, until), repeated(HEALTH_EVERY_S, look, until)
            )
            return f"{told('driver', driven)}; {told('/health', looked)}"

        end = time.monotonic() + QUIET_S
        print(f"{where}, quiet: {await both(lambda: time.monotonic() > end)}")
        ours, theirs = multiprocessing.Pipe()
        flooding = multiprocessing.get_context("spawn").Process(
            target=flood_in_process, args=(url, headers, theirs)
        )
        flooding.start()
        print(f"{where}, beside a flood: {await both(lambda: ours.poll() or not flooding.is_alive())}")
        took_s, answers = ours.recv()
        flooding.join()
        print(f"{where}, the flood: {COMMANDS} commands answered in {took_s:.1f} s: {dict(answers)}")
        await answered(driver, "disconnect", {}, "end")


async def at_the_manager() -> None:
    """Measures without a web server."""
    async with manager_process() as process:
        port = process.ready["port"]
        url, headers = f"ws://127.0.0.1:{port}/control", {"Authorization": f"Bearer {TOKEN}"}
        await measure("manager", url, headers, f"http://127.0.0.1:{port}/health")


def through_the_web_server() -> None:
    """Measures through the web server, as browsers do."""
    with tempfile.TemporaryDirectory() as folder, serving(Path(folder)) as server:
        client = Client(server)
        project = client.call("POST", "/projects", {"template": "laser_bump_and_go"})["id"]
        session = client.call("POST", f"/projects/{project}/session")
        cookie = "; ".join(f"{c.name}={c.value}" for c in client.cookies)
        url = server.origin.replace("http", "ws") + session["control_url"]
        headers = {"Cookie": cookie, "Origin": server.origin}
        asyncio.run(measure("web server", url, headers, f"{server.origin}/health/live"))
        with contextlib.suppress(OSError):
            client.call("DELETE", f"/sessions/{session['id']}")


def main() -> None:
    """Prints the figures."""
    asyncio.run(at_the_manager())
    through_the_web_server()


if __name__ == "__main__":
    main()
