"""A process of a recorded session is killed, or the disk is full: what a client saw is in the recording."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING, Any

import psutil
import pytest
from mcap.reader import make_reader

from executor.messages import Poses
from executor.recorder.joining import join_newest
from tests.budget import count
from tests.executor.recorder.test_process import child_of, joined, joined_with, running, running_alone
from tests.executor.session_client import SessionClient, manager_process, run_data

if TYPE_CHECKING:
    from pathlib import Path

LOST_S = 1.0
LOST_WITH_MANAGER_S = 2.0
FEW_BYTES = 300_000

pytestmark = pytest.mark.simulation


def seen_s(client: SessionClient) -> float:
    """Returns the simulated time of the last frame that a client got."""
    return max(frame.t for _, frame in client.frames if isinstance(frame, Poses))


async def watched(client: SessionClient, turn: int) -> float:
    """Watches the world until a moment that differs in each turn; returns the last time that was seen."""
    assert await client.ask("subscribe", {"stream": "poses", "max_hz": 30.0}) == "ack"
    until_s = 1.2 + 0.13 * turn
    await client.until(lambda: any(isinstance(f, Poses) and f.t >= until_s for _, f in client.frames))
    return seen_s(client)


def last_s(found: list[tuple[str, float, dict[str, Any]]], topic: str, until_s: float = 1e9) -> float:
    return max(t for each, t, _ in found if each == topic and t <= until_s)


def end_of(scratch: Path) -> float:
    """Returns the time in s up to which the recording in a folder for temporary files holds the world."""
    (folder,) = scratch.glob("*/recordings")
    out = scratch / "run.mcap"
    assert join_newest(folder, out)
    with out.open("rb") as file:
        times = [message.log_time for _, _, message in make_reader(file).iter_messages(["/world/poses"])]
    return times[-1] * 1e-9


@pytest.mark.parametrize(("kind", "topic"), [("world", "/world/poses"), ("application", "/bt/tick")])
@pytest.mark.parametrize("turn", range(count("executor_recorder_kills")))
async def test_a_killed_source_loses_less_than_a_second(kind: str, topic: str, turn: int) -> None:
    async with running() as (manager, client):
        seen = await watched(client, turn)
        run = client.named("segment")[-1]["run"]
        at = len(client.events)
        child_of(manager, kind).send_signal(signal.SIGKILL)
        fault = await client.event("fault", after=at)
        assert fault["data"]["kind"]
        found = await joined_with(manager, client, run, "/bt/fault")
        assert last_s(found, topic) >= seen - LOST_S


@pytest.mark.kills
@pytest.mark.parametrize("turn", range(count("executor_recorder_kills")))
async def test_a_killed_recorder_loses_less_than_a_second_and_the_run_continues(turn: int) -> None:
    async with running_alone() as (manager, client):
        seen = await watched(client, turn)
        segment = client.named("segment")[-1]
        at = len(client.events)
        child_of(manager, "recorder").send_signal(signal.SIGKILL)
        line = await client.event("log", lambda data: "recorder" in data["text"], after=at)
        assert "Another one records from here; the run continues." in line["data"]["text"]
        assert client.state == "application_running"
        await client.event(
            "segment", lambda d: d["number"] > segment["number"] and d["to_t"] > seen, after=at
        )
        await client.event("tick", after=len(client.events))
        found = await joined_with(manager, client, segment["run"], "/bt/log", "recorder was ended at once")
        assert last_s(found, "/world/poses", seen) >= seen - LOST_S
        numbers = [fields["number"] for topic, _, fields in found if topic == "/bt/tick"]
        assert numbers == sorted(set(numbers))


@pytest.mark.kills
@pytest.mark.parametrize("turn", range(count("executor_recorder_kills")))
async def test_a_killed_manager_loses_less_than_two_seconds(tmp_path: Path, turn: int) -> None:
    async with manager_process(env={"TMPDIR": str(tmp_path)}) as manager:
        client = await SessionClient(manager.ready["port"]).open()
        assert await client.ask("run", run_data()) == "ack"
        seen = await watched(client, turn)
        children = psutil.Process(manager.pid).children(recursive=True)
        manager.kill()
        await manager.wait()
        _, alive = psutil.wait_procs(children, timeout=60)
        assert alive == []
        assert end_of(tmp_path) >= seen - LOST_WITH_MANAGER_S
        await client.close()


@pytest.mark.kills
async def test_a_full_disk_ends_the_recording_and_not_the_run() -> None:
    async with running_alone() as (manager, client):
        run = client.named("segment")[-1]["run"]
        at = len(client.events)
        # The kernel refuses to write more into a file, as on a full disk.
        child_of(manager, "recorder").rlimit(psutil.RLIMIT_FSIZE, (FEW_BYTES, FEW_BYTES))
        line = await client.event("log", lambda data: "recording stops" in data["text"], after=at)
        assert line["data"]["text"] == "The recording stops here: File too large. The run continues."
        whole = [s for s in client.named("segment") if s["run"] == run][-1]
        await client.event("tick", after=len(client.events))
        assert client.state == "application_running"
        found = await joined(manager, run)
        assert last_s(found, "/bt/tick") >= whole["to_t"] - LOST_S
        before = len(client.events)
        assert await client.ask("run", run_data()) == "ack"  # the next one is recorded, up to the same limit
        await client.event("segment", lambda d: d["run"] != run, after=before)
