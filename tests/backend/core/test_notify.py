"""Notices from any thread reach the consumers in the server's loop; a lost one does no harm."""

from __future__ import annotations

import asyncio

import pytest
from asgiref.sync import async_to_sync
from channels.layers import get_channel_layer
from channels_redis.pubsub import RedisPubSubChannelLayer  # type: ignore[import-untyped]

from backend.core import notify
from backend.core.notify import NoNoticesError, _Teller, following
from tests.backend.services import redis_server


@pytest.fixture
def layer():
    found = get_channel_layer()
    yield found
    async_to_sync(found.flush)()


def test_a_thread_tells_those_who_wait_in_the_loop(layer):
    async def hear():
        teller = _Teller()
        teller.serve(asyncio.get_running_loop())
        channel = await layer.new_channel()
        await layer.group_add("news", channel)
        await asyncio.to_thread(teller.tell, "news", {"type": "news", "number": 1})
        return await layer.receive(channel)

    assert asyncio.run(hear()) == {"type": "news", "number": 1}


def test_without_a_server_the_one_who_tells_sends(layer):
    channel = async_to_sync(layer.new_channel)()
    async_to_sync(layer.group_add)("news", channel)
    _Teller().tell("news", {"type": "news"})
    assert async_to_sync(layer.receive)(channel) == {"type": "news"}


def test_a_notice_that_cannot_be_sent_is_logged_and_no_more(layer, monkeypatch, caplog):
    async def broken(group, notice):
        raise ConnectionError("Redis has gone")

    async def tell():
        teller = _Teller()
        teller.serve(asyncio.get_running_loop())
        teller.tell("news", {"type": "news"})
        await asyncio.sleep(0)
        await asyncio.gather(*teller._sending)

    monkeypatch.setattr(layer, "group_send", broken)
    asyncio.run(tell())
    assert "Redis has gone" in caplog.text


@pytest.mark.parametrize("lost_before", ["new_channel", "group_add"])
def test_a_try_to_follow_that_fails_leaves_no_channel(monkeypatch, lost_before):
    """The layer keeps a channel, and a group, before it asks Redis."""

    async def follow():
        ask = getattr(layer, lost_before)

        async def lose_redis(*arguments):
            server.end()
            return await ask(*arguments)

        monkeypatch.setattr(layer, lost_before, lose_redis, raising=False)
        with pytest.raises(NoNoticesError):
            async with following("news"):
                pass
        assert (layer.channels, layer.groups) == ({}, {})
        await layer.flush()

    monkeypatch.setattr(notify, "PAUSE_S", 0.0)
    with redis_server() as server:
        layer = RedisPubSubChannelLayer(hosts=[server.url])
        monkeypatch.setattr(notify, "get_channel_layer", lambda: layer)
        asyncio.run(follow())
