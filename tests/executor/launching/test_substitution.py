"""Substitutions in launch files."""

from __future__ import annotations

import pytest

from executor.launching.substitution import SubstitutionError, Substitutions, has_substitutions, truth

VALUES = Substitutions({"a": "b", "b": "x y", "name": "map"}, "/p/launch")


def test_variables_and_the_folder_are_replaced() -> None:
    assert VALUES.text("$(dirname)/$(var name).yaml") == "/p/launch/map.yaml"
    assert VALUES.text("$(var 'name')$(var \"name\")") == "mapmap"
    assert VALUES.text("$(var $(var a)) $(var none 'of $(var a)') $(var none c$(var a))") == "x y of b cb"


def test_a_backslash_takes_the_meaning_of_a_character() -> None:
    assert VALUES.text(r"\$(var a) \\ a$b $ c\d") == r"$(var a) \ a$b $ cd"
    assert [has_substitutions(text) for text in (r"\$(var a)", "a$b", "a $(var a)")] == [False, False, True]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$(var no)", "no argument 'no'"),
        ("$(eval 1 + 1)", "is not read here"),
        ("$(env BT_STUDIO_NO_SUCH)", "is not set here, and"),
        ("$(env)", "has a name"),
        ("$(env a b c)", "has a name"),
        ("$(env 'x)", "cannot be split"),
        ("$(env x", "has no closing bracket"),
        ("$( x)", "has no name"),
        ("$(var " * 20 + "a" + ")" * 20, "nested deeper"),
        ("$(optenv HOME)", r"write \$\(env NAME ''\)"),
        ("$(find-pkg-share no_such_package)", "no package 'no_such_package'"),
    ],
)
def test_what_is_not_read_is_refused(text: str, message: str) -> None:
    with pytest.raises(SubstitutionError, match=message):
        VALUES.text(text)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", []),
        (" a  b ", ["a", "b"]),
        ("$(var b) $(var b)", ["x y", "x y"]),
        ("$(var b)$(var b)", ["x yx y"]),
        ("a$(var b)c d", ["ax yc", "d"]),
        ("'a b' $(var b)/z \"c\"", ["a b", "x y/z", "c"]),
    ],
)
def test_words_are_split_where_the_file_has_spaces_and_not_where_values_have(
    text: str, words: list[str]
) -> None:
    """The expected words are those of `launch` 3.4.3."""
    assert VALUES.words(text) == words


def test_a_quotation_around_a_substitution_is_refused_as_in_launch() -> None:
    with pytest.raises(SubstitutionError, match="a quotation holds no substitution"):
        VALUES.words("'a $(var b)'")


def test_a_condition_is_true_or_false() -> None:
    assert [truth(text) for text in ("true", " 1 ", "False", "0")] == [True, True, False, False]
    with pytest.raises(SubstitutionError):
        truth("perhaps")


def test_variables_of_the_environment_may_have_defaults(monkeypatch) -> None:
    monkeypatch.setenv("ROBOT", "leo")
    monkeypatch.delenv("NO_ROBOT", raising=False)
    assert VALUES.text("$(env ROBOT) $(env ROBOT other)") == "leo leo"
    assert VALUES.words("$(env NO_ROBOT 'a b') $(env NO_ROBOT '')|") == ["a b", "|"]


def test_packages_of_a_sourced_workspace_are_found(tmp_path, monkeypatch) -> None:
    (tmp_path / "share" / "my_robot").mkdir(parents=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/none:{tmp_path}")
    assert VALUES.text("$(find-pkg-share my_robot)/a") == f"{tmp_path}/share/my_robot/a"
    assert VALUES.text("$(find-pkg-prefix my_robot)") == str(tmp_path)
