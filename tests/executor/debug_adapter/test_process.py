"""debugpy's adapter as a process of its own."""

from __future__ import annotations

import subprocess
import sys

import msgspec
import pytest

from executor.adapter_messages import (
    AdapterText,
    FromAdapter,
    StartAdapter,
    ToAdapter,
    decode_from_adapter,
)
from executor.child_messages import Stop
from executor.debug_adapter.process import main
from executor.supervision.channel import Channel, socket_pair

INITIALIZE = {"seq": 1, "type": "request", "command": "initialize", "arguments": {"adapterID": "debugpy"}}


def test_it_answers_until_the_manager_ends_it():
    ours, theirs = socket_pair()
    arguments = [sys.executable, "-m", "executor.debug_adapter.process", "--channel-fd", str(theirs.fileno())]
    with theirs, subprocess.Popen(arguments, pass_fds=[theirs.fileno()]) as process:
        theirs.close()
        channel: Channel[ToAdapter, FromAdapter] = Channel(ours.detach(), decode_from_adapter)
        try:
            channel.send(StartAdapter("secret"))
            channel.send(AdapterText(msgspec.json.encode(INITIALIZE)))
            while True:
                message = channel.receive(30)
                assert isinstance(message, AdapterText)
                told = msgspec.json.decode(message.text)
                if told["type"] == "response":
                    break
            assert (told["request_seq"], told["success"]) == (1, True)
            channel.send(Stop())
            assert process.wait(30) == 0
        finally:
            process.kill()
            channel.close()


def test_it_needs_a_channel():
    with pytest.raises(SystemExit):
        main([])
