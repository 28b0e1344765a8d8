"""Formatting and findings of Python."""

from __future__ import annotations

from backend.language import views


def test_a_text_is_formatted_and_checked(api):
    asked = {"source": "x = {  'a':1 }\n", "filename": "actions/Go.py"}
    assert api.post("python/format", asked)["source"] == 'x = {"a": 1}\n'
    assert api.post("python/lint", {"source": "import os\n"})["findings"][0]["code"] == "F401"
    assert api.post("python/lint", {"source": []}, expect=422)
    assert views.Lint.__doc__
