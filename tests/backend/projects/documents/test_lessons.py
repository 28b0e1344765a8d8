"""The lessons of the examples: both languages, and each *Try it* button leads somewhere."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

EXAMPLES = Path(__file__).parents[4] / "examples"
TRY = re.compile(r"\]\((try:(?:[^()\n]|\([^()\n]*\))*)\)")
NAMES = sorted(path.parent.name for path in EXAMPLES.glob("*/project.json"))
LANGUAGES = ("en", "es")


def lesson(name: str, language: str) -> str:
    return (EXAMPLES / name / "lessons" / f"{language}.md").read_text(encoding="utf-8")


def nodes_of(name: str) -> list[dict[str, Any]]:
    trees = sorted((EXAMPLES / name / "trees").glob("*.json"), key=lambda path: path.stem != "MainTree")
    return [node for path in trees for node in json.loads(path.read_bytes())["nodes"].values()]


def find(name: str, block: str) -> dict[str, Any] | None:
    nodes = nodes_of(name)
    named = [node for node in nodes if (node.get("name") or node.get("tree") or node["type"]) == block]
    return next(iter(named or [node for node in nodes if node["type"] == block]), None)


def leads_somewhere(name: str, address: str) -> bool:
    verb, _, rest = address.removeprefix("try:").partition("=")
    if verb == "select":
        return find(name, rest) is not None
    if verb == "set":
        block, port = re.fullmatch(r"([^=]+)\.(\w+)=.*", rest).groups()
        node = find(name, block)
        return node is not None and port in node.get("ports", {})
    if verb == "open":
        path, _, line = rest.partition(":")
        text = (EXAMPLES / name / path).read_text(encoding="utf-8")
        return not line or text.splitlines()[int(line) - 1].strip() != ""
    return address == "try:run"


@pytest.mark.parametrize("name", NAMES)
def test_every_button_leads_somewhere_and_both_languages_have_the_same(name: str) -> None:
    buttons = {language: TRY.findall(lesson(name, language)) for language in LANGUAGES}
    assert len(buttons["en"]) >= 3
    assert buttons["en"] == buttons["es"]
    assert [address for address in buttons["en"] if not leads_somewhere(name, address)] == []


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("language", LANGUAGES)
def test_a_lesson_has_a_title_and_closes_its_marks(name: str, language: str) -> None:
    text = lesson(name, language)
    assert text.startswith("# ")
    assert text.count("`") % 2 == text.count("**") % 2 == 0
