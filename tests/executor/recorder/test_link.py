"""The way from a source to the recorder: nothing waits, and the whole state comes again after a loss."""

from __future__ import annotations

import secrets
from typing import Any

import pytest

from executor.recorder.link import BATCH_S, RETRY_S, Heard, Mark, RecorderLink, Until
from executor.recorder.sources import BrokenSource, Source, listen, take_source

SOON_S = BATCH_S + 0.05


class Ends:
    """A link and the recorder's end of it, with a clock that stands."""

    def __init__(self) -> None:
        self.address = f"bt-studio-test-{secrets.token_hex(8)}"
        self.now_s = 100.0
        self.restated = 0
        self.sources: list[Source] = []
        self.listener: Any = listen(self.address)
        self.link = RecorderLink(self.address, self._restate, lambda: self.now_s)

    def _restate(self) -> None:
        self.restated += 1
        self.link.send(Heard("/state", "k", self.restated, b""))

    def accepted(self) -> Source:
        source = take_source(self.listener)
        assert source is not None
        self.sources.append(source)
        return source

    def later(self, seconds: float) -> None:
        self.now_s += seconds
        self.link.pump()


@pytest.fixture
def ends():
    it = Ends()
    yield it
    it.link.close()
    it.listener.close()
    for source in it.sources:
        source.connection.close()


def heard(number: int, size: int = 0) -> Heard:
    return Heard("/x", "k", number, bytes(size))


def test_a_run_begins_with_its_mark_and_the_whole_state(ends):
    ends.link.send(heard(1))  # before a run begins there is nothing to record
    ends.link.begin("a1")
    assert list(ends.accepted().messages()) == [Mark("a1"), Heard("/state", "k", 1, b"")]


def test_messages_are_sent_in_batches_and_in_order(ends):
    ends.link.begin("a1")
    source = ends.accepted()
    assert len(list(source.messages())) == 2
    for number in range(3):
        ends.link.send(heard(number))
    assert list(source.messages()) == []
    ends.later(SOON_S)
    assert list(source.messages()) == [heard(0), heard(1), heard(2)]
    assert source.run == "a1"


def test_a_recorder_that_does_not_read_costs_messages_and_no_time(ends):
    ends.link.begin("a1")
    source = ends.accepted()
    for number in range(40):
        ends.link.send(heard(number, 1 << 20))
    taken: list[Any] = []
    for _ in range(200):
        taken += source.messages()
        ends.later(SOON_S)
    numbers = [m.t_ns for m in taken if isinstance(m, Heard) and m.topic == "/x"]
    assert numbers == list(range(len(numbers)))
    assert 0 < len(numbers) < 40
    assert taken[-2:] == [Mark("a1"), Heard("/state", "k", 2, b"")]


def test_a_recorder_that_was_started_again_gets_everything_again(ends):
    ends.link.begin("a1")
    ends.accepted().connection.close()
    ends.listener.close()
    for _ in range(3):
        ends.link.send(heard(1))
        ends.later(SOON_S)
    assert not ends.link.is_recording
    ends.listener = listen(ends.address)
    ends.later(RETRY_S + SOON_S)
    assert list(ends.accepted().messages()) == [Mark("a1"), Heard("/state", "k", 2, b"")]


def test_without_an_address_nothing_is_sent():
    link = RecorderLink("", lambda: pytest.fail("there is no recorder"))
    link.begin("a1")
    link.send(heard(1))
    link.pump()
    assert not link.is_recording


def test_what_waits_is_flushed_at_the_end(ends):
    ends.link.begin("a1")
    source = ends.accepted()
    list(source.messages())
    ends.link.send(heard(7))
    ends.link.flush(1.0)
    ends.link.close()
    assert list(source.messages()) == [heard(7)]
    with pytest.raises(BrokenSource):
        list(source.messages())


def test_what_was_held_back_is_gathered_once_for_a_batch_and_ends_with_the_time():
    address = f"bt-studio-test-{secrets.token_hex(8)}"
    now_s, held = [100.0], [heard(number, 30_000) for number in range(5)]

    def gathered():
        while held:
            yield held.pop(0)
        yield Until(5)

    with listen(address) as listener:
        link = RecorderLink(address, lambda: None, lambda: now_s[0], gathered)
        link.begin("a1")
        source = take_source(listener)
        assert source is not None
        now_s[0] += SOON_S
        link.pump()
        link.flush(1.0)
        found = [m for _ in range(5) for m in source.messages()]
        link.close()
        source.connection.close()
    assert found[:7] == [Mark("a1"), *(heard(number, 30_000) for number in range(5)), Until(5)]
    assert set(map(type, found[7:])) == {Until}
