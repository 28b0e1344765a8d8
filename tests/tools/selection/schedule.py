"""A queue of files for the workers of pytest-xdist, longest first, each with the files that suit it."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto
from typing import TYPE_CHECKING, Final

from xdist.scheduler import LoadScopeScheduling

from tests.tools.selection.table import file_of

if TYPE_CHECKING:
    from collections.abc import Callable

    import pytest
    from xdist.remote import Producer
    from xdist.workermanage import WorkerController

    from tests.tools.selection.table import Table

BROWSER: Final = "tests/e2e/"
# A file whose tests wait this long, for this many times of their processor time, costs the machine little.
WAITING_S: Final = 5.0
WAITING_TIMES: Final = 3.0


class Kind(Enum):
    """The needs of a file of tests towards its worker."""

    BROWSER = auto()  # Playwright's event loop occupies the main thread, so that no other tests can follow
    WAITING = auto()
    WORKING = auto()


# Which files each worker takes, the preferred kind first. Workers beyond these take what is no browser's.
TAKES: Final = ((Kind.BROWSER,), (Kind.WAITING, Kind.WORKING), (Kind.WORKING, Kind.WAITING))


@dataclass(frozen=True)
class Files:
    """The wall time of each file in seconds, and which files mostly wait."""

    wall_s: dict[str, float]
    waiting: frozenset[str]

    @staticmethod
    def of(table: Table) -> Files:
        """Adds up the tests of each file."""
        wall_s, processor_s = dict(table.files), dict.fromkeys(table.files, 0.0)
        for test, duration in table.tests.items():
            file = file_of(test)
            processor_s[file] = processor_s.get(file, 0.0) + duration.median_s
            wall_s[file] = wall_s.get(file, 0.0) + max(0.0, duration.wall_s - duration.median_s)
        waiting = {
            file
            for file, seconds in wall_s.items()
            if seconds > WAITING_S
            and seconds > WAITING_TIMES * table.files.get(file, processor_s.get(file, 0.0))
        }
        return Files(wall_s, frozenset(waiting))

    def kind(self, file: str) -> Kind:
        """Returns what a file asks of its worker."""
        if file.startswith(BROWSER):
            return Kind.BROWSER
        return Kind.WAITING if file in self.waiting else Kind.WORKING


class Queue(LoadScopeScheduling):
    """Gives each worker the longest file of its kinds, as long as there are any."""

    def __init__(
        self, config: pytest.Config, log: Producer, files: Files, scope_of: Callable[[str], str]
    ) -> None:
        super().__init__(config, log)
        self._files = files
        self._scope_of = scope_of
        self._takes: dict[WorkerController, tuple[Kind, ...]] = {}
        self._free = list(TAKES)

    def schedule(self) -> None:
        """Starts the workers; where few files keep some from starting, the first one takes their kinds."""
        if self.collection is None:
            files = {self._scope_of(test) for tests in self.registered_collections.values() for test in tests}
            kept = self.nodes[: max(1, len(files))]  # its base stops the others
            taken = {kind for node in kept for kind in self._takes[node]}
            missing = {self._files.kind(file) for file in files} - taken
            kinds = {*self._takes[kept[0]], *missing}
            self._takes[kept[0]] = tuple(sorted(kinds, key=lambda kind: kind is Kind.BROWSER))
        super().schedule()

    def _split_scope(self, nodeid: str) -> str:
        return self._scope_of(nodeid)

    def add_node(self, node: WorkerController) -> None:
        """Gives a new worker its kinds: those of a crashed one are free again."""
        super().add_node(node)
        self._takes[node] = self._free.pop(0) if self._free else TAKES[-1]

    def remove_node(self, node: WorkerController) -> str | None:
        """Frees the kinds of a worker that ended, so that one in its place takes them."""
        self._free.insert(0, self._takes.pop(node))
        return super().remove_node(node)

    def _assign_work_unit(self, node: WorkerController) -> None:
        for kind in self._takes[node]:
            found = [file for file in self.workqueue if self._files.kind(file) is kind]
            if found:
                longest = max(found, key=lambda file: self._files.wall_s.get(file, 0.0))
                self.workqueue.move_to_end(longest, last=False)
                super()._assign_work_unit(node)
                return
        node.shutdown()  # nothing in the queue suits it

    def _reschedule(self, node: WorkerController) -> None:
        if (
            node.shutting_down or self._pending_of(self.assigned_work[node]) > 2
        ):  # as its base: two are at hand
            return
        if not self.workqueue:
            node.shutdown()
        else:
            self._assign_work_unit(node)
