"""The common form of what a benchmark measures.

A benchmark offers `measure(options)`, which yields its figures; `main()` prints them by `show`, and
`--beside REVISION` compares them with those of another revision. One that offers `main()` alone is compared
as a whole process.
"""

from __future__ import annotations

import argparse
import dataclasses
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

Better = Literal["lower", "higher"]


@dataclasses.dataclass(frozen=True)
class Figure:
    """One measured value; `better` says which of two is the better one."""

    name: str
    value: float
    unit: str
    better: Better = "lower"

    def __str__(self) -> str:
        return f"{self.name:66} {number(self.value):>10} {self.unit}"

    def to_json(self) -> dict[str, Any]:
        """Returns its fields."""
        return dataclasses.asdict(self)


def number(value: float) -> str:
    """Returns a value with about four digits; a whole one without a point."""
    size = abs(value)
    return (
        f"{value:,.0f}"
        if size >= 1000 or value == round(value)
        else f"{value:.{3 if size < 1 else 2 if size < 10 else 1}f}"
    )


def show(figures: Iterable[Figure]) -> None:
    """Prints each figure as soon as it is measured."""
    for figure in figures:
        print(figure, flush=True)


def of_parts(parts: Mapping[str, Callable[[], Iterable[Figure]]], options: Sequence[str]) -> Iterable[Figure]:
    """Yields the figures of all parts of a benchmark, or of those that `--parts` names."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--parts", nargs="+", choices=[*parts], default=[*parts])
    for part in parser.parse_args(options).parts:
        yield from parts[part]()
