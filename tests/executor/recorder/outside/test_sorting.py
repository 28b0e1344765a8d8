"""Messages in the order of their times, within a bound of memory."""

from __future__ import annotations

import random
import tracemalloc

import pytest

from executor.recorder.outside.sorting import Chunks, Sent, in_order


def messages(count, *, size=10, seed=1, topics=3):
    chance = random.Random(seed)  # noqa: S311 - no secret
    for number in range(count):
        topic = chance.randrange(topics)
        yield Sent(f"/t{topic}", f"k{topic}", chance.randrange(50), bytes([number % 256]) * size, number)


@pytest.mark.parametrize("most_bytes", [1, 500, 3000, 1 << 20])
def test_all_are_there_by_their_times_and_those_of_one_time_as_they_came(most_bytes, tmp_path):
    given = list(messages(200))
    assert list(in_order(given, tmp_path, most_bytes)) == sorted(given, key=lambda sent: sent.t_ns)
    assert list(tmp_path.iterdir()) == []


def test_nothing_and_one():
    assert list(in_order([], None)) == []
    (one,) = messages(1)
    assert list(in_order([one], None, 1)) == [one]


def test_memory_is_bounded(tmp_path):
    tracemalloc.start()
    try:
        count = sum(1 for _ in in_order(messages(4000, size=20_000), tmp_path, 2 << 20))
        _, most = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert count == 4000
    assert most < 8 << 20


def chunked(sents, size=20, **bounds):
    """Returns messages in chunks of so many, what reads one of them, and which were read."""
    chunks, read = Chunks(**bounds), []
    parts: dict[tuple[int, int], list[Sent]] = {}
    for number, sent in enumerate(sents):
        place = number // size
        parts.setdefault((place // 4, place), []).append(sent._replace(place=place))
        chunks.note(place // 4, sent._replace(place=place))

    def part(file, place):
        read.append(place)
        return parts[file, place]

    return chunks, [sent for each in parts.values() for sent in each], part, read


@pytest.mark.parametrize("size", [1, 7, 20, 500])
@pytest.mark.parametrize("seed", range(4))
def test_chunks_are_merged_as_if_all_were_sorted(size, seed):
    chunks, given, part, read = chunked(messages(300, seed=seed), size)
    assert chunks.fit()
    assert list(chunks.in_order(part)) == sorted(given, key=lambda sent: sent.t_ns)
    assert len(read) == len(set(read)) == -(-300 // size)


def test_a_chunk_is_read_once_its_begin_is_due():
    late = [Sent("/t", "k", t_ns, b"", 0) for t_ns in (10, 30, 20, 40, 50, 60)]
    chunks, _, part, read = chunked(late, 2)
    opened = [(sent.t_ns, len(read)) for sent in chunks.in_order(part)]
    assert opened == [(10, 1), (20, 2), (30, 2), (40, 2), (50, 3), (60, 3)]


def test_chunks_that_overlap_too_much_or_are_too_many_do_not_fit():
    ahead = [Sent("/t", "k", t_ns, bytes(1000), 0) for t_ns in range(100)]
    assert chunked(ahead, 5, most_bytes=6_100)[0].fit()
    assert not chunked(ahead, 5, most_bytes=5_900)[0].fit()
    assert not chunked(ahead[:50] + ahead[:50], 5, most_bytes=6_100)[0].fit()
    assert not chunked(ahead, 5, most_chunks=19)[0].fit()
    assert chunked(ahead, 5, most_chunks=20)[0].fit()


@pytest.mark.parametrize("change", [lambda found: found[1:], lambda found: [*found[:-1], found[0]]])
def test_a_chunk_that_changed_since_is_refused(change):
    chunks, _, part, _ = chunked([Sent("/t", "k", t_ns, b"", 0) for t_ns in range(4)], 4)
    with pytest.raises(ValueError, match="the chunk at 0 has changed"):
        list(chunks.in_order(lambda file, place: change(part(file, place))))
