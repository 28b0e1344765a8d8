"""The recorder of a real session: what it holds, and what it survives."""

from __future__ import annotations

import asyncio
import contextlib
import io
import json
import os
import signal
import urllib.error
import urllib.request
from typing import Any

import psutil
import pytest
from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Message

from executor.manager.identity import USER_HEADER
from executor.messages import RecordingPart
from executor.recorder.cdr import decode
from executor.recorder.definitions import OURS
from executor.recorder.link import BATCH_S
from executor.recorder.ordering import SILENT_S
from executor.recorder.process import LATE_S, LATER_S
from executor.recorder.reader import RecordReader
from tests.executor.session_client import TOKEN, SessionClient, app_zip, manager_process, run_data
from tests.executor.warm import warm_session
from tests.processes import with_word

pytestmark = pytest.mark.simulation

WRITES = """
import py_trees
from tree_gardener.ports import Port, set_output

class Forward(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"lin_speed": Port(float, default=0.3)}
    OUTPUT_PORTS = {"count": Port(int, default="{count}")}
    count = 0

    def update(self):
        self.count += 1
        set_output(self, "count", self.count)
        print("tick", self.count)
        return py_trees.common.Status.RUNNING
"""


def child_of(manager, kind):
    (child,) = with_word(f"executor.{kind}.process", psutil.Process(manager.pid).children())
    return child


@contextlib.asynccontextmanager
async def running(headers=None, **more):
    """Runs an app in a session that other tests use, too."""
    async with warm_session(headers=headers) as (manager, client):
        await begin(client, **more)
        yield manager, client


@contextlib.asynccontextmanager
async def running_alone():
    """Runs an app in a session whose recorder may be harmed."""
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open()
        await begin(client)
        yield manager, client
        await client.close()


async def begin(client, **more):
    before = await runs_before(client)
    assert await client.ask("run", run_data(**more)) == "ack"
    await client.event("segment", lambda data: data["to_t"] > 0.5 and data["run"] not in before)


async def runs_before(client):
    """Returns the runs that were recorded before the client came; their last segments may still come."""
    snapshot = (await client.event("snapshot"))["data"]
    return {segment["run"] for segment in snapshot["segments"]}


async def fetched(manager, run) -> bytes:
    """Returns the file of a run that HTTP gives."""

    def fetch() -> bytes:
        url = f"http://127.0.0.1:{manager.ready['port']}/recordings/{run}/0"
        request = urllib.request.Request(url, headers={"Authorization": f"Bearer {TOKEN}"})
        try:
            with urllib.request.urlopen(request) as answer:  # noqa: S310 - of this manager
                data: bytes = answer.read()
        except urllib.error.HTTPError as error:
            raise AssertionError(error.read().decode()) from error
        return data

    return await asyncio.to_thread(fetch)


async def joined(manager, run):
    """Returns the messages of a run, as (topic, time in s, fields)."""
    data = await fetched(manager, run)
    found: list[tuple[str, float, dict[str, Any]]] = []
    for schema, channel, message in make_reader(io.BytesIO(data)).iter_messages():
        fields = decode(schema.name, message.data) if schema and schema.name.startswith("bt_studio") else {}
        found.append((channel.topic, message.log_time * 1e-9, fields))
    return found


async def joined_with(manager, client, run, topic, text=""):
    """Returns the messages of a run, once they have some of a topic, and with a text if one is given.

    Processes begin a run one by one, and what the manager tells waits for their messages of the same time.
    """
    while True:
        at = len(client.events)  # the last segment may be reported while the file is on its way
        found = await joined(manager, run)
        if any(each == topic and text in fields.get("text", "") for each, _, fields in found):
            return found
        await client.event("segment", after=at)


async def flagged(client, text):
    """Flags the present moment, and waits until the recording reaches it."""
    at = len(client.events)
    assert await client.ask("flag", {"text": text, "user": "somebody else"}) == "ack"
    flag = (await client.event("flag", lambda data: data["text"] == text, after=at))["data"]
    return (
        await client.event("segment", lambda d: d["run"] == flag["run"] and d["to_t"] > flag["t"], after=at)
    )["data"]


async def test_a_run_holds_tree_ticks_world_topics_lines_and_flags():
    async with running({USER_HEADER: "Ada%20L."}) as (manager, client):
        await client.event("tick", lambda data: data["n"] > 20)
        await client.ask("teleop", {"linear": 0.1, "angular": 0.0})
        assert await client.ask("set_tick_rate", {"tick_hz": 20.0}) == "ack"
        segment = await flagged(client, "here")
        found = await joined(manager, segment["run"])
        topics = {topic for topic, _, _ in found}
        assert {"/bt/tree", "/bt/tick", "/bt/keyframe", "/world/scene", "/world/poses"} <= topics
        assert {"/scan", "/odom", "/cmd_vel", "/bt/log"} <= topics
        times = [t for _, t, _ in found]
        assert times == sorted(times)
        numbers = [fields["number"] for topic, _, fields in found if topic == "/bt/tick"]
        assert numbers == list(range(numbers[0], numbers[-1] + 1))
        flags = [(f["text"], f["user"]) for topic, _, f in found if topic == "/bt/flag"]
        assert flags == [("here", "Ada L.")]  # whatever the client says
        inputs = {f["command"]: f for topic, _, f in found if topic == "/bt/input"}
        assert json.loads(inputs["teleop"]["data_json"]) == {"linear": 0.1, "angular": 0.0}
        assert json.loads(inputs["set_tick_rate"]["data_json"]) == {"tick_hz": 20.0}
        for done in inputs.values():
            assert (done["hook"], done["tick"] in numbers) == (-1, True)
            assert abs(done["step"] / 240 - done["stamp"] * 1e-9) < 0.01

        where = {"run": segment["run"], "segment": segment["number"], "version": segment["version"]}
        assert await client.ask("read_recording", where | {"offset": 0, "length": 1 << 20}) == "ack"
        part = await client.until(
            lambda: next((f for _, f in client.frames if isinstance(f, RecordingPart)), None)
        )
        assert any(isinstance(record, Message) for record in RecordReader(io.BytesIO(part.data), "part"))
        wrong = await client.ask("read_recording", where | {"version": 9, "offset": 0, "length": 10})
        assert wrong["code"] == "not_recorded"


async def test_a_second_run_and_a_reset_are_recordings_of_their_own_from_time_0():
    async with running() as (manager, client):
        first = await flagged(client, "one")
        at = len(client.events)
        assert await client.ask("run", run_data()) == "ack"
        known = await runs_before(client) | {first["run"]}
        second = (await client.event("segment", lambda d: d["run"] not in known, after=at))["data"]
        at = len(client.events)
        assert await client.ask("reset_world") == "ack"
        known |= {second["run"]}
        third = (await client.event("segment", lambda d: d["run"] not in known and d["to_t"] > 0, after=at))[
            "data"
        ]
        for segment in (second, third):
            found = await joined_with(manager, client, segment["run"], "/bt/tree")
            poses = [t for topic, t, _ in found if topic == "/world/poses"]
            assert poses[0] < 0.5
        late = await SessionClient(manager.ready["port"]).open(stream=False)
        snapshot = (await late.event("snapshot"))["data"]
        assert {s["run"] for s in snapshot["segments"]} == known | {third["run"]}
        await late.close()


async def test_writes_have_their_writer_and_prints_their_node():
    async with running(app=app_zip(Forward=WRITES)) as (manager, client):
        segment = await flagged(client, "x")
        found = await joined(manager, segment["run"])
        (tree,) = [fields for topic, _, fields in found if topic == "/bt/tree"][:1]
        uid = next(u for u, kind in zip(tree["uid"], tree["type"], strict=True) if kind == "Forward")
        writes = [f for topic, _, f in found if topic == "/bt/blackboard"]
        values = [
            json.loads(v)
            for f in writes
            for k, v in zip(f["key"], f["value_json"], strict=True)
            if k == "count"
        ]
        assert values == list(range(values[0], values[-1] + 1))
        assert {w for f in writes for w in f["writer_uid"]} == {uid}
        lines = [f for topic, _, f in found if topic == "/bt/log" and f["text"].startswith("tick")]
        assert {line["uid"] for line in lines} == {uid}
        written = {
            json.loads(v): f["stamp"]
            for f in writes
            for k, v in zip(f["key"], f["value_json"], strict=True)
            if k == "count"
        }
        printed = {int(line["text"].split()[1]): line["stamp"] for line in lines}
        # A line is printed in the tick of its write.
        inner = [n for n in printed if {n - 1, n, n + 1} <= written.keys()]
        assert inner
        assert [n for n in inner if not written[n - 1] <= printed[n] <= written[n + 1]] == []


def made_of(data: bytes, name: str) -> dict[int, bytes]:
    """Returns the contents that a file had when each tree came, by the generation of the tree."""
    content, found, channels = b"", {}, {}
    for record in RecordReader(io.BytesIO(data), "run"):
        match record:
            case Channel():
                channels[record.id] = record.topic
            case Attachment() if record.name == name:
                content = record.data
            case Message() if channels[record.channel_id] == "/bt/tree":
                found[decode(f"{OURS}/msg/Tree", record.data)["generation"]] = content
            case _:
                pass
    return found


async def test_each_tree_follows_the_files_of_which_it_was_made():
    changed = WRITES.replace('"tick"', '"another tick"')
    async with running(app=app_zip(Forward=WRITES)) as (manager, client):
        run = client.named("segment")[-1]["run"]
        assert await client.ask("apply", {"app_zip_base64": app_zip(Forward=changed)}) == "ack"
        found: dict[int, bytes] = {}
        while 2 not in found:
            at = len(client.events)
            await client.event("segment", after=at)
            found = made_of(await fetched(manager, run), "project/actions/Forward.py")
        assert [source.decode() for source in found.values()] == [WRITES, changed]


def test_a_message_is_on_disk_within_a_second():
    """It waits for its batch, and for that of the other source: at most until that counts as silent."""
    assert BATCH_S + LATER_S < SILENT_S
    assert SILENT_S + LATER_S + LATE_S < 1.0


@pytest.mark.kills
async def test_a_stopped_recorder_is_replaced_and_nothing_waits_for_it():
    async with running_alone() as (manager, client):
        at = len(client.events)
        os.kill(child_of(manager, "recorder").pid, signal.SIGSTOP)
        line = await client.event("log", lambda data: "did not answer" in data["text"], after=at)
        assert line["data"]["level"] == "warning"
        assert client.state == "application_running"
        assert client.named("fault") == []
        await client.event("segment", after=client.events.index(line))


async def test_what_an_action_sends_to_the_recorder_does_not_harm_it():
    attack = """
import contextlib
import socket
import py_trees

class Forward(py_trees.behaviour.Behaviour):
    def update(self):
        with open("/proc/net/unix") as file:
            names = {line.split("@")[1].strip() for line in file if "@bt-studio-recorder" in line}
        for name in names:
            for data in (b"\\xff" * 100, b"\\x05\\x00\\x00\\x00hello", bytes(64)):
                # The recorder may close the connection before all is sent.
                with socket.socket(socket.AF_UNIX) as client, contextlib.suppress(OSError):
                    client.connect("\\0" + name)
                    client.sendall(data)
        return py_trees.common.Status.RUNNING
"""
    async with running(app=app_zip(Forward=attack)) as (manager, client):
        recorder = child_of(manager, "recorder")
        await client.event("tick", lambda data: data["n"] > 40)
        segment = await flagged(client, "still here")
        assert child_of(manager, "recorder").pid == recorder.pid
        found = await joined(manager, segment["run"])
        assert sum(topic == "/bt/tick" for topic, _, _ in found) > 20


async def test_topics_of_the_application_alone_are_recorded():
    talks = """
import py_trees
from std_msgs.msg import String
from tree_gardener.ports import Port

class Forward(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"lin_speed": Port(float, default=0.3)}

    def setup(self, **kwargs):
        self.node = kwargs["node"]
        self.publisher = self.node.create_publisher(String, "/plan_name", 10)

    def update(self):
        self.publisher.publish(String(data="wall"))
        return py_trees.common.Status.RUNNING
"""
    async with running(app=app_zip(Forward=talks)) as (manager, client):
        segment = client.named("segment")[-1]
        await joined_with(manager, client, segment["run"], "/plan_name")
        assert await client.ask("list_topics") == "ack"
        topics = (await client.event("topics"))["data"]["topics"]
        (row,) = [row for row in topics if row["name"] == "/plan_name"]
        assert row["subscribers"] == []
