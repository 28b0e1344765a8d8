"""Notices to all open pages."""

from __future__ import annotations

import json
from typing import Any

from backend.projects.api.open_pages import Pages


async def test_each_page_is_notified_once() -> None:
    sent: list[dict[str, Any]] = []
    pages = Pages()

    async def send(message: Any) -> None:
        sent.append(message)

    pages.join(send)
    await pages.tell("Back at 15:00.")
    await pages.tell("Back at 15:00.")
    await pages.tell("")
    pages.leave(send)
    await pages.tell("again")
    assert [json.loads(message["text"])["text"] for message in sent] == ["Back at 15:00.", ""]


async def test_a_page_that_is_gone_keeps_nothing_from_the_others() -> None:
    heard = []
    pages = Pages()

    async def broken(message: Any) -> None:
        raise OSError("gone")

    async def send(message: Any) -> None:
        heard.append(message)

    pages.join(broken)
    pages.join(send)
    await pages.tell("x")
    assert len(heard) == 1
