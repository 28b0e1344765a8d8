"""The processes that a server starts fit into the memory of its container."""

from __future__ import annotations

import pytest

from backend.config.environment import environment
from backend.core.processes.memory import (
    ANSWERS_MIB,
    MEBIBYTE,
    MESSAGE_MIB,
    WORKER_MIB,
    Processes,
    fitting,
    limit_mib,
)
from backend.workers.pool import KEPT_BYTES

UNREAD = 256 * MEBIBYTE


def processes(cores, limit, *, mode="team", workers=0, large=0, unread=UNREAD):
    asked = {"workers": workers, "large": large, "each_mib": 1024, "unread_bytes": unread}
    return fitting(mode, cores, limit, **asked)


@pytest.mark.parametrize(
    ("cores", "expected"), [(1, (1, 2)), (2, (1, 2)), (4, (3, 4)), (32, (31, 32))], ids=str
)
def test_without_a_limit_they_follow_the_processors(cores, expected):
    found = processes(cores, None)
    assert (found.workers, found.large) == expected


@pytest.mark.parametrize("limit", [5632, 6144, 9000, 16384, 65536])
@pytest.mark.parametrize("cores", [1, 2, 4, 8, 64, 256])
def test_what_is_chosen_fits(cores, limit):
    found = processes(cores, limit)
    assert found.needed_mib() <= limit
    assert found.workers <= max(1, cores - 1)
    assert found.large <= max(2, cores)


def test_more_memory_starts_more_processes():
    found = [processes(64, limit) for limit in (5632, 6144, 16384, 65536)]
    assert found == sorted(found)
    assert len(set(found)) == len(found)


def test_what_is_configured_is_kept_though_it_does_not_fit():
    found = processes(64, 1024, workers=8, large=12)
    assert (found.workers, found.large) == (8, 12)
    assert found.needed_mib() > 1024
    assert processes(64, 1024) == Processes(1, 2, 2, 1024, 256)


def test_on_localhost_there_is_one_of_each():
    assert processes(16, None, mode="local") == Processes(1, 1, 1, 1024, 256)


def test_what_readers_may_hold_is_the_setting(settings_of):
    needed = environment().processes(1, None).needed_mib()
    settings_of(max_unread_bytes=768 * MEBIBYTE + 1)
    assert environment().processes(1, None).needed_mib() == needed + 2 * 513
    assert processes(64, 65536, unread=32 * UNREAD) < processes(64, 65536)


def test_each_worker_takes_the_largest_message():
    one, many = (Processes(workers, 2, 2, 1024, 64).needed_mib() for workers in (2, 12))
    assert many - one == 10 * (WORKER_MIB + MESSAGE_MIB)


def test_what_the_pools_keep_is_what_the_sum_says():
    assert 2 * KEPT_BYTES == ANSWERS_MIB * MEBIBYTE


@pytest.mark.parametrize(
    ("text", "expected"),
    [("1073741824\n", 1024), ("max\n", None), ("9223372036854771712\n", None), (None, None)],
)
def test_the_limit_of_the_container_is_read(tmp_path, text, expected):
    file = tmp_path / "memory.max"
    if text is not None:
        file.write_text(text)
    assert limit_mib((tmp_path / "absent", file)) == expected
