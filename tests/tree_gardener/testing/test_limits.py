from __future__ import annotations

import resource
import signal

import pytest

from tree_gardener.testing.limits import OverLimitError, memory, processor_time


def spin():
    while True:
        pass


def test_processor_time_is_bounded_and_the_bound_is_taken_back():
    before = resource.getrlimit(resource.RLIMIT_CPU)
    with pytest.raises(OverLimitError), processor_time(0.05):
        spin()
    assert signal.getitimer(signal.ITIMER_PROF) == (0.0, 0.0)
    assert resource.getrlimit(resource.RLIMIT_CPU) == before


def test_memory_is_bounded_and_the_bound_is_taken_back():
    before = resource.getrlimit(resource.RLIMIT_AS)
    with pytest.raises(MemoryError), memory(64 << 20):
        bytearray(256 << 20)
    assert resource.getrlimit(resource.RLIMIT_AS) == before
    assert len(bytearray(256 << 20)) == 256 << 20
