"""A client that sends without end: it gets answers, and does not delay the other clients."""

from __future__ import annotations

import asyncio
import json
import urllib.request
from collections import Counter
from typing import Any

import pytest

from executor.manager.allowance import BURST, COSTS, RATE_HZ
from executor.manager.server import COMMANDS_IN_TURN
from executor.session.clients import MOST_ECHOED_BY_VIEWER
from executor.stream import outbox as outboxes
from executor.stream.outbox import ControlOutbox
from tests.executor.manager.test_server import RUN, manager
from tests.executor.session_client import SessionClient

FLOOD = 20_000
# The turns of the event loop between another client's command and its answer. In each, the server handles
# `COMMANDS_IN_TURN` commands of a flood.
TURNS = 40


async def flood(client, command, count=FLOOD, data=None):
    """Sends without waiting for answers, and returns how each command was answered."""
    text = json.dumps(data)
    replies: Counter[Any] = Counter()
    for n in range(count):
        await client.control.send(f'{{"id": "f{n}", "command": "{command}", "data": {text}}}')
    ids = {f"f{n}" for n in range(count)}

    def all_answered():
        for event in client.events:
            if event["id"] in ids:
                ids.discard(event["id"])
                replies[event["data"]["code"] if event["command"] == "error" else "ack"] += 1
        client.events.clear()
        return not ids

    await client.until(all_answered, 100)
    return replies


@pytest.mark.parametrize("command", ["list_topics", "subscribe", "take_over", "ping", "nonsense"])
async def test_every_command_of_a_flood_is_answered_once(command):
    count = 3000
    async with manager() as it:
        driver = await SessionClient(it.port).open()
        await driver.ask("run", RUN)
        viewer = await SessionClient(it.port).open()
        began_s = asyncio.get_running_loop().time()
        data = {"stream": "poses"} if command == "subscribe" else None
        replies = await flood(viewer, command, count, data)
        took_s = asyncio.get_running_loop().time() - began_s
        most = (BURST + took_s * RATE_HZ) / COSTS.get(command, 1.0) + 1
        assert sum(replies.values()) == count
        assert set(replies) <= {"too_fast", "unknown_command" if command == "nonsense" else "ack"}
        assert replies["too_fast"] >= count - most
        refused = await viewer.ask("ping")
        assert refused == "ack" or "Wait" in refused["hint"]
        await driver.close()
        await viewer.close()


async def test_a_driver_is_served_between_the_commands_of_a_flood():
    async with manager() as it:
        driver = await SessionClient(it.port).open()
        await driver.ask("run", RUN)
        viewer = await SessionClient(it.port).open()
        handled = it._server.traffic
        before = handled.commands
        flooding = asyncio.create_task(flood(viewer, "list_topics"))
        between = []
        while not flooding.done():
            sent_at = handled.commands
            assert await driver.ask("teleop", {"linear": 0.1, "angular": 0.0}) == "ack"
            between.append(handled.commands - sent_at)
            health = await asyncio.to_thread(urllib.request.urlopen, f"http://127.0.0.1:{it.port}/health")
            with health:
                assert health.status == 200
            await asyncio.sleep(0.02)  # the pace is the test: a page sends no more than this while it drives
        assert sum((await flooding).values()) == FLOOD
        assert handled.commands - before >= FLOOD
        assert len(between) > 5, "the driver was answered while the flood lasted"
        assert max(between) <= TURNS * COMMANDS_IN_TURN
        await driver.close()
        await viewer.close()


async def test_a_viewer_leaves_topics_to_echo_for_the_driver():
    async with manager() as it:
        driver = await SessionClient(it.port).open()
        await driver.ask("run", RUN)
        viewer = await SessionClient(it.port).open()
        replies = [await viewer.ask("echo_topic", {"topic": f"/t{n}"}) for n in range(20)]
        assert replies[:MOST_ECHOED_BY_VIEWER] == ["ack"] * MOST_ECHOED_BY_VIEWER
        assert {reply["code"] for reply in replies[MOST_ECHOED_BY_VIEWER:]} == {"too_many"}
        assert await viewer.ask("echo_topic", {"topic": "/t0", "max_hz": 5}) == "ack", "it has that one"
        assert await viewer.ask("echo_topic", {"topic": "/t0", "max_hz": 0}) == "ack"
        assert await viewer.ask("echo_topic", {"topic": "/other"}) == "ack"
        assert [await driver.ask("echo_topic", {"topic": f"/t{n}"}) for n in range(20)] == ["ack"] * 20
        await driver.close()
        await viewer.close()


async def test_commands_of_a_client_that_reads_no_answers_are_not_handled(monkeypatch):
    monkeypatch.setattr(outboxes, "MAX_REPLIES", 500)
    async with manager() as it:
        client = await SessionClient(it.port).open()
        waiting = it._server._controls[client.id]
        client.control.transport.pause_reading()
        text = json.dumps({"id": "n" * 1000, "command": "ping", "data": None})
        sending = asyncio.create_task(send_until_stuck(client, text))
        async with asyncio.timeout(60):
            while len(waiting._messages) < 500:  # noqa: ASYNC110 - the queue has no event for it
                await asyncio.sleep(0)
        other = await SessionClient(it.port).open()
        # Each answer takes some turns of the event loop, in which the server would handle more of the flood.
        for _ in range(TURNS):
            assert await other.ask("ping") == "ack"
        assert len(waiting._messages) <= 500 + COMMANDS_IN_TURN
        before = it._server.traffic.commands
        client.control.transport.resume_reading()
        await client.until(lambda: len(client.events) > before)
        sending.cancel()
        await asyncio.gather(sending, return_exceptions=True)
        await other.close()
        await client.close()


async def send_until_stuck(client, text):
    while True:
        await client.control.send(text)


async def test_the_stream_socket_takes_nothing_and_there_is_one_a_client():
    async with manager() as it:
        client = await SessionClient(it.port).open()
        first = client.stream
        second = await client._connect(f"/stream?client={client.id}")
        await asyncio.wait_for(first.wait_closed(), 60)
        assert first.close_code == 4409
        await second.send("hello")
        await asyncio.wait_for(second.wait_closed(), 60)
        assert second.close_code == 1003
        assert await client.ask("ping") == "ack"
        await client.close()


async def test_replies_that_wait_are_not_sorted_again_and_again(monkeypatch):
    monkeypatch.setattr(outboxes, "MAX_MESSAGES", 5)
    outbox = ControlOutbox(lambda: b"snapshot")
    for n in range(50):
        outbox.put(b"reply %d" % n, is_reply=True)
    outbox.put(b"event", is_reply=False)
    taken = [await outbox.take() for _ in range(51)]
    assert taken[-1] == b"event", "replies alone are no backlog that a snapshot could stand for"


async def test_a_watching_client_is_answered_without_a_queue():
    async with manager() as it:
        client = SessionClient(it.port)
        watch = await client._connect("/watch")
        assert (await (await watch.ping())) >= 0
        assert it._server.traffic.clients == 0
        assert it._server._controls == {}
        await watch.send("hello")
        await asyncio.wait_for(watch.wait_closed(), 60)
        assert watch.close_code == 1003
