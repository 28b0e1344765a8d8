"""Preconditions of writes."""

from __future__ import annotations

import pytest

from backend.projects.errors import PreconditionFailedError, matches


@pytest.mark.parametrize("header", ["", "*", '"7"', 'W/"7"', '"6", "7"'])
def test_the_newest_revision_matches(header: str) -> None:
    matches(header, '"7"', "It has changed.")


def test_another_one_fails_with_the_newest() -> None:
    with pytest.raises(PreconditionFailedError, match="It has changed"):
        matches('"6"', '"7"', "It has changed.", 7)
