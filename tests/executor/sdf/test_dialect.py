"""Documents are parsed as Gazebo parses them, and keep their lines."""

from __future__ import annotations

import pytest

from executor.sdf.dialect import SdfError, line_of, parse, version_of


@pytest.mark.parametrize(
    "text",
    [
        "<sdf version='1.9'>\n<gz:a gz:b='1'><ignition:c/></gz:a>\n<world/></sdf>",
        "<!-- a -- b --->\n<!-- c\n --><sdf version='1.9'><world/></sdf>",
        "\n <?xml version='1.0'\n?><sdf version='1.9'><world/></sdf>",
        "<sdf version='1.9' xmlns:gz='urn:x'>\n<gz:a/>\n<world/></sdf>",
        "?xml version='1.0'?>\n<sdf version='1.9'><world/></sdf>",
        "<?xml version='1.0' encoding='ISO-8859-1'?>\n<!-- \u00e4 -->\n<sdf version='1.9'><world/></sdf>",
    ],
)
def test_the_dialect_is_read(text: str) -> None:
    raw = text.encode("iso-8859-1")
    root = parse(raw, "a.sdf")
    found = root.find("world")
    assert found is not None
    assert line_of(found) == text[: text.index("<world")].count("\n") + 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<sdf version='1.9'>\n<world>", r"a\.sdf:2: .*tag"),
        ("<!DOCTYPE sdf []><sdf/>", "DOCTYPE"),
        ("<robot/>", "<sdf> element"),
        ("<sdf version='99'/>", "'99'"),
        ("<sdf version='0.9'/>", "'0.9'"),
        ("<sdf version='new'/>", "'new'"),
        ("", "a.sdf:1"),
    ],
)
def test_other_documents_are_refused(text: str, message: str) -> None:
    with pytest.raises(SdfError, match=message):
        parse(text.encode(), "a.sdf")


def test_a_version_is_two_numbers() -> None:
    assert version_of(parse(b"<sdf version='1.6'/>", "a"), "a") == (1, 6)
    assert version_of(parse(b"<sdf/>", "a"), "a") == (1, 12)
