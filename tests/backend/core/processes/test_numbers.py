"""Numbers that siblings read."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from backend.core.processes.numbers import ROOM, Numbers, make_page, read_page

if TYPE_CHECKING:
    from pathlib import Path


def test_a_worker_counts_in_its_page_and_reads_the_sum(tmp_path: Path) -> None:
    pages = [tmp_path / "0", tmp_path / "1"]
    for page in pages:
        make_page(page)
    both = [Numbers(), Numbers()]
    place, _ = (one.take(2) for one in both)
    for own, one in enumerate(both):
        one.share(pages, own)
        one.add(place, own + 1)
    assert [one.total(place) for one in both] == [3.0, 3.0]
    assert read_page(pages[1])[place] == 2.0
    both[0].put(place, 0.0)
    assert both[1].total(place) == 2.0


def test_a_page_has_an_end() -> None:
    numbers = Numbers()
    with pytest.raises(MemoryError):
        numbers.take(ROOM + 1)
