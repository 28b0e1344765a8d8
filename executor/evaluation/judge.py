"""Decides a run by its truth: goals are met once and stay met, `never` must hold until the run ends."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.areas import contains, distance_m
from tree_gardener.descriptions import text_of
from tree_gardener.values import as_number, type_name_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from executor.evaluation.document import Criterion, Judge, Never, Reach
    from executor.evaluation.truth import Sample, Truth

    Corners = Sequence[tuple[float, float]]
    Python = Callable[[Truth], Mapping[str, float]]
    """A function of the project."""

SUCCESS: Final = "success"
FAILURE: Final = "failure"
EPSILON_S: Final = 1e-9


class JudgeError(Exception):
    """A function of the project returned something other than numbers by their names."""


@dataclass(frozen=True)
class Decision:
    """The end of a run: its outcome, its time, and the item that decided it."""

    outcome: str
    at_s: float
    why: str


@dataclass(frozen=True)
class Verdict:
    """The result of one item: whether it holds, when it was met or broken, and by how much it holds.

    The margin is negative if the item does not hold; its unit is m or s, or empty for numbers of `python`.
    """

    item: str
    holds: bool
    at_s: float | None
    margin: float | None
    unit: str

    def to_json(self) -> dict[str, Any]:
        """Returns the verdict as a JSON object."""
        margin = None if self.margin is None else round(self.margin, 6)
        at_s = None if self.at_s is None else round(self.at_s, 6)
        return {"item": self.item, "holds": self.holds, "at_s": at_s, "margin": margin, "unit": self.unit}


class Item(ABC):
    """One item of `success`."""

    is_goal = False

    def __init__(self, name: str, deadline_s: float | None = None) -> None:
        self.name = name
        self.deadline_s = deadline_s
        self.met_s: float | None = None
        self.broken_s: float | None = None

    def look(self, truth: Truth) -> None:
        """Takes the last sample into account."""
        now = truth.samples[-1]
        self.see(truth, now)
        late = self.deadline_s is not None and now.time_s > self.deadline_s + EPSILON_S
        if self.is_goal and self.met_s is None and self.broken_s is None and late:
            self.broken_s = now.time_s

    @abstractmethod
    def see(self, truth: Truth, now: Sample) -> None:
        """Sets `met_s` or `broken_s` if the sample decides it."""

    @abstractmethod
    def verdict(self, duration_s: float) -> Verdict:
        """Returns the outcome of the item."""

    def _of_goal(self, missing_m: float | None) -> Verdict:
        holds = self.met_s is not None
        if holds and self.deadline_s is not None:
            margin, unit = self.deadline_s - (self.met_s or 0.0), "s"
        elif holds:
            margin, unit = None, ""
        else:
            margin, unit = (None, "") if missing_m is None else (-missing_m, "m")
        return Verdict(self.name, holds, self.met_s, margin, unit)


class ReachItem(Item):
    """The robot stands in an area."""

    is_goal = True

    def __init__(self, reach: Reach, areas: Mapping[str, Corners]) -> None:
        super().__init__(f"reach {reach.area}", reach.within_s)
        self._corners = areas[reach.area]
        self._nearest_m = math.inf

    def see(self, truth: Truth, now: Sample) -> None:
        """Marks the item as met if the robot is in the area before the time limit."""
        in_time = self.deadline_s is None or now.time_s <= self.deadline_s + EPSILON_S
        if self.met_s is None and in_time:
            self._nearest_m = min(self._nearest_m, distance_m(self._corners, now.x, now.y))
            if self._nearest_m == 0.0:
                self.met_s = now.time_s

    def verdict(self, duration_s: float) -> Verdict:
        """Returns the time left, or the smallest distance from the area."""
        return self._of_goal(self._nearest_m)


class VisitItem(Item):
    """The robot has stood in each of some areas, in their order if that is demanded."""

    is_goal = True

    def __init__(
        self, names: Sequence[str], areas: Mapping[str, Corners], *, in_order: bool, deadline_s: float | None
    ) -> None:
        super().__init__(f"visit {', '.join(names)}{' in order' if in_order else ''}", deadline_s)
        self._left = [(name, areas[name]) for name in names]
        self._in_order = in_order

    def see(self, truth: Truth, now: Sample) -> None:
        """Is met when no area is left."""
        if not self._left or self.broken_s is not None:
            return
        if self._in_order:
            while self._left and contains(self._left[0][1], now.x, now.y):
                self._left.pop(0)
        else:
            self._left = [each for each in self._left if not contains(each[1], now.x, now.y)]
        if not self._left and (self.deadline_s is None or now.time_s <= self.deadline_s + EPSILON_S):
            self.met_s = now.time_s

    def verdict(self, duration_s: float) -> Verdict:
        """Returns the time left; a visit that is missing has no margin."""
        return self._of_goal(None)


class TreeItem(Item):
    """The tree ends with a result."""

    is_goal = True

    def __init__(self, status: str, deadline_s: float | None) -> None:
        super().__init__(f"tree {status}", deadline_s)
        self._status = status

    def see(self, truth: Truth, now: Sample) -> None:
        """Is met when the tree has ended so."""
        if self.met_s is None and self.broken_s is None and now.root == self._status:
            self.met_s = now.time_s

    def verdict(self, duration_s: float) -> Verdict:
        """Returns the time left."""
        return self._of_goal(None)


class CollisionItem(Item):
    """The robot never collides."""

    def __init__(self) -> None:
        super().__init__("never collision")
        self._clearance_m: float | None = None

    def see(self, truth: Truth, now: Sample) -> None:
        """Is broken by the first collision."""
        self._clearance_m = truth.smallest_clearance_m
        if self.broken_s is None and truth.bumps:
            self.broken_s = truth.bumps[0].time_s

    def verdict(self, duration_s: float) -> Verdict:
        """Returns the smallest clearance, or how much of the time was left at the collision."""
        if self.broken_s is not None:
            return Verdict(
                self.name, holds=False, at_s=self.broken_s, margin=self.broken_s - duration_s, unit="s"
            )
        unit = "m" if self._clearance_m is not None else ""
        return Verdict(self.name, holds=True, at_s=None, margin=self._clearance_m, unit=unit)


class CloserItem(Item):
    """The robot never comes closer to something than a distance."""

    def __init__(self, never: Never, measure: Callable[[], float | None]) -> None:
        super().__init__(f"never closer than {never.closer_than_m:g} m to {never.to}")
        self._limit_m = never.closer_than_m or 0.0
        self._measure = measure
        self._smallest_m: float | None = None

    def see(self, truth: Truth, now: Sample) -> None:
        """Is broken by the first distance that is too small."""
        self._smallest_m = self._measure()
        if self.broken_s is None and self._smallest_m is not None and self._smallest_m < self._limit_m:
            self.broken_s = now.time_s

    def verdict(self, duration_s: float) -> Verdict:
        """Returns by how much the smallest distance was more than the limit."""
        margin = None if self._smallest_m is None else self._smallest_m - self._limit_m
        unit = "" if margin is None else "m"
        return Verdict(self.name, self.broken_s is None, self.broken_s, margin, unit)


class PythonItem(Item):
    """The numbers of a function of the project keep their thresholds. It is called when the run ends."""

    def __init__(self, criterion: Criterion, function: Python) -> None:
        super().__init__(f"python {criterion.python}")
        self._criterion = criterion
        self._function = function
        self._margin: float | None = None
        self.numbers: dict[str, float] = {}

    def see(self, truth: Truth, now: Sample) -> None:
        """Nothing is decided before the end."""

    def decide(self, truth: Truth) -> None:
        """Calls the function, and is broken by a threshold that its numbers do not keep.

        Raises:
            JudgeError: it returns something else than numbers, or not all that have a threshold.
        """
        returned: Any = self._function(truth)
        self.numbers = _numbers(returned, self.name)
        margins = []
        for sign, limits in ((1, self._criterion.at_least), (-1, self._criterion.at_most)):
            for name, limit in limits.items():
                if name not in self.numbers:
                    raise JudgeError(f"{self.name} returned no {name!r}, which has a threshold")
                margins.append(sign * (self.numbers[name] - limit))
        self._margin = min(margins)
        self.met_s = self.broken_s = None
        if self._margin < 0:
            self.broken_s = truth.time_s

    def verdict(self, duration_s: float) -> Verdict:
        """Returns the smallest difference from a threshold."""
        return Verdict(self.name, self._margin is not None and self._margin >= 0, None, self._margin, "")


def _numbers(returned: Any, name: str) -> dict[str, float]:
    if not issubclass(type(returned), dict):
        raise JudgeError(f"{name} returned {type_name_of(returned)}, not a dictionary of numbers")
    found = {}
    for key, value in dict.items(returned):
        number = None if type(value) is bool else as_number(value)
        if not issubclass(type(key), str) or number is None:
            raise JudgeError(
                f"{name} returned {text_of(key)}: {text_of(value)}, which is no number by its name"
            )
        try:  # not their own methods, which users may replace
            real = float.__float__(number) if isinstance(number, float) else float(int.__int__(number))
        except OverflowError:
            real = math.inf
        if not math.isfinite(real):
            raise JudgeError(f"{name} returned {text_of(key)}: {text_of(value)}, which is not finite")
        found[str.__str__(key)] = real
    return found


class Referee:
    """Judges one run: call `look` with each sample, until it returns a decision."""

    def __init__(self, items: Sequence[Item], duration_s: float) -> None:
        self.items = items
        self._duration_s = duration_s
        self._goals = [item for item in items if item.is_goal]

    def look(self, truth: Truth) -> Decision | None:
        """Returns the decision that the last sample brings, or None while the run continues.

        Raises:
            JudgeError: a function of the project returned something else than numbers.
        """
        now_s = truth.time_s
        for item in self.items:
            item.look(truth)
        broken = [item for item in self.items if item.broken_s is not None]
        if broken:
            first = min(broken, key=lambda item: item.broken_s or 0.0)
            late = ": the time is over" if first.is_goal else ""
            return Decision(FAILURE, first.broken_s or now_s, f"{first.name}{late}")
        is_over = now_s >= self._duration_s - EPSILON_S
        unmet = [goal for goal in self._goals if goal.met_s is None]
        if (self._goals and not unmet) or is_over:
            for item in self.items:
                if isinstance(item, PythonItem):
                    item.decide(truth)
            wanting = unmet or [item for item in self.items if item.broken_s is not None]
            if wanting:
                return Decision(FAILURE, now_s, wanting[0].name)
            return Decision(SUCCESS, now_s, "all items hold")
        return None

    def verdicts(self) -> list[Verdict]:
        """Returns the outcome of each item."""
        return [item.verdict(self._duration_s) for item in self.items]

    def numbers(self) -> dict[str, float]:
        """Returns the numbers of the project's functions."""
        return {
            name: value
            for item in self.items
            if isinstance(item, PythonItem)
            for name, value in item.numbers.items()
        }


def make_items(
    judge: Judge,
    areas: Mapping[str, Corners],
    measure: Callable[[str], Callable[[], float | None]],
    function: Callable[[str], Python],
) -> list[Item]:
    """Returns the items of a judge.

    Args:
        judge: the judge.
        areas: the corners of the universe's areas.
        measure: returns, for the name of a thing, a function that returns the smallest distance to it so far.
        function: loads a function of the project.
    """
    items: list[Item] = []
    for criterion in judge.success:
        if criterion.reach is not None:
            items.append(ReachItem(criterion.reach, areas))
        elif criterion.never is not None and criterion.never.collision:
            items.append(CollisionItem())
        elif criterion.never is not None:
            items.append(CloserItem(criterion.never, measure(criterion.never.to)))
        elif criterion.visit is not None:
            items.append(
                VisitItem(criterion.visit, areas, in_order=criterion.in_order, deadline_s=criterion.within_s)
            )
        elif criterion.tree is not None:
            items.append(TreeItem(criterion.tree, criterion.within_s))
        else:
            items.append(PythonItem(criterion, function(criterion.python or "")))
    return items
