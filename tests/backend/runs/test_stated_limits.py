"""The page of limits states those of recordings, kept runs and imported worlds as the code has them."""

from __future__ import annotations

from functools import reduce
from importlib import import_module

import pytest

from translator.limits import RECORDINGS, WORLDS


@pytest.mark.parametrize("limit", [*RECORDINGS, *WORLDS], ids=lambda limit: limit.name)
def test_the_page_states_the_constant_of_the_code(limit):
    module, path = limit.constant.split(":")
    assert reduce(getattr, path.split("."), import_module(module)) == limit.value
