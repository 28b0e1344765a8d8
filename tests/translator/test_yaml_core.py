"""The core schema of YAML 1.2; the table of scalars is in `tests/shared/test_yaml_scalars.py`."""

from __future__ import annotations

import pytest
import yaml

from translator.yaml_core import CoreDumper, CoreLoader, core_value


def _scalar(text: str) -> yaml.ScalarNode:
    node = yaml.compose(text, Loader=CoreLoader)
    assert isinstance(node, yaml.ScalarNode)
    return node


@pytest.mark.parametrize(
    ("text", "value"),
    [("!!str 1e2", "1e2"), ("!!float 1", 1.0), ("!!int 0x10", 16), ("!!bool TRUE", True), ("!!null x", None)],
)
def test_a_tag_counts(text, value):
    found = core_value(_scalar(text))
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize("text", ["!!int ten", "!!bool yes", "!!float one"])
def test_a_tag_that_does_not_fit_is_refused(text):
    with pytest.raises(ValueError, match=r"ten|yes|one"):
        core_value(_scalar(text))


@pytest.mark.parametrize("word", ["1e2", "0o17", "yes", "1_000", "2026-01-01"])
def test_text_that_some_reader_takes_for_a_number_is_quoted(word):
    assert yaml.dump([word], Dumper=CoreDumper).strip() == f"- '{word}'"
