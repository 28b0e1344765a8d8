"""YAML of users: places for what is wrong, and nothing that grows when it is read."""

from __future__ import annotations

import pytest

from translator.limits import YAML_BYTES
from translator.yaml_text import YamlError, read_yaml

BOMB = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{chr(98 + i)}: &{chr(98 + i)} [{', '.join([f'*{chr(97 + i)}'] * 9)}]\n" for i in range(9)
)


def test_values_have_their_places():
    read = read_yaml(b"a: 1\nb:\n  - {c: x, 'd': 2.5}\n  - true\n")
    assert read.value == {"a": 1, "b": [{"c": "x", "d": 2.5}, True]}
    assert read.places["b", 0] == (3, 5)
    assert read.places["b", 0, "d"] == (3, 12)  # of the key
    assert read.places["b", 1] == (4, 5)


@pytest.mark.parametrize(
    ("raw", "line", "said"),
    [
        (b"", 1, "empty"),
        (b"a: 1\n\tb: 2", 2, "tab character"),
        (b"\xff\xfe", 1, "not UTF-8"),
        (b"a: 1\nb: \xff", 2, "not UTF-8"),
        (b"a: 1\na: 2", 2, "the key 'a' appears twice"),
        (b"? [a]\n: 1", 1, "a key must be a word"),
        (b"a: !!python/object/apply:os.system ['true']", 1, "have no place here"),
        (b"a: !mine x", 1, "have no place here"),
        (b"a: !!timestamp 2026-01-01", 1, "timestamp have no place here: put it in quotes"),
        (b"a: &x 1\nb: *x", 2, "aliases"),
        (BOMB.encode(), 2, "aliases"),
        (b"a: " + b"[" * 100 + b"]" * 100, 1, "nested deeper than 32"),
        (b"[" + b"1," * 100_001 + b"]", 1, "more than 100000 values"),
        (b"a: 1\n---\nb: 2", 2, "document"),
        (b"#" * (YAML_BYTES + 1), 1, "larger than"),
    ],
)
def test_what_is_refused_says_where(raw, line, said):
    with pytest.raises(YamlError, match=said) as refused:
        read_yaml(raw)
    assert refused.value.line == line
    assert refused.value.column >= 1
