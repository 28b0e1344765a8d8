"""Links that carry a right."""

from __future__ import annotations

from uuid import uuid4

import pytest

from backend.accounts.links import MAX_TOKEN, identity_of, link_of, token_of


def test_a_link_names_its_row_and_no_other_kind() -> None:
    identity = uuid4()
    token = token_of("join", identity)
    assert identity_of("join", token) == identity
    assert identity_of("shared", token) is None
    assert link_of("join", identity).endswith(f"/join/{token}")


@pytest.mark.parametrize(
    "change", [str.upper, lambda token: token[:-1], lambda token: token + "x" * MAX_TOKEN]
)
def test_a_link_that_this_server_did_not_make_opens_nothing(change) -> None:
    assert identity_of("join", change(token_of("join", uuid4()))) is None
