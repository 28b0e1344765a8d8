"""Data that the workers of one server share: numbers, places, and the health of each."""

from __future__ import annotations

import time

import pytest

from backend.core.processes.metrics import Counter, Histogram
from backend.core.processes.numbers import BEAT, FULL, STARTED, Numbers, make_page, numbers
from backend.core.processes.siblings import Family, _Siblings, least_s, siblings


@pytest.fixture
def pages(tmp_path):
    """The pages of three workers, of which this process is the second."""
    family = Family(tmp_path, 3, 1)
    return family, [make_page(path) for path in family.pages()]


@pytest.fixture
def joined(pages, monkeypatch):
    """This process as one of three workers."""
    family, found = pages
    for name in ("_own", "_all"):
        monkeypatch.setattr(numbers, name, getattr(numbers, name))
    monkeypatch.setattr(siblings, "family", None)
    siblings.join(family)
    return found


def test_a_number_is_the_sum_of_all_pages_and_outlives_its_process(pages):
    family, _ = pages
    first, second = Numbers(), Numbers()
    first.share(family.pages(), 0)
    second.share(family.pages(), 1)
    place = first.take(2)
    first.add(place, 2)
    second.add(place, 3)
    assert first.total(place) == second.total(place) == 5
    successor = Numbers()
    successor.share(family.pages(), 0)
    successor.add(place, 1)
    assert second.total(place) == 6


def test_a_page_is_bounded():
    own = Numbers()
    with pytest.raises(MemoryError):
        own.take(1000)


def test_metrics_sum_all_workers(joined):
    counter = Counter("x_total", "X.", "kind", ("a", "b"))
    histogram = Histogram("x_seconds", "X.")
    counter.add("b")
    histogram.observe(0.3)
    joined[0][counter._places["b"]] = 41
    joined[2][histogram._first] = 2
    assert counter.totals() == {"a": 0, "b": 42}
    assert histogram.buckets()[0] == ("0.005", 2)
    assert histogram.buckets()[-1] == ("+Inf", 3)


def test_the_worker_that_is_best_off_answers_for_all(joined):
    now = time.monotonic()
    assert least_s(FULL, 70.0) == 70.0  # the others have not started
    joined[0][STARTED], joined[0][BEAT], joined[0][FULL] = 1, now - 500, 0
    assert least_s(FULL, 70.0) == 70.0  # that worker has not reported for long
    joined[2][STARTED], joined[2][BEAT], joined[2][FULL] = 1, now, 5.0
    assert least_s(FULL, 70.0) == 5.0
    assert least_s(FULL, 0.0) == 0.0


@pytest.mark.parametrize("is_one_of_several", [False, True])
def test_of_a_place_there_are_only_so_many(tmp_path, is_one_of_several):
    first = second = _Siblings()
    if is_one_of_several:
        (tmp_path / "places").mkdir()
        first, second = _Siblings(), _Siblings()
        first.family, second.family = Family(tmp_path, 2, 0), Family(tmp_path, 2, 1)
    held = first.take("body of 7", 2)
    assert second.take("body of 7", 2) is not None
    assert first.take("body of 7", 2) is None
    assert second.take("body of 8", 1) is not None
    held.give_back()
    assert second.take("body of 7", 2) is not None
    assert second.take("body of 7", 2) is None
