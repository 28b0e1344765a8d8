"""The page of a difference."""

from __future__ import annotations

import base64
import hashlib
import re
from typing import Any

from lxml import etree

from tests.shared.make_differences import OLDER, changed
from translator.difference.page import page
from translator.difference.projects import Version, compare_versions

HOSTILE = "</script><img src=x onerror=alert(1)><style>*{}</style>"


def parsed(text):
    parser = etree.HTMLParser(huge_tree=True)
    return etree.fromstring(text.encode(), parser)


def found(root, path) -> Any:
    return root.xpath(path)


def made(newer, **files):
    older = Version(HOSTILE, {"MainTree": OLDER}, {"a.py": b"one\n", "b.bin": b"\0"})
    return page(compare_versions(older, Version("new", {"MainTree": newer}, files)))


def test_hostile_names_are_text():
    hostile = changed(a={"name": HOSTILE, "ports": {HOSTILE: HOSTILE}, "comment": HOSTILE})
    text = made(hostile, **{"a.py": HOSTILE.encode(), HOSTILE: b"x"})
    root = parsed(text)
    assert not found(root, "//img | //script | //link | //iframe | //object")
    assert len(found(root, "//style")) == 1
    assert not found(root, "//@onerror | //@href | //@src")


def test_it_allows_its_own_style_and_nothing_else():
    text = made(OLDER)
    style = re.search(r"<style>(.*)</style>", text, re.DOTALL)[1]
    digest = base64.b64encode(hashlib.sha256(style.encode()).digest()).decode()
    policy = found(parsed(text), "//meta[@http-equiv]/@content")[0]
    assert policy.startswith(f"default-src 'none'; style-src 'sha256-{digest}';")
    assert "style=" not in text


def test_operations_picture_and_files_are_in_it():
    text = made(changed(a={"name": "fast"}), **{"a.py": b"two\n"})
    root = parsed(text)
    assert [" ".join(each.split()) for each in ("".join(li.itertext()) for li in found(root, "//li"))] == [
        "≠fast (Forward) [a] renamed: (none) → “fast”"
    ]
    assert "-one\n+two" in found(root, "//pre")[0].text
    assert "This file is not text." in text
    assert found(root, "//svg")


def test_nothing_differs():
    older = Version("a", {"MainTree": OLDER})
    assert "Nothing differs." in page(compare_versions(older, older))
