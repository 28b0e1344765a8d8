"""The order to follow a program comes by standard input; what is no order ends the session."""

from __future__ import annotations

import asyncio
import os
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import pytest

from executor.manager.order import Order, await_order

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def server(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """The end of standard input at which the server writes."""
    reader, writer = os.pipe()
    with os.fdopen(reader) as ours, os.fdopen(writer, "wb", buffering=0) as theirs:
        monkeypatch.setattr(sys, "stdin", ours)
        yield theirs


@pytest.mark.parametrize(
    ("line", "told"),
    [
        (b'{"target":"robot:1667","recordings":"/r"}\n', Order("robot:1667", "/r")),
        (b'{"target":"robot:1667"}\n', Order("robot:1667")),
        (b"hello\n", "cannot read what to follow"),
        (b'{"target":3}\n', "cannot read what to follow"),
        (b"\xff" * 5000, "cannot read what to follow"),
    ],
)
async def test_a_line_is_an_order_or_ends_the_session(
    monkeypatch: pytest.MonkeyPatch, line: bytes, told: Order | str
) -> None:
    heard: asyncio.Future[Order | str] = asyncio.get_running_loop().create_future()
    with server(monkeypatch) as theirs:
        await_order(heard.set_result, heard.set_result)
        theirs.write(line)
        found = await asyncio.wait_for(heard, 60)
    assert found == told if isinstance(told, Order) else told in str(found)


async def test_the_end_of_the_server_is_no_order(monkeypatch: pytest.MonkeyPatch) -> None:
    said: list[object] = []
    with server(monkeypatch) as theirs:
        await_order(said.append, said.append)
        theirs.close()
        for _ in range(5):
            await asyncio.sleep(0)
    assert said == []
