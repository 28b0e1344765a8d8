"""Reads universe documents; errors have a line."""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import TYPE_CHECKING, Final, TypeVar

from pydantic import BaseModel, ValidationError

from executor.universes.document import DocumentError, Located, Problem, read_yaml
from executor.universes.model import Universe
from tree_gardener.intended_values import Wanted, sentence

if TYPE_CHECKING:
    from pydantic_core import ErrorDetails

_FOLDER: Final = Path(__file__).parent
BUILTIN_IDS: Final = tuple(sorted(path.stem for path in _FOLDER.glob("*.yaml")))

_WANTED: Final[dict[str, Wanted]] = {
    "bool_type": "boolean",
    "float_type": "number",
    "int_type": "integer",
    "int_from_float": "integer",
    "string_type": "text",
}

M = TypeVar("M", bound=BaseModel)


class UniverseError(DocumentError):
    """A universe cannot be used; `problems` hold the reasons and their places."""


def builtin_path(universe_id: str) -> Path:
    """Returns the file of a built-in universe.

    Raises:
        UniverseError: there is no such universe.
    """
    if universe_id not in BUILTIN_IDS:
        near = difflib.get_close_matches(universe_id, BUILTIN_IDS, n=1)
        hint = f"did you mean {near[0]!r}?" if near else f"there are: {', '.join(BUILTIN_IDS)}"
        problem = Problem(f"there is no world {universe_id!r}", code="BTU004", hint=hint)
        raise UniverseError([problem], universe_id)
    return _FOLDER / f"{universe_id}.yaml"


def preview_path(universe_id: str) -> Path:
    """Returns the path of the picture of a built-in universe; `executor.generate.previews` draws it."""
    return _FOLDER / "previews" / f"{universe_id}.webp"


def load_builtin(universe_id: str) -> Universe:
    """Returns a built-in universe."""
    path = builtin_path(universe_id)
    return parse_universe(path.read_text(encoding="utf-8"), path.name)


def parse_universe(text: str, file: str = "universe.yaml") -> Universe:
    """Returns the universe that a document describes.

    Raises:
        UniverseError: the document is invalid; the error holds every problem, each with its line.
    """
    try:
        return validate(read_yaml(text, file), Universe, file)
    except DocumentError as error:
        raise UniverseError(error.problems, error.file) from error


def validate(document: Located, model: type[M], file: str) -> M:
    """Checks a document against a model, and returns it as an instance of the model.

    Raises:
        DocumentError: the document is invalid; the error holds every problem, each with its line.
    """
    try:
        return model.model_validate(document.value)
    except ValidationError as error:
        problems = [_problem(detail, document, model) for detail in error.errors(include_url=False)]
        raise DocumentError(sorted(problems, key=lambda p: (p.line, p.column)), file) from error


def _problem(detail: ErrorDetails, document: Located, model: type[BaseModel]) -> Problem:
    path = detail["loc"]
    line, column = document.place(path)
    where = ".".join(str(part) for part in path)
    message = detail["msg"].removeprefix("Value error, ")
    if detail["type"] in _WANTED:
        message = sentence(detail["input"], _WANTED[detail["type"]])
    if detail["type"] == "extra_forbidden":
        return Problem(f"{where} is not known", line, column, "BTU003", _near_hint(str(path[-1]), model))
    if detail["type"] == "missing":
        return Problem(f"{where} is missing", line, column, "BTU003")
    return Problem(f"{where}: {message}" if where else message, line, column, "BTU003")


def _near_hint(key: str, model: type[BaseModel]) -> str:
    known = _known_keys(model.model_json_schema())
    near = difflib.get_close_matches(key, known, n=1)
    return f"did you mean {near[0]!r}?" if near else ""


def _known_keys(schema: object) -> set[str]:
    if isinstance(schema, list):
        return set().union(*(_known_keys(item) for item in schema))
    if not isinstance(schema, dict):
        return set()
    own = set(schema["properties"]) if isinstance(schema.get("properties"), dict) else set()
    return own.union(*(_known_keys(item) for item in schema.values()))
