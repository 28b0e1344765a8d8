"""TestNode, which replaces other nodes by substitution rules."""

import dataclasses
from typing import TYPE_CHECKING

from tree_gardener.errors import PortError, ScriptError, TickError, shown
from tree_gardener.node import Leaf
from tree_gardener.script import Environment, compile_script
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status
from tree_gardener.values import ConversionError, status_of

if TYPE_CHECKING:
    from tree_gardener.clock import Timer


@dataclasses.dataclass(frozen=True)
class TestConfig:
    """The configuration of a TestNode.

    Attributes:
        return_status: the result of the node.
        return_status_script: a script whose value is the result, by name or number; it overrides
            `return_status`.
        async_delay_s: the seconds for which the node is RUNNING before the result.
        success_script: runs when the result is SUCCESS.
        failure_script: runs when the result is FAILURE.
        post_script: runs in either case.
    """

    __test__ = False  # the name is BehaviorTree.CPP's; pytest must not collect it

    return_status: Status = SUCCESS
    return_status_script: str = ""
    async_delay_s: float = 0.0
    success_script: str = ""
    failure_script: str = ""
    post_script: str = ""

    @property
    def problem(self) -> str:
        """The reason for which no node can have the configuration, or ""."""
        if self.return_status is IDLE and not self.return_status_script:
            return "it returns IDLE, which is no result"
        for text in (self.return_status_script, self.success_script, self.failure_script, self.post_script):
            try:
                if text:
                    compile_script(text)
            except ScriptError as error:
                return f"in the script '{shown(text)}': {error}"
        return ""


class TestNode(Leaf):
    """Replaces another node in tests; substitution rules create it.

    It is RUNNING for `async_delay` milliseconds, then runs its scripts and returns the configured status.
    """

    __test__ = False
    __slots__ = ("config", "environment", "is_over", "timer")

    config: TestConfig

    def prepare(self) -> None:
        self.environment = Environment(self.board, self.tree.enums, self.uid)
        self.timer: Timer | None = None
        self.is_over = False

    def execute(self) -> Status:
        if self.status is RUNNING:
            return self.end() if self.is_over else RUNNING
        if self.status is not IDLE:
            return self.complete(self.status)  # kept: its parent may reset it in this tick
        if self.config.async_delay_s <= 0:
            return self.end()
        self.is_over = False
        self.timer = self.tree.timers.start(self.config.async_delay_s, self.fire)
        self.start()
        return RUNNING

    def fire(self) -> None:
        self.is_over = True
        self.tree.wake_up = True

    def end(self) -> Status:
        config = self.config
        result = self.result()
        if result is SUCCESS:
            self.script(config.success_script)
        elif result is FAILURE:
            self.script(config.failure_script)
        self.script(config.post_script)
        if result is SKIPPED:
            return self.skipped()
        if result is RUNNING:
            if self.status is not RUNNING:
                self.start()
            return RUNNING
        if result is IDLE:
            raise TickError(self, "a TestNode must not return IDLE")
        return self.complete(result)

    def result(self) -> Status:
        if not self.config.return_status_script:
            return self.config.return_status
        enums = {**self.environment.enums, **{status.name: status.number for status in Status}}
        value = self.script(
            self.config.return_status_script, Environment(self.board, enums, self.environment.writer)
        )
        try:
            return status_of(value)
        except ConversionError as error:
            raise TickError(self, f"return_status_script: {error}") from None

    def script(self, text: str, environment: Environment | None = None) -> object:
        if not text:
            return None
        try:
            return compile_script(text).run(environment or self.environment)
        except (ScriptError, PortError) as error:
            raise TickError(self, f"in the script '{shown(text)}': {error}") from None

    def halt(self) -> None:
        if self.timer is not None:
            self.timer.cancel()
            self.timer = None
        self.status = IDLE
