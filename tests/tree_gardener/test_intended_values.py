"""The right form of a value of the wrong type; both languages share `tests/shared/yaml_scalars.json`."""

from __future__ import annotations

import pytest

from tree_gardener.intended_values import intended, sentence


@pytest.mark.parametrize(
    ("value", "wanted", "write"),
    [
        ("0.22", "number", "0.22"),
        (" 1_000 ", "integer", "1000"),
        ("1.5", "integer", None),
        ("Yes", "boolean", "true"),
        ("n", "boolean", "false"),
        (1, "boolean", None),
        (100.0, "text", '"100"'),
        (True, "text", '"true"'),
        ([1], "text", None),
    ],
)
def test_the_form_to_write(value, wanted, write):
    assert intended(value, wanted) == write


def test_the_sentence_has_it_if_it_is_known():
    assert sentence("yes", "boolean") == "must be true or false; write true"
    assert sentence("perhaps", "boolean") == "must be true or false"
