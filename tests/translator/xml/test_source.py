"""XML from outside is hostile: attacks are refused, with a place, and encodings are understood."""

from __future__ import annotations

import pytest

from translator import TranslatorError, from_xml, to_xml
from translator.xml import source
from translator.xml.source import parse_source

TREE = '<BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree>'
BOMB = '<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa">' + "".join(
    f'<!ENTITY {chr(98 + n)} "{f"&{chr(97 + n)};" * 10}">' for n in range(8)
)
ATTACKS = {
    "entity bomb": (BOMB + "]><root>&i;</root>", "BT0704"),
    "external entity": ('<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><root>&x;</root>', "BT0704"),
    "external DTD": ('<!DOCTYPE root SYSTEM "http://example.org/x.dtd"><root/>', "BT0704"),
    "entity of nobody": ("<root>&nothing;</root>", "BT0701"),
    "depth": ("<root>" + "<Inverter>" * 300 + "</Inverter>" * 300 + "</root>", "BT0706"),
    "attributes": ("<root " + " ".join(f'a{n}=""' for n in range(100_000)) + "/>", "BT0707"),
    "same attribute twice": ('<root a="1" a="2"/>', "BT0701"),
    "unclosed": ("<root>", "BT0701"),
    "second root": ("<root/><root/>", "BT0701"),
    "text alone": ("hello", "BT0701"),
    "nothing": ("", "BT0701"),
    "no quotes": ("<root a=1/>", "BT0701"),
    "less-than in a value": ('<root a="<"/>', "BT0740"),
    "another document": ("<html/>", "BT0703"),
    "no tree": ("<root/>", "BT0734"),
    "endless ID": (f'<root><BehaviorTree ID="{"M" * 300}"><AlwaysSuccess/></BehaviorTree></root>', "BT0736"),
    "unknown encoding": ('<?xml version="1.0" encoding="utf-7"?><root/>', "BT0702"),
    "control character": ("<root a='\x01'/>", "BT0701"),
}


@pytest.mark.parametrize("name", ATTACKS)
def test_attacks_are_refused_with_a_place(name):
    text, code = ATTACKS[name]
    with pytest.raises(TranslatorError) as error:
        from_xml(text, file="x.xml")
    found = error.value.diagnostics[-1]
    assert found.code == code
    assert found.place.file == "x.xml"
    assert found.place.line


def test_size_and_number_of_elements_are_bounded(monkeypatch):
    monkeypatch.setattr(source, "XML_BYTES", 1000)
    with pytest.raises(TranslatorError):
        parse_source(b"<root>" + b" " * 1000 + b"</root>", file="x.xml")
    monkeypatch.setattr(source, "XML_BYTES", 10_000_000)
    monkeypatch.setattr(source, "XML_ELEMENTS", 100)
    with pytest.raises(TranslatorError):
        parse_source("<root>" + "<a/>" * 200 + "</root>", file="x.xml")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "iso-8859-1", "windows-1252"])
def test_a_file_keeps_its_encoding(encoding):
    declared = encoding.removesuffix("-sig")
    text = f'<?xml version="1.0" encoding="{declared}"?>\n<root BTCPP_format="4"><!-- é -->{TREE}</root>\n'
    raw = text.encode(encoding)
    project = from_xml(raw, file="x.xml")
    from translator import export_files

    assert export_files(project) == {"x.xml": raw}
    assert to_xml(project) == text
    edited = project.with_tree(project.main.edited("n1", comment="größer"))
    (written,) = export_files(edited).values()
    assert "größer" in written.decode(encoding)


def test_bytes_that_are_not_of_the_encoding_are_refused():
    with pytest.raises(TranslatorError) as error:
        from_xml(b"<root>\n\xff</root>")
    assert (error.value.diagnostics[0].code, error.value.diagnostics[0].place.line) == ("BT0002", 2)
