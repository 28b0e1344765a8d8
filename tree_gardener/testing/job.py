"""A job: the tests of a project with all that is needed to run them, as one JSON document.

A job is sent to the process that runs the tests, and stored in an exported package.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, Final

from tree_gardener.errors import Diagnostic
from tree_gardener.testing.cases import Case
from tree_gardener.testing.doubles import LeafModel, leaf_models
from tree_gardener.testing.reading import DEFAULT_HZ, Path, Place, read_tests
from tree_gardener.testing.suite import Suite

FORMAT: Final = "bt-studio/behaviour-tests"

Places = Mapping[Path, tuple[int, int]]


@dataclasses.dataclass(frozen=True)
class TestFile:
    """One file of tests: its name, its parsed document, and the places of its parts."""

    __test__ = False

    name: str
    document: Any
    places: Places = dataclasses.field(default_factory=dict)


@dataclasses.dataclass(frozen=True)
class Job:
    """The tests of a project.

    Attributes:
        files: the files of tests.
        nodes: the project's own node types.
        ports: the defaults of each tree's own ports.
        tick_hz: the rate of tests that give none.
        xml: the trees; "" if they are elsewhere.
        sources: Python source by action; None if none may run.
        on_error: what an exception of a real leaf does, as in a run: ``stop`` or ``failure``.
    """

    files: Sequence[TestFile]
    nodes: Mapping[str, LeafModel]
    ports: Mapping[str, Mapping[str, str]] = dataclasses.field(default_factory=dict)
    tick_hz: float = DEFAULT_HZ
    xml: str = ""
    sources: Mapping[str, str] | None = None
    on_error: str = "stop"

    def suite(self, *, xml: str | bytes = "", sources: Mapping[str, str] | None = None) -> Suite:
        """Returns the suite of the job; `xml` and `sources` replace its own."""
        return Suite(
            xml or self.xml,
            self.nodes,
            sources=sources or self.sources,
            ports=self.ports,
            on_error=self.on_error,
        )

    def cases(self, suite: Suite) -> tuple[list[Case], list[Diagnostic]]:
        """Returns the tests of all files, and the problems of unreadable ones."""
        cases: list[Case] = []
        problems: list[Diagnostic] = []
        for file in self.files:
            place = placer(file.places)
            found, wrong = read_tests(file.document, file.name, place, tick_hz=self.tick_hz, suite=suite)
            cases += found
            problems += wrong
        return cases, problems

    def to_json(self) -> dict[str, Any]:
        """Returns the job as a JSON object."""
        return {
            "format": FORMAT,
            "version": 1,
            "tick_hz": self.tick_hz,
            "on_error": self.on_error,
            "files": [
                {
                    "name": file.name,
                    "document": file.document,
                    "places": [[list(path), *place] for path, place in file.places.items()],
                }
                for file in self.files
            ],
            "nodes": {name: model.to_json() for name, model in sorted(self.nodes.items())},
            "ports": {tree: dict(ports) for tree, ports in self.ports.items()},
            "xml": self.xml,
            "sources": dict(self.sources) if self.sources is not None else None,
        }

    @classmethod
    def from_json(cls, document: Mapping[str, Any]) -> "Job":
        """Reads the form that `to_json` writes."""
        return cls(
            files=[
                TestFile(
                    file["name"],
                    file["document"],
                    {tuple(path): (line, column) for path, line, column in file["places"]},
                )
                for file in document["files"]
            ],
            nodes=leaf_models(document["nodes"]),
            ports=document["ports"],
            tick_hz=document["tick_hz"],
            on_error=document.get("on_error", "stop"),
            xml=document["xml"],
            sources=document["sources"],
        )


def placer(places: Places) -> Place:
    """Returns a function that finds a part of a document, or else the nearest part around it."""

    def place(path: Path) -> tuple[int, int]:
        while path and path not in places:
            path = path[:-1]
        return places.get(path, (1, 1))

    return place
