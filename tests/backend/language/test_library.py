"""The packages around a project, for a language server."""

from __future__ import annotations

import tomllib

from backend.language.library import RULES, configuration


def test_the_configuration_is_toml_with_the_search_path() -> None:
    found = tomllib.loads(configuration('/a "b"', "/lib", "/usr/bin/python"))
    assert found["environment"] == {
        "root": ['/a "b"', '/a "b"/actions'],
        "extra-paths": ["/lib"],
        "python": "/usr/bin/python",
    }
    assert found["rules"] == RULES
