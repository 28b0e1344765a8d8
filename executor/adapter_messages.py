"""Messages between the manager and debugpy's adapter; others are in `executor.child_messages`."""

from __future__ import annotations

from typing import Final

import msgspec

from executor.child_messages import Log, Message, Stop


class StartAdapter(Message, tag="start"):
    """Starts the adapter; only a program that shows `token` may connect to it."""

    token: str


class AdapterText(Message, tag="text"):
    """A message of the Debug Adapter Protocol, as JSON, to or from the adapter."""

    text: bytes


ToAdapter = StartAdapter | AdapterText | Stop
FromAdapter = AdapterText | Log
decode_to_adapter: Final = msgspec.msgpack.Decoder(ToAdapter).decode
decode_from_adapter: Final = msgspec.msgpack.Decoder(FromAdapter).decode
