import re
from collections.abc import Mapping
from typing import ClassVar, Final

from tree_gardener.errors import PortError, TickError
from tree_gardener.node import Control
from tree_gardener.ports import read_port
from tree_gardener.script.operators import TOLERANCE
from tree_gardener.status import RUNNING, SKIPPED, Status
from tree_gardener.values import INT32

_INTEGER = re.compile(r"-?[0-9]+\Z")
_REAL = re.compile(r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?\Z")


class Switch(Control):
    """Ticks the child whose case equals the variable, or the last one.

    Variable and cases are read as strings at every tick. They are equal as strings, else as integers, else as
    real numbers with a small tolerance; names of enum constants count as their numbers. If no case matches,
    or the variable cannot be read, the last child is ticked. When the choice changes, a RUNNING child is
    halted. A SKIPPED child makes the Switch SKIPPED. A Switch needs one child more than it has cases.
    """

    __slots__ = ("running",)
    MARKS_RUNNING = ()
    CASES: ClassVar[int]

    def prepare(self) -> None:
        super().prepare()
        self.running = -1

    def execute(self) -> Status:
        cases = self.CASES
        if len(self.children) != cases + 1:
            raise TickError(self, f"a Switch{cases} needs {cases + 1} children and has {len(self.children)}")
        chosen = self.choose(cases)
        if self.running not in (-1, chosen):
            self.reset_child(self.running)
        status = self.ticks[chosen]()
        if status is RUNNING:
            self.running = chosen
            if self.status is not RUNNING:
                self.start()
            return RUNNING
        self.running = -1
        return self.skipped() if status is SKIPPED else self.finish(status)

    def choose(self, cases: int) -> int:
        """Returns the index of the child to tick."""
        try:
            variable = read_port(self, "variable")
        except PortError:
            return cases
        for index in range(cases):
            try:
                value = read_port(self, f"case_{index + 1}")
            except PortError:
                continue
            if equal(variable, value, self.tree.enums):
                return index
        return cases

    def halt(self) -> None:
        self.running = -1
        super().halt()


SWITCHES: Final[Mapping[str, type[Switch]]] = {
    f"Switch{cases}": type(
        f"Switch{cases}", (Switch,), {"__slots__": (), "CASES": cases, "__doc__": Switch.__doc__}
    )
    for cases in range(2, 7)
}


def equal(left: str, right: str, enums: Mapping[str, int]) -> bool:
    """Returns whether two texts are equal as strings, integers, or real numbers."""
    if left == right:
        return True
    a, b = _integer(left, enums), _integer(right, enums)
    if a is not None and a == b:
        return True
    x, y = _real(left, enums), _real(right, enums)
    return x is not None and y is not None and abs(x - y) <= TOLERANCE


def _integer(text: str, enums: Mapping[str, int]) -> int | None:
    if text in enums:
        return enums[text]
    if not _INTEGER.match(text):
        return None
    number = int(text)
    return number if INT32[0] <= number <= INT32[1] else None


def _real(text: str, enums: Mapping[str, int]) -> float | None:
    if text in enums:
        return float(enums[text])
    return float(text) if _REAL.match(text) else None
