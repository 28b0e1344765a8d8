import pytest

from executor.universes.document import DocumentError, read_yaml


def test_values_know_their_places() -> None:
    document = read_yaml("a: 1\nb:\n  - {c: x}\n  - 2.5\n")
    assert document.value == {"a": 1, "b": [{"c": "x"}, 2.5]}
    assert document.place(("b", 0, "c")) == (3, 9)
    assert document.place(("b", 1)) == (4, 5)
    assert document.place(("b", 1, "missing")) == (4, 5)


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ("a: [1, 2\nb: 3\n", 2, "expected"),
        ("a: 1\na: 2\n", 2, "twice"),
        ("", 1, "empty"),
        ("? [1, 2]\n: 3\n", 1, "key"),
        ("a: !!python/object/apply:os.system [echo]\n", 1, "tag"),
        ("a: !!int ten\n", 1, "cannot be read"),
        ("a: \x07\n", 1, "characters are not allowed"),
    ],
)
def test_bad_documents_are_refused_with_a_line(text: str, line: int, message: str) -> None:
    with pytest.raises(DocumentError, match=message) as caught:
        read_yaml(text, "x.yaml")
    assert caught.value.problems[0].line == line


@pytest.mark.parametrize("value", ["!!bool x", "!!timestamp x", "2024-02-30", "0x_"])
def test_a_value_that_yaml_1_1_cannot_read_is_refused(value: str) -> None:
    with pytest.raises(DocumentError, match=r"x\.yaml:2:4: BTU001 this value cannot be read"):
        read_yaml(f"a: 1\nb: {value}\n", "x.yaml", as_ros=True)


def test_aliases_cannot_blow_a_document_up() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 10)}]" for i in range(1, 9)]
    with pytest.raises(DocumentError, match="more than"):
        read_yaml("\n".join(lines))


def test_depth_and_size_are_bounded() -> None:
    with pytest.raises(DocumentError, match="deeper"):
        read_yaml("[" * 40 + "]" * 40)
    with pytest.raises(DocumentError, match="deeper"):
        read_yaml("- " * 500_000)
    with pytest.raises(DocumentError, match="larger"):
        read_yaml("a" * 3_000_000)
