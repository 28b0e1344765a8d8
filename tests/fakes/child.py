"""Children for the manager, good and bad: `python child.py HABIT --channel-fd N`."""

from __future__ import annotations

import argparse
import os
import signal
import sys
import tempfile
import time
from typing import Any

import msgspec

from executor.child_messages import Frame
from executor.messages import View
from executor.supervision.channel import Channel, ChannelClosed
from executor.supervision.confine import die_with_parent
from executor.supervision.pulse import Pulse

FRAME = msgspec.msgpack.encode(View(t=0.0, width=1, height=1, jpeg=b""))
READY = {"type": "ready", "renderer": "fake", "tf": False, "universe": "Fake"}
ANSWERS = {"pause": "paused", "resume": "resumed", "step": "stepped", "set_blackboard": "blackboard_set"}


def obey(channel, pulse, *, on_start=lambda: None):
    """Obeys messages until it is stopped; a child whose start has an `app_dir` is an application."""
    pulse.rests()
    answers = {}
    while True:
        pulse.moved()
        pulse.clocks += 1
        message = channel.receive(0.1)
        if message is None:
            continue
        match message["type"]:
            case "start":
                channel.send({"type": "starting"})
                answers = ANSWERS if "app_dir" in message else {}
                with pulse.busy("starting"):
                    on_start()
                channel.send(READY)
            case "subscribe":
                channel.send(Frame(message["client"], message["stream"], FRAME))
            case _ if message.get("request"):
                channel.send({"type": "answer", "request": message["request"]})
            case "exit":
                os._exit(message.get("code", 0))
            case "say":
                channel.send(message["message"])
            case "stop":
                return
            case type_ if type_ in answers:
                channel.send({"type": answers[type_]})


def flood():
    for n in range(100_000):
        sys.stdout.write(f"line {n}\n")
    sys.stdout.flush()


def leave_daemon():
    """Starts a process that leaves our group and would outlive us."""
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            while True:
                time.sleep(1)  # it lives until it is killed
        os._exit(0)


def fork_many():
    for _ in range(100):
        if os.fork() == 0:
            while True:
                time.sleep(1)  # it lives until it is killed


def leak():
    hoard = []
    while True:
        hoard.append(b"x" * 10_000_000)


def burn():
    while True:
        pass


def write_much():
    signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # Python ignores it, other programs end by it
    with tempfile.TemporaryFile() as file:
        while True:
            file.write(b"x" * 1_000_000)


def hang():
    time.sleep(3600)  # it does nothing until it is killed


def die(code):
    sys.stderr.write("last words\n")
    sys.stderr.flush()
    os._exit(code)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("habit")
    parser.add_argument("--channel-fd", type=int, required=True)
    arguments = parser.parse_args()
    die_with_parent()
    channel: Channel[Any, Any] = Channel(arguments.channel_fd, msgspec.msgpack.decode)
    pulse = Pulse(channel.send)
    habits = {
        "good": lambda: obey(channel, pulse),
        "dies_at_start": lambda: die(3),
        "dies_when_started": lambda: obey(channel, pulse, on_start=lambda: die(4)),
        "never_ready": hang,
        "floods": lambda: obey(channel, pulse, on_start=flood),
        "daemon": lambda: obey(channel, pulse, on_start=leave_daemon),
        "forks": lambda: obey(channel, pulse, on_start=fork_many),
        "leaks": lambda: obey(channel, pulse, on_start=leak),
        "burns": lambda: obey(channel, pulse, on_start=burn),
        "writes": lambda: obey(channel, pulse, on_start=write_much),
        "closes_pipe": lambda: (channel.close(), hang()),
        "talks_rubbish": lambda: (os.write(arguments.channel_fd, b"\xff" * 100), hang()),
    }
    if arguments.habit == "ignores_signals":
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        hang()
    try:
        habits[arguments.habit]()
    except ChannelClosed:
        return


if __name__ == "__main__":
    main()
