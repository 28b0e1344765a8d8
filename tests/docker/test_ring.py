"""An exact run in a small container: its ring of snapshots fits in 1 GB and 128 processes."""

from __future__ import annotations

import asyncio
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING

import pytest
from websockets.exceptions import WebSocketException

from executor.supervision.copies import SNAPSHOT_NAME
from tests.docker.engine import REPOSITORY, build_images, engine
from tests.executor.exact.exact_runs import working_app
from tests.executor.exact.test_process import exact, ready
from tests.executor.session_client import TOKEN, SessionClient

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.docker.engine import Engine

BUILT = os.environ.get("BT_STUDIO_TEST_IMAGES", "")
TAG = BUILT or "test"
PORT = 7163
WANTED = 24
PROFILE = REPOSITORY / "backend" / "sessions" / "keeper" / "seccomp.json"
# As the keeper starts a session, but with half of its memory and processes, and a port instead of the gate.
LIMITS = (
    *("--memory", "1g", "--memory-swap", "1g", "--pids-limit", "128", "--cpus", "1.5", "--shm-size", "256m"),
    *("--read-only", "--tmpfs", "/tmp:rw,nosuid,nodev,noexec,mode=1777,size=256m"),  # noqa: S108
    *("--cap-drop", "ALL", "--security-opt", "no-new-privileges:true"),
    *("--security-opt", f"seccomp={PROFILE}", "--init"),
)
COUNT = (
    "import pathlib; print(sum(p.read_text().strip() == '"
    + SNAPSHOT_NAME
    + "' for p in pathlib.Path('/proc').glob('[0-9]*/comm')))"
)
pytestmark = [pytest.mark.timeout(1800), pytest.mark.simulation]


class Container:
    """A manager in a container that has little."""

    def __init__(self, running: Engine, name: str) -> None:
        self._engine = running
        self.name = name

    @property
    def port(self) -> int:
        """Returns the port of this machine at which the manager is reached."""
        return int(self._engine.run("port", self.name, str(PORT)).stdout.split()[0].rpartition(":")[2])

    def snapshots(self) -> int:
        """Returns the number of snapshots."""
        return int(self._engine.run("exec", self.name, "python", "-c", COUNT).stdout)

    def is_killed(self) -> bool:
        """Returns whether the kernel has killed one of its processes for their memory."""
        asked = self._engine.run("inspect", "--format", "{{.State.OOMKilled}}", self.name)
        return asked.stdout.strip() == "true"


@contextmanager
def container(running: Engine) -> Iterator[Container]:
    """Yields a container with a manager, which is removed at the end."""
    manager = (f"bt-studio-executor:{TAG}", "--host", "0.0.0.0", "--port", str(PORT), "--token-env", "TOKEN")  # noqa: S104
    command = ("run", "-d", "-e", f"TOKEN={TOKEN}", "-p", f"127.0.0.1::{PORT}", *LIMITS, *manager)
    name = running.run(*command).stdout.strip()
    try:
        yield Container(running, name)
    finally:
        running.run("rm", "-f", name)


async def test_a_ring_of_24_fits_and_goes_back(tmp_path_factory: pytest.TempPathFactory) -> None:
    with engine(tmp_path_factory.mktemp("docker")) as running:
        if not BUILT:
            build_images(running, TAG)
        with container(running) as made:
            client = await opened(made.port)
            at = await ready(client, exact(working_app(tick_work_s=0.02)))
            assert await client.ask("set_speed", {"speed": 0.0}) == "ack"
            most, tick = 0, 0
            while most < WANTED and tick < 6000:
                tick += 200
                await client.event("tick", lambda d, tick=tick: d["n"] >= tick, after=at, timeout_s=300)
                most = max(most, made.snapshots())
            assert most >= WANTED
            assert await client.ask("pause") == "ack"
            assert await client.ask("go_back", {"t": 3.0}, timeout_s=120) == "ack"
            assert not made.is_killed()
            print(f"{most} snapshots at tick {tick}")
            await client.close()


async def opened(port: int) -> SessionClient:
    """Connects as soon as the manager listens."""
    async with asyncio.timeout(60):
        while True:
            try:
                return await SessionClient(port).open(stream=False)
            except (OSError, WebSocketException):
                await asyncio.sleep(0.2)
