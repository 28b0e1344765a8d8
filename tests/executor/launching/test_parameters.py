"""Types of parameters; the expected values are those of `launch_ros` 0.26.6, and it refuses the others."""

from __future__ import annotations

import math

import pytest
import yaml

from executor.launching.parameters import parameter_text, parameter_value
from executor.launching.substitution import SubstitutionError, Substitutions

VALUES = Substitutions({"v": "7", "empty": "", "odd": "a: b"}, "/p")


@pytest.mark.parametrize(
    ("given", "type_name", "separator", "value"),
    [
        ("5", "yaml", "", 5),
        ("5.0", "yaml", "", 5.0),
        ("yes", "yaml", "", True),
        ("'5'", "yaml", "", "5"),
        ("", "yaml", "", ""),
        ("[1", "yaml", "", "[1"),
        ("*", "yaml", "", "*"),
        ("2024-02-30", "yaml", "", "2024-02-30"),
        ("0x_", "yaml", "", "0x_"),
        ("!!bool x", "yaml", "", "!!bool x"),
        ("!!timestamp x", "yaml", "", "!!timestamp x"),
        ("[" * 3_000, "yaml", "", "[" * 3_000),
        ("1:30", "yaml", "", 90),
        ("1e3", "yaml", "", "1e3"),
        (r"a\b", "yaml", "", "ab"),
        ("[a, 'b, c']", "yaml", "", ["a", "b, c"]),
        ("$(var v)", "yaml", "", 7),
        ("'$(var v)'", "yaml", "", 7),
        ("$(var empty)", "yaml", "", ""),
        ("[$(var v), 2]", "yaml", "", [7, 2]),
        ("5", "str", "", "5"),
        ("$(var v)", "str", "", "7"),
        ("'5'", "str", "", "'5'"),
        ("$(var v)", "float", "", 7.0),
        ("1", "bool", "", True),
        ("[a, b]", "list_of_str", "", ["a", "b"]),
        ("1,2", "list_of_str", ",", ["1", "2"]),
        ("a, b", "yaml", ",", ["a", "b"]),
        ("$(var v);8", "yaml", ";", [7, 8]),
        ("true,false", "yaml", ",", [True, False]),
    ],
)
def test_a_text_of_xml_has_the_type_that_launch_gives_it(
    given: str, type_name: str, separator: str, value: object
) -> None:
    found = parameter_value(given, VALUES, type_name=type_name, separator=separator, is_xml=True)
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize(
    ("given", "type_name", "value"),
    [
        ("5", "yaml", "5"),
        ("true", "yaml", "true"),
        ("'5'", "yaml", "'5'"),
        (5, "yaml", 5),
        (["1", "2"], "yaml", ["1", "2"]),
        ("$(var v)", "yaml", 7),
        ("x $(var v)", "yaml", "x 7"),
        (["$(var v)", 3], "yaml", [7, 3]),
        ("$(var v)", "int", 7),
        ("5", "str", "5"),
        (["1"], "list_of_str", ["1"]),
    ],
)
def test_a_value_of_yaml_keeps_its_type(given: object, type_name: str, value: object) -> None:
    found = parameter_value(given, VALUES, type_name=type_name, is_xml=False)
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize(
    ("given", "type_name", "message"),
    [
        ("~", "yaml", "put it in quotes"),
        ("2020-01-01", "yaml", "put it in quotes"),
        ("a: b", "yaml", "put it in quotes"),
        ("$(var odd)", "yaml", "put it in quotes"),
        ("[1, 2.5]", "yaml", "several types"),
        ("[[1]]", "yaml", "put it in quotes"),
        ("a", "int", "'a' is no value of the type int"),
        ("5.5", "int", "no value of the type int"),
        ("$(var v)", "bool", "'7' is no value of the type bool"),
        ("5", "list_of_int", "no value of the type list_of_int"),
        ("1", "foo", "there is no type 'foo'"),
    ],
)
def test_what_launch_refuses_in_xml_is_refused(given: str, type_name: str, message: str) -> None:
    with pytest.raises(SubstitutionError, match=message):
        parameter_value(given, VALUES, type_name=type_name, is_xml=True)


@pytest.mark.parametrize(
    ("given", "type_name"),
    [
        (5, "str"),
        (5, "float"),
        ("5", "int"),
        (["$(var v)", "8"], "yaml"),
        ([True, 1], "yaml"),
        ([1], "int"),
        (1, "list_of_int"),
        (None, "yaml"),
    ],
)
def test_what_launch_refuses_in_yaml_is_refused(given: object, type_name: str) -> None:
    with pytest.raises(SubstitutionError):
        parameter_value(given, VALUES, type_name=type_name, is_xml=False)


@pytest.mark.parametrize(
    "value", [5, -0.5, True, False, "5", "", "it's", "a\nb", "[1, 2]", "yes", ["a, b", "c"], [1.0, 2.5]]
)
def test_the_text_for_a_program_keeps_the_type(value: object) -> None:
    found = yaml.safe_load(parameter_text(value))
    assert (found, type(found)) == (value, type(value))


def test_numbers_that_end_nowhere_are_written_as_yaml_has_them() -> None:
    assert [parameter_text(each) for each in (math.inf, -math.inf, math.nan)] == [".inf", "-.inf", ".nan"]
