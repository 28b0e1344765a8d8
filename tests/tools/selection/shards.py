"""The shards of a full run: which files each has, what it found, and the tables when all came to their ends.

A file has its digest when all its tests were green; one with a failure has none, and so runs until it is.
"""

from __future__ import annotations

import json
import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from tests.tools.selection import tree
from tests.tools.selection.choose import core_of, core_patterns
from tests.tools.selection.inputs import Inputs, import_graph
from tests.tools.selection.table import (
    BODY,
    CHEAP_S,
    ROOT,
    RUNS,
    TEXT,
    Duration,
    Executed,
    Table,
    TableError,
    file_of,
    read,
    write,
    write_executed,
    write_loaded,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from tests.tools.measuring.executed import Place
    from tests.tools.measuring.results import Measured

FOLDER: Final = ROOT / "var" / "full"
# A test that the table does not know and that takes longer is named: either it gets cheaper, or the table
# is new.
UNKNOWN_S: Final = 5.0
# The core's least part of the minutes that always run.
CORE_SHARE: Final = 0.25
# What a file costs of which nothing is known, so that unknown ones are spread over the shards.
UNKNOWN_FILE_S: Final = 1.0


class ShardError(Exception):
    """A shard that there is not; the message says what to write."""


@dataclass(frozen=True)
class Shard:
    """A part of the suite, counted from 1."""

    number: int
    of: int

    @property
    def name(self) -> str:
        """Its name in paths."""
        return f"{self.number}-of-{self.of}"

    @staticmethod
    def parse(text: str) -> Shard:
        """Reads `3/8`.

        Raises:
            ShardError: it is no such text.
        """
        match = re.fullmatch(r"(\d{1,3})/(\d{1,3})", text)
        if match is None or not 1 <= int(match[1]) <= int(match[2]):
            raise ShardError(f"SHARD={text}: expected a part such as 3/8")
        return Shard(int(match[1]), int(match[2]))


def share(table: Table, files: Iterable[str], shard: Shard) -> list[str]:
    """Returns the test files of a shard: the longest go first, each to the shard that has least."""
    tests = sorted(path for path in files if _is_test_file(path))
    seconds = {path: table.files.get(path, UNKNOWN_FILE_S) for path in tests}
    loads = [0.0] * shard.of
    chosen: list[str] = []
    for path in sorted(tests, key=lambda path: (-seconds[path], path)):
        least = min(range(shard.of), key=loads.__getitem__)
        loads[least] += seconds[path]
        if least == shard.number - 1:
            chosen.append(path)
    return chosen


def _is_test_file(path: str) -> bool:
    return path.startswith("tests/") and Path(path).name.startswith("test_") and path.endswith(".py")


def store(
    found: Measured,
    lanes: Mapping[str, float],
    table: Table,
    files: Mapping[str, str],
    shard: Shard,
    *,
    is_complete: bool,
) -> int:
    """Stores what a shard found, and writes the tables when all shards came to their ends; 1 is a fault."""
    unknown = sorted(
        test
        for test, seconds in found.processor_s.items()
        if seconds > UNKNOWN_S and test not in table.tests and table.inputs
    )
    for test in unknown:
        print(f"tests: {test} has no line in durations.json and takes {found.processor_s[test]:.0f} s")
    folder = FOLDER / tree.digest(files)
    folder.mkdir(parents=True, exist_ok=True)
    result = {
        "is_complete": is_complete,
        "failed": sorted(found.failed),
        "processor_s": found.processor_s,
        "wall_s": found.wall_s,
        "lanes": lanes,
        "loaded": {  # a source that is read as a text counts as a module that is loaded
            file: sorted(
                path for path in found.loaded.get(file, set()) | found.texts.get(file, set()) if path in files
            )
            for file in {*found.loaded, *found.texts}
        },
        "read": {file: sorted(path for path in seen if path in files) for file, seen in found.read.items()},
        "executed": _executed(found, table, files),
    }
    (folder / f"{shard.name}.json").write_text(json.dumps(result), encoding="utf-8")
    return _when_complete(folder, shard.of, table, files) or int(bool(unknown))


def _executed(found: Measured, table: Table, files: Mapping[str, str]) -> dict[str, list[list[str]]]:
    """Returns what the dear tests of each file ran: functions, modules of processes, sources as texts."""
    dear = frozenset(merged(table, found.processor_s, found.wall_s).dear())
    known = found.ran(dear)
    if not known:
        return {}
    inputs = Inputs(files, import_graph(), {})
    result: dict[str, list[list[str]]] = {}
    for file, ran in known.items():
        modules = {path for path, line in ran.places if not line}
        own = Executed(_functions(inputs, ran.places), frozenset(modules))
        kept = _functions(inputs, ran.kept)
        functions = inputs.reach(file, own, kept).ran
        read = found.texts.get(file, set()) | {
            path
            for path in found.data.get(file, set()) | found.read.get(file, set())
            if not inputs.is_module(path)
        }
        texts = sorted(path for path in read if path in files)
        result[file] = [
            *([path, name] for path, name in sorted(functions)),
            *([path, BODY] for path in sorted(modules)),
            *([path, TEXT] for path in texts),
        ]
    return result


def _functions(inputs: Inputs, places: Iterable[Place]) -> frozenset[tuple[str, str]]:
    return frozenset(
        (path, name)
        for path, line in places
        if line and path in inputs.parts and (name := inputs.parts[path].function_at(line))
    )


def collect(folders: list[Path], files: Mapping[str, str]) -> int:
    """Brings results of shards together that other machines made of this tree, and writes the tables.

    Raises:
        ShardError: they are no results of this tree.
    """
    folder = FOLDER / tree.digest(files)
    found = [path for each in folders for path in sorted(each.rglob(f"{folder.name}/*-of-*.json"))]
    if not found:
        raise ShardError(f"no results of this tree ({folder.name}) below {', '.join(map(str, folders))}")
    folder.mkdir(parents=True, exist_ok=True)
    for path in found:
        if path.parent.resolve() != folder.resolve():
            shutil.copy(path, folder)
    return _when_complete(folder, int(found[0].stem.partition("-of-")[2]), _table_or_none(), files)


def _table_or_none() -> Table:
    try:
        return read()
    except TableError:
        return Table()


def _when_complete(folder: Path, of: int, table: Table, files: Mapping[str, str]) -> int:
    parts = [folder / f"{Shard(number, of).name}.json" for number in range(1, of + 1)]
    results = {part.stem: json.loads(part.read_text(encoding="utf-8")) for part in parts if part.exists()}
    missing = [part.stem for part in parts if part.stem not in results]
    ended = [name for name, result in results.items() if not result["is_complete"]]
    if missing or ended:
        print(
            f"tests: no table is written: missing {missing or 'none'}, not run to the end {ended or 'none'}"
        )
        return 0
    return conclude(list(results.values()), table, files)


def conclude(results: list[dict[str, Any]], table: Table, files: Mapping[str, str]) -> int:
    """Writes the tables from the results of all shards; returns 1 where a test reads what no rule knows."""
    processor_s = {test: seconds for each in results for test, seconds in each["processor_s"].items()}
    wall_s = {test: seconds for each in results for test, seconds in each["wall_s"].items()}
    loaded: dict[str, frozenset[str]] = {}
    read: dict[str, set[str]] = {}
    for each in results:
        for file, seen in each["loaded"].items():
            loaded[file] = loaded.get(file, frozenset()) | frozenset(seen)
        for file, seen in each["read"].items():
            read.setdefault(file, set()).update(seen)
    new = merged(table, processor_s, wall_s)
    dear_files = {file_of(test) for test in new.dear()}
    modules = {
        file: frozenset(path for path in seen if path.endswith(".py"))
        for file, seen in loaded.items()
        if file in dear_files
    }
    executed = {
        file: Executed.of((path, name) for path, name in places)
        for each in results
        for file, places in each.get("executed", {}).items()
        if file in dear_files
    }
    inputs = Inputs(files, import_graph(), modules, executed=executed)
    gaps = sorted(
        (file, path)
        for file in dear_files
        for path in (loaded.get(file, frozenset()) | read.get(file, set())) - inputs.of(file)
    )
    for file, path in gaps:
        print(f"tests: no rule of tests/tools/selection/rules.py knows that {file} reads {path}")
    for each in results:
        for lane, seconds in each["lanes"].items():
            new.lanes[lane] = round(new.lanes.get(lane, 0.0) + seconds, 1)
    red = {file_of(test) for each in results for test in each["failed"]}
    new.inputs = {file: inputs.digest(file) for file in sorted(dear_files - red)}
    write_loaded({file: seen for file, seen in modules.items() if seen})
    write_executed(executed)
    write(new)
    print(
        f"tests: durations.json, loaded.json and executed.json are written: {len(new.dear())} dear tests; "
        f"the functions of {len(executed)} of {len(dear_files)} files are known"
    )
    core = core_share(new)
    if core < CORE_SHARE:
        print(f"tests: the core is {core:.0%} of the time of an unchanged tree, expected {CORE_SHARE:.0%}")
    return 1 if gaps or core < CORE_SHARE else 0


def core_share(table: Table) -> float:
    """Returns the core's part of the processor time of a tree that did not change, without the sample."""
    is_core, dear = core_of(core_patterns()), table.dear()
    core_s = sum(seconds for test, seconds in dear.items() if is_core(test))
    cheap_s = sum(table.files.values()) - sum(dear.values()) + sum(table.lanes.values())
    return core_s / (core_s + cheap_s)


def merged(table: Table, processor_s: Mapping[str, float], wall_s: Mapping[str, float]) -> Table:
    """Returns the table after one more full run; tests that are gone lose their lines."""
    new = Table()
    for test, seconds in processor_s.items():
        before = table.tests[test].processor_s if test in table.tests else ()
        runs = (*before, round(seconds, 2))[-RUNS:]
        if max(runs) >= CHEAP_S:
            new.tests[test] = Duration(runs, round(wall_s[test], 2))
        file = file_of(test)
        new.files[file] = round(new.files.get(file, 0.0) + seconds, 2)
    return new
