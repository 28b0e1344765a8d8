"""Values of the blackboard as JSON."""

from __future__ import annotations

import json

import numpy as np
import pytest

from executor.application.preview import ITEMS, TEXT_CHARACTERS, preview


@pytest.mark.parametrize("value", [None, True, 5, 1.5, "text", [1, {"a": 2}], (1, 2)])
def test_small_plain_values_stay(value: object) -> None:
    assert preview(value) == (value, False)


@pytest.mark.parametrize(
    "value", [2**60, float("nan"), "x" * (TEXT_CHARACTERS + 1), list(range(ITEMS + 1)), {1: 2}, object()]
)
def test_all_else_is_a_short_text(value: object) -> None:
    text, is_preview = preview(value)
    assert is_preview
    assert isinstance(text, str)
    assert len(text) <= TEXT_CHARACTERS
    json.dumps(text, allow_nan=False)


def test_arrays_have_their_shape_and_a_bad_repr_does_no_harm() -> None:
    class Bad:
        def __repr__(self) -> str:
            raise ValueError

    assert preview(np.zeros((480, 640), np.uint8)) == ("array 480×640 of uint8", True)
    text, is_preview = preview(Bad())
    assert is_preview
    assert "Bad" in text
