"""The version of a universe changes with its world, and with nothing else."""

from __future__ import annotations

from executor.universes import load_builtin, parse_universe
from executor.universes.version import version_of

TEXT = """format: bt-studio/universe
version: 1
name: test
models: [{id: wall, shape: box, size: [1, 1, 1]}]
actors: [{id: ada, path: [[0, 0], [4, 0]], speed: 1.0}]
"""


def version(text: str) -> str:
    return version_of(parse_universe(text))


def test_texts_comments_and_defaults_are_no_part_of_it() -> None:
    same = TEXT.replace("name: test", "name: other # a comment\ndescription: x").replace(
        "speed: 1.0", "speed: 1"
    )
    assert version(same.replace("speed: 1}", "speed: 1, yields: false}")) == version(TEXT)
    assert len(version(TEXT)) == 8


def test_what_stands_and_walks_is() -> None:
    others = [
        TEXT.replace("[1, 1, 1]", "[1, 1, 2]"),
        TEXT.replace("speed: 1.0", "speed: 1.1"),
        TEXT.replace("speed: 1.0", "speed: 1.0, yields: true"),
    ]
    assert len({version(text) for text in [TEXT, *others]}) == 4


def test_the_built_in_ones_differ() -> None:
    assert version_of(load_builtin("circuit")) != version_of(load_builtin("circuit_obstacles"))
