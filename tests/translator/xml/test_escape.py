"""Text in XML reads back as the same text."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from translator.xml.escape import attribute, cdata, character_data, single_quoted

TEXTS = ["plain", "a < b & c > d", 'it\'s "quoted"', "lines\n\tand\r", "]]>", ""]


@pytest.mark.parametrize("text", TEXTS)
def test_it_reads_back(text: str) -> None:
    read = ElementTree.fromstring
    assert read(f'<a b="{attribute(text)}"/>').get("b") == text
    assert read(f"<a b='{single_quoted(text)}'/>").get("b") == text
    assert (read(f"<a>{character_data(text)}</a>").text or "") == text
    assert (read(f"<a>{cdata(text)}</a>").text or "").replace("\r", "\n") == text.replace("\r", "\n")
