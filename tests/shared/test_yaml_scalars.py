"""The page and Python read our files alike; `frontend/src/model/document/yaml.test.ts` has the same cases."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
import yaml

from executor.imports.worlds import to_yaml
from executor.universes.document import DocumentError
from executor.universes.document import read_yaml as read_document
from executor.universes.loader import validate
from executor.universes.strict import Strict
from translator.yaml_text import read_yaml as read_text

CASES: Any = json.loads(Path(__file__).with_name("yaml_scalars.json").read_bytes())


class _Document(Strict):
    number: float = 0.0
    boolean: bool = False
    integer: int = 0
    text: str = ""


def _expected(value: Any) -> Any:
    if isinstance(value, str):
        return value[1:] if value.startswith("=") else float(value)
    return value


@pytest.mark.parametrize(("text", "value"), CASES["scalars"])
def test_both_readers_of_python_give_the_value_of_the_page(text: str, value: Any) -> None:
    expected = _expected(value)
    for found in (read_document(f"a: {text}\n").value["a"], read_text(f"a: {text}\n".encode()).value["a"]):
        assert isinstance(found, bool) == isinstance(expected, bool)
        assert isinstance(found, str) == isinstance(expected, str)
        assert found == expected or (math.isnan(found) and math.isnan(expected))


@pytest.mark.parametrize(("wanted", "text", "sentence"), CASES["repairs"])
def test_a_value_of_the_wrong_type_is_refused_with_what_to_write(
    wanted: str, text: str, sentence: str | None
) -> None:
    located = read_document(f"{wanted}: {text}\n")
    if sentence is None:
        validate(located, _Document, "x.yaml")
        return
    with pytest.raises(DocumentError) as refused:
        validate(located, _Document, "x.yaml")
    [problem] = refused.value.problems
    assert (problem.message, problem.line) == (f"{wanted}: {sentence}", 1)


def test_a_whole_number_may_have_an_exponent() -> None:
    assert validate(read_document("integer: 1e2\n"), _Document, "x.yaml").integer == 100


def test_files_of_ros_are_read_as_ros_reads_them() -> None:
    assert read_document("a: yes\n", as_ros=True).value == {"a": True}


@pytest.mark.parametrize("word", ["1e2", "0o17", "yes", "1_000", "null"])
def test_what_an_import_writes_is_read_alike_by_every_reader(word: str) -> None:
    text = to_yaml({"name": word})
    assert read_document(text).value == yaml.safe_load(text) == {"name": word}
