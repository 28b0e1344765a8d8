"""Counting of what is read."""

from __future__ import annotations

import pytest

from executor.recorder.outside.errors import OutsideError
from executor.recorder.outside.limits import Counter
from executor.recorder.reader import Limits


def test_messages_and_bytes_are_counted_again_for_another_pass():
    counter = Counter("f", Limits(messages=2, total_bytes=10))
    counter.add(5, 1)
    counter.add(5, 2)
    counter.again().add(5, 1)
    with pytest.raises(OutsideError, match="f:3: the file has too many messages") as caught:
        counter.add(0, 3)
    assert caught.value.code == "too_large"


def test_another_pass_has_the_time_that_is_left():
    counter = Counter("f", seconds=-1.0)
    assert counter.is_late()
    assert counter.again().is_late()
    assert not Counter("f").is_late()
