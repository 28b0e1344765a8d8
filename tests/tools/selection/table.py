"""The results of full runs: `tests/durations.json`, a line a test, and `tests/loaded.json`.

`durations.json` has `tests` (processor seconds with children of the last three full runs, and the waiting
time of the last one; tests that need less than `CHEAP_S` have no line), `files` (processor seconds of all
tests of a file) and `inputs` (for each file with dear tests, a digest of all that it can read at its last
green full run). `loaded.json` has, for each file whose tests start processes, the modules that those loaded.
`executed.json` has, for each file with dear tests, the functions that ran in these, and the modules of their
processes: a line a module. A file without a line there has its imports instead.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

ROOT: Final = Path(__file__).resolve().parents[3]
DURATIONS: Final = ROOT / "tests" / "durations.json"
LOADED: Final = ROOT / "tests" / "loaded.json"
EXECUTED: Final = ROOT / "tests" / "executed.json"
# In `executed.json`, beside the names of functions: the module was loaded, its source was read.
BODY: Final = "*"
TEXT: Final = "?"
DEAR_S: Final = 1.0
"""A test that needs more processor time than this, with its children, is dear."""
CHEAP_S: Final = 0.3
RUNS: Final = 3


class TableError(Exception):
    """A table that cannot be used; the message says which, why, and what to do."""


@dataclass(frozen=True)
class Duration:
    """The cost of a test: `processor_s` of up to three full runs, the newest last, and its wall time in s."""

    processor_s: tuple[float, ...]
    wall_s: float

    @property
    def median_s(self) -> float:
        """The median of the runs."""
        return median(self.processor_s)


@dataclass
class Table:
    """The stored results of full runs."""

    tests: dict[str, Duration] = field(default_factory=dict)
    files: dict[str, float] = field(default_factory=dict)
    lanes: dict[str, float] = field(default_factory=dict)
    inputs: dict[str, str] = field(default_factory=dict)

    def dear(self) -> dict[str, float]:
        """Returns the dear tests with the medians of their processor time in seconds."""
        medians = {name: each.median_s for name, each in self.tests.items()}
        return {name: seconds for name, seconds in medians.items() if seconds > DEAR_S}


def file_of(test: str) -> str:
    """Returns the file of a test's id."""
    return test.partition("::")[0]


def read(path: Path = DURATIONS) -> Table:
    """Reads the table.

    Raises:
        TableError: it is missing, or no table.
    """
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        tests = {
            name: Duration(tuple(map(float, runs)), float(wall_s))
            for name, (*runs, wall_s) in stored["tests"].items()
        }
        if not all(each.processor_s for each in tests.values()):
            raise ValueError("a test without a duration")
        files = {str(name): float(seconds) for name, seconds in stored["files"].items()}
        lanes = {str(name): float(seconds) for name, seconds in stored["lanes"].items()}
        inputs = {str(name): str(digest) for name, digest in stored["inputs"].items()}
        return Table(tests, files, lanes, inputs)
    except OSError as error:
        raise TableError(
            f"{path.name} cannot be read ({error.strerror}); `make test-full` writes it."
        ) from None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise TableError(
            f"{path.name} is not a whole table ({type(error).__name__}: {error}); check it out again, or "
            "let `make test-full` write it."
        ) from None


def write(table: Table, path: Path = DURATIONS) -> None:
    """Writes the table: each entry in a line, sorted, so that two changes of it can be merged."""
    tests = {name: [*each.processor_s, each.wall_s] for name, each in table.tests.items()}
    parts = (("tests", tests), ("files", table.files), ("lanes", table.lanes), ("inputs", table.inputs))
    text = ",\n".join(f'"{name}": {_lines(part)}' for name, part in parts)
    new = path.with_suffix(".new")
    new.write_text(f"{{\n{text}\n}}\n", encoding="utf-8")
    new.replace(path)


def _lines(part: dict[str, object] | dict[str, float] | dict[str, str] | dict[str, list[float]]) -> str:
    lines = (f"{json.dumps(name)}: {json.dumps(part[name])}" for name in sorted(part))
    return "{\n" + ",\n".join(lines) + "\n}"


@dataclass(frozen=True)
class Executed:
    """The functions that a file's dear tests ran (path, name), modules of processes, and files they read."""

    functions: frozenset[tuple[str, str]]
    modules: frozenset[str] = frozenset()
    texts: frozenset[str] = frozenset()

    @staticmethod
    def of(places: Iterable[tuple[str, str]]) -> Executed:
        """Separates the functions from the marks of modules."""
        every = list(places)
        return Executed(
            frozenset((path, name) for path, name in every if name not in (BODY, TEXT)),
            frozenset(path for path, name in every if name == BODY),
            frozenset(path for path, name in every if name == TEXT),
        )

    def places(self) -> set[tuple[str, str]]:
        """Returns all in one, as `of` takes it."""
        return {
            *self.functions,
            *((path, BODY) for path in self.modules),
            *((path, TEXT) for path in self.texts),
        }


def read_executed(path: Path = EXECUTED) -> dict[str, Executed]:
    """Reads what the dear tests ran; nothing where no full run has written it.

    Raises:
        TableError: it is no table.
    """
    if not path.exists():
        return {}
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        places = [(module, name) for module, names in stored["modules"].items() for name in names.split(" ")]
        return {
            file: Executed.of(places[number] for number in _numbers(ranges))
            for file, ranges in stored["files"].items()
        }
    except (OSError, ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
        raise TableError(
            f"{path.name} is not a whole table ({type(error).__name__}: {error}); check it out again, or "
            "let `make test-full` write it."
        ) from None


def write_executed(executed: dict[str, Executed], path: Path = EXECUTED) -> None:
    """Writes what the dear tests ran: a line a module with its functions, and for each file their ranges."""
    places = {file: each.places() for file, each in executed.items()}
    every = sorted(set().union(*places.values()))
    number = {each: index for index, each in enumerate(every)}
    modules: dict[str, str] = {}
    for module, name in every:
        modules[module] = f"{modules[module]} {name}" if module in modules else name
    files = {file: _ranges(sorted(number[each] for each in own)) for file, own in places.items()}
    new = path.with_suffix(".new")
    new.write_text(f'{{\n"modules": {_lines(modules)},\n"files": {_lines(files)}\n}}\n', encoding="utf-8")
    new.replace(path)


def read_loaded(path: Path = LOADED) -> dict[str, frozenset[str]]:
    """Reads which modules the processes of each test file loaded, as paths.

    Raises:
        TableError: it is missing, or no table.
    """
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        paths = stored["paths"]
        return {
            file: frozenset(paths[number] for number in _numbers(runs))
            for file, runs in stored["files"].items()
        }
    except OSError as error:
        raise TableError(
            f"{path.name} cannot be read ({error.strerror}); `make test-full` writes it."
        ) from None
    except (ValueError, KeyError, TypeError, AttributeError, IndexError) as error:
        raise TableError(
            f"{path.name} is not a whole table ({type(error).__name__}: {error}); check it out again, or "
            "let `make test-full` write it."
        ) from None


def write_loaded(loaded: dict[str, frozenset[str]], path: Path = LOADED) -> None:
    """Writes the modules: a line a path, and for each file the ranges of the lines."""
    paths = sorted(set().union(*loaded.values()))
    number = {each: index for index, each in enumerate(paths)}
    files = {file: _ranges(sorted(number[each] for each in seen)) for file, seen in loaded.items()}
    lines = ",\n".join(map(json.dumps, paths))
    new = path.with_suffix(".new")
    new.write_text(f'{{\n"paths": [\n{lines}\n],\n"files": {_lines(files)}\n}}\n', encoding="utf-8")
    new.replace(path)


def _ranges(numbers: list[int]) -> str:
    found: list[list[int]] = []
    for number in numbers:
        if found and found[-1][1] == number - 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return " ".join(str(first) if first == last else f"{first}-{last}" for first, last in found)


def _numbers(ranges: str) -> list[int]:
    numbers: list[int] = []
    for part in ranges.split():
        first, _, last = part.partition("-")
        numbers += range(int(first), int(last or first) + 1)
    return numbers
