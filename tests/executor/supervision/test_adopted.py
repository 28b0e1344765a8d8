"""Ends of a process that was handed over: nothing is believed."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from executor.supervision.adopted import UNKNOWN_CODE, AdoptedProcess
from executor.supervision.channel import socket_pair
from executor.supervision.handover import Arrival, handover_pair
from executor.supervision.signs import Notes


def ends(*, notes_fd: int | None = None) -> list[int]:
    channel, link = socket_pair(), handover_pair()
    notes = Notes()
    out, err = os.pipe(), os.pipe()
    for other in (channel[1], link[1]):
        other.close()
    for fd in (out[1], err[1]):
        os.close(fd)
    if notes_fd is not None:
        notes.close()
        notes.fd = notes_fd
    return [channel[0].detach(), link[0].detach(), notes.fd, out[0], err[0]]


def open_fds() -> int:
    return len(os.listdir("/proc/self/fd"))  # noqa: PTH208 - a count


def test_its_end_is_that_of_the_process() -> None:
    with subprocess.Popen([sys.executable, "-c", "raise SystemExit(3)"]) as popen:
        process = AdoptedProcess(Arrival(0, "0" * 16, popen.pid, ends()))
        assert process.wait() == 3
        assert process.wait() == UNKNOWN_CODE
        for end in (process.channel, process.link, process.stdout, process.stderr):
            end.close()
        os.close(process.notes_fd)


def test_wrong_ends_are_refused_and_closed() -> None:
    before = open_fds()
    empty = os.memfd_create("empty")
    wrong = ends()
    for fds in (wrong[:4], [*ends(), os.dup(1)], list(reversed(ends())), ends(notes_fd=empty), []):
        with pytest.raises(ValueError, match="descriptors"):
            AdoptedProcess(Arrival(0, "0" * 16, 1, list(fds)))
    os.close(wrong[4])
    assert open_fds() == before
