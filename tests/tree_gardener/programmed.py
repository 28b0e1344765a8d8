"""Control nodes and decorators whose tick and halt are programs; `contract_nodes.hpp` is the same in C++."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from tree_gardener import ControlNode, DecoratorNode, Port, Status, TickError

if TYPE_CHECKING:
    from tree_gardener.conformance.leaves import Trace

MOST_WAKE_UPS = 3
LETTERS = {status.letter: status for status in Status}


class Programmed(ControlNode):
    """Runs the next part of its port `program` in each tick, and of `on_halt` in each halt."""

    INPUT_PORTS: ClassVar = {"program": Port(str), "on_halt": Port(str, default="")}
    trace: ClassVar[Trace]

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.cursors: dict[str, int] = {}
        self.last = Status.SUCCESS

    def note(self, text: str) -> None:
        self.trace.events.append(f"{text}:{self.tree_gardener_node.path}")

    def next(self, port: str) -> list[str]:
        parts = self.get_input(port).split("|")
        cursor = self.cursors.get(port, 0)
        self.cursors[port] = cursor + 1
        return list(parts[min(cursor, len(parts) - 1)].split())

    def statuses(self) -> str:
        return "".join(self.child_status(index).letter for index in range(self.child_count))

    def update(self) -> Status:
        self.last = Status.SUCCESS
        for word in self.next("program"):
            if word[0] == "?":
                if LETTERS[word[1]] is self.last:
                    break
            elif word[0] == "=":
                return self.last if word[1] == "L" else LETTERS[word[1]]
            else:
                self.step(word)
        return self.last

    def halt(self) -> None:
        self.note(f"halting {self.status.letter} {self.statuses()}")
        for word in self.next("on_halt"):
            self.step(word)
        super().halt()

    def step(self, word: str) -> None:
        """Does what one word says."""
        number = int(word[1:] or 0)
        steps: dict[str, Any] = {
            "t": lambda: self.tick(number),
            "x": lambda: self.tick_and_catch(number),
            "h": lambda: self.halt_child(number),
            "a": lambda: self.halt_children(number),
            "r": self.reset_children,
            "m": self.mark_running,
            "H": self.halt,
            "w": self.wake,
            "c": lambda: self.note(f"children {self.statuses()}"),
            "s": lambda: self.note(f"own {self.status.letter}"),
            "E": self.fail,
        }
        steps[word[0]]()

    def tick(self, number: int) -> None:
        self.last = self.tick_child(number)
        self.note(f"ticked {self.last.letter}")

    def tick_and_catch(self, number: int) -> None:
        try:
            self.last = self.tick_child(number)
        except TickError:
            self.note("caught")
            self.last = Status.FAILURE

    def wake(self) -> None:
        count = self.cursors["wake"] = self.cursors.get("wake", 0) + 1
        if count <= MOST_WAKE_UPS:
            self.emit_wake_up()

    def fail(self) -> None:
        raise RuntimeError("mine")


class ProgrammedDecorator(Programmed, DecoratorNode):
    """The same as a decorator."""

    NODE_KIND = "Decorator"


def programmed(trace: Trace) -> dict[str, type[ControlNode]]:
    """Returns the classes of the cases; they write to this trace."""
    classes = {"Own": Programmed, "OwnDecorator": ProgrammedDecorator}
    return {
        f"{name}{'Marked' if marks else ''}": type(name, (cls,), {"trace": trace, "MARKS_RUNNING": marks})
        for name, cls in classes.items()
        for marks in (False, True)
    }
