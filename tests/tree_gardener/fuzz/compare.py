"""Compares cases in both engines, and reduces those that differ."""

from __future__ import annotations

import dataclasses
import json
import pickle
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from tests.tree_gardener.fuzz.trace import run_ours
from tree_gardener import LoadError

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from tests.tree_gardener.fuzz.generate import Case, Spec
    from tests.tree_gardener.fuzz.reference import Line

ROOT = Path(__file__).parents[3]
LONGEST_S = 300
# A program with a publisher is followed by clients in real time.
CASE_S = 5
TRIED, MOST_TRIED = 40, 400


def reference_traces(
    cases: Sequence[object], child: str = "tests.tree_gardener.fuzz.child"
) -> list[list[Line] | None]:
    """The traces of BehaviorTree.CPP, run by the module `child`; None where it crashed or did not end."""
    traces: list[list[Line] | None] = []
    while len(traces) < len(cases):
        process = subprocess.run(
            [sys.executable, "-m", child],
            input=pickle.dumps(cases[len(traces) :]),
            capture_output=True,
            cwd=ROOT,
            timeout=LONGEST_S + CASE_S * len(cases),
            check=False,
        )
        lines = process.stdout.decode().splitlines()
        traces += [json.loads(line) for line in lines]
        if process.returncode != 0:
            if process.returncode > 0:
                raise RuntimeError(process.stderr.decode()[-2000:])
            traces.append(None)  # killed by a signal of its own
    return traces[: len(cases)]  # one that is killed at its end has written all


def our_trace(case: Case) -> list[Line]:
    """Our trace, as the reference writes it."""
    try:
        return run_ours(case)
    except LoadError:
        return [{"load": "refused"}]


def difference(case: Case, reference: list[Line] | None) -> str:
    """Returns the first difference of the two traces, or ""."""
    if reference is None:
        return ""
    ours = our_trace(case)
    for index, (expected, found) in enumerate(zip(reference, ours, strict=False)):
        if expected != found:
            return f"line {index}:\n  BT.CPP {expected}\n  ours   {found}"
    return "" if len(reference) == len(ours) else f"{len(reference)} lines in BT.CPP, {len(ours)} in ours"


def shrink(case: Case) -> Case:
    """A smaller case that still differs, found by leaving out parts one after the other."""
    while (smaller := _first_that_differs(case)) is not None:
        case = smaller
    return case


def _first_that_differs(case: Case) -> Case | None:
    """Asks for few candidates at a time: most often one of the first ones differs."""
    candidates = [candidate for candidate in _smaller(case) if candidate.size <= case.size][:MOST_TRIED]
    for start in range(0, len(candidates), TRIED):
        some = candidates[start : start + TRIED]
        for candidate, reference in zip(some, reference_traces(some), strict=True):
            if difference(candidate, reference):
                return candidate
    return None


def _smaller(case: Case) -> Iterator[Case]:
    for index, (name, spec) in enumerate(case.trees):
        for simpler in _simpler(spec):
            trees = [*case.trees[:index], (name, simpler), *case.trees[index + 1 :]]
            yield dataclasses.replace(case, trees=tuple(trees))
    if case.halts:
        yield dataclasses.replace(case, halts=())
    for index in range(len(case.writes)):
        yield dataclasses.replace(case, writes=(*case.writes[:index], *case.writes[index + 1 :]))
    if case.ticks > 1:
        yield dataclasses.replace(case, ticks=case.ticks - 1)


def _simpler(spec: Spec) -> Iterator[Spec]:
    yield from spec.children
    if len(spec.children) > 1:
        for index in range(len(spec.children)):
            children = (*spec.children[:index], *spec.children[index + 1 :])
            yield dataclasses.replace(spec, children=children)
    for index, (name, _) in enumerate(spec.attributes):
        if name.startswith("_"):
            attributes = (*spec.attributes[:index], *spec.attributes[index + 1 :])
            yield dataclasses.replace(spec, attributes=attributes)
    for index, child in enumerate(spec.children):
        for simpler in _simpler(child):
            children = (*spec.children[:index], simpler, *spec.children[index + 1 :])
            yield dataclasses.replace(spec, children=children)


def report(case: Case) -> str:
    """A failure for people: seed, shrunk document, first difference."""
    small = shrink(case)
    first = difference(small, reference_traces([small])[0])
    return (
        f"seed {case.seed}, {case.mode}, shrunk from {case.size} to {small.size} nodes, "
        f"halts {small.halts}, writes {small.writes}\n{small.xml()}\n{first}"
    )
