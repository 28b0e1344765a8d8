"""`project.json` as the back end reads it."""

from __future__ import annotations

import pytest

from backend.core.problems import InvalidInputError
from backend.projects.storage.manifest import read, write


def test_the_fields_of_lists_are_read_and_the_rest_is_kept() -> None:
    manifest = read(write({"name": "Robot", "universe": "x", "other": [1]}))
    assert (manifest.name, manifest.universe, manifest.document["other"]) == ("Robot", "x", [1])


@pytest.mark.parametrize("raw", [b"[]", b"{", b'{"name": 5}', b'{"name": "\\u0000"}', b'{"x": NaN}'])
def test_what_is_no_project_is_refused(raw: bytes) -> None:
    with pytest.raises(InvalidInputError):
        read(raw)
