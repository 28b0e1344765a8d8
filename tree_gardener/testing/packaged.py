"""The tests of an exported package, for its ``test_behaviours.py``."""

import json
import pathlib
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.testing.job import Job

if TYPE_CHECKING:
    from tree_gardener.testing.cases import Case
    from tree_gardener.testing.suite import Suite

FILE: Final = "behaviour_tests.json"


class PackagedTests:
    """The tests beside a package's trees and actions.

    Args:
        folder: the package's folder ``test``, which holds the tests.
        package: the name of the package.
    """

    def __init__(self, folder: pathlib.Path, package: str) -> None:
        job = Job.from_json(json.loads((folder / FILE).read_text(encoding="utf-8")))
        tree = folder.parent / "trees" / f"{package}.xml"
        actions = folder.parent / package / "actions"
        sources = {
            path.stem: path.read_text(encoding="utf-8")
            for path in sorted(actions.glob("*.py"))
            if path.stem != "__init__"
        }
        self.suite: Suite = job.suite(xml=tree.read_bytes(), sources=sources)
        cases, problems = job.cases(self.suite)
        self.cases: dict[str, Case] = {f"{case.file}: {case.name}": case for case in cases}
        self.problems = [str(problem) for problem in problems]

    def failures(self, name: str) -> list[str]:
        """Runs one test; returns its failures, in sentences."""
        return [str(failure) for failure in self.suite.run(self.cases[name]).failures]

    def parameters(self) -> list[Any]:
        """Returns the names of the tests, for ``pytest.mark.parametrize``."""
        return list(self.cases)
