"""A sleep in a test waits for a condition, or says why real time must pass."""

from __future__ import annotations

import textwrap

import pytest

from tests.tools import sleeps


def test_every_sleep_waits_for_a_condition_or_has_a_reason(capsys: pytest.CaptureFixture[str]) -> None:
    assert sleeps.main([]) == 0, capsys.readouterr().out


@pytest.mark.parametrize(
    "source",
    [
        "await asyncio.sleep(0)",
        "while not found():\n    assert time.monotonic() < end_s\n    time.sleep(0.1)",
        "while time.monotonic() < end_s:\n    time.sleep(0.1)",
        "async with asyncio.timeout(60):\n    while not found():\n        await asyncio.sleep(0.1)",
    ],
)
def test_a_wait_for_a_condition_is_allowed(source: str) -> None:
    assert sleeps.find(wrapped(source)) == []


@pytest.mark.parametrize(
    "source",
    [
        "time.sleep(1)",
        "sleep(1)",
        "page.wait_for_timeout(500)",
        "time.sleep(1)  # noqa: S101",
        "while not found():\n    time.sleep(0.1)",
        "while not found():\n    assert time.monotonic() < end_s\n    run(lambda: time.sleep(9))",
    ],
)
def test_a_bare_sleep_is_found(source: str) -> None:
    [found] = sleeps.find(wrapped(source))
    assert found.reason == ""


@pytest.mark.parametrize(
    "source",
    [
        "time.sleep(1)  # the time is the test",
        "# The time is the test.\ntime.sleep(1)",
        "time.sleep(1)  # noqa: ASYNC251 - the loop is what hangs",
    ],
)
def test_a_comment_gives_the_reason(source: str) -> None:
    [found] = sleeps.find(wrapped(source))
    assert found.reason


def wrapped(source: str) -> str:
    return f"async def test():\n{textwrap.indent(source, '    ')}\n"
