"""The query of an import."""

from __future__ import annotations

import pytest
from rest_framework.exceptions import ValidationError

from backend.accounts.api.requests import parsed
from backend.imports.serializers import ImportQuerySerializer


def test_what_is_left_out_is_empty_and_what_is_wrong_is_refused():
    found = parsed(
        ImportQuerySerializer, {"filename": "a.zip", "kind": "robot", "arg": ["a:=b:=c"], "use": "true"}
    )
    assert (found["arg"], found["use"], found["name"], found["replace"]) == (["a:=b:=c"], True, "", False)
    for wrong in ({"kind": "tree"}, {"name": "a/b"}, {"arg": ["a=b"]}, {"use": "maybe"}):
        with pytest.raises(ValidationError):
            parsed(ImportQuerySerializer, {"filename": "a.zip", "kind": "robot", **wrong})
