"""The parcel of an evaluation: all that another machine needs to run its seeds."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import msgspec

from executor.evaluation.plan import make_plan
from translator import open_files

if TYPE_CHECKING:
    from executor.evaluation.plan import Plan


class Parcel(msgspec.Struct, frozen=True):
    """The files of a project, and what is evaluated. `judge` has the files of another project that judges."""

    files: dict[str, bytes]
    judge: dict[str, bytes] | None
    name: str
    to_the_end: bool
    sealed: bool


def pack(plan: Plan) -> bytes:
    """Returns the parcel of a plan."""
    judge = None if plan.origin is None else dict(plan.origin.files)
    parcel = Parcel(dict(plan.project.files), judge, plan.name, plan.to_the_end, plan.sealed)
    return msgspec.msgpack.encode(parcel)


def unpack(data: bytes) -> Plan:
    """Returns the plan of a parcel.

    Raises:
        ValueError: the data is no parcel.
        EvaluationError: the evaluation cannot be run here.
        DocumentError: as above.
        TranslatorError: as above.
    """
    parcel = msgspec.msgpack.decode(data, type=Parcel)
    plan = make_plan(open_files(parcel.judge or parcel.files), parcel.name)
    if parcel.judge is not None:
        plan = plan.with_project(open_files(parcel.files))
    return replace(plan, to_the_end=parcel.to_the_end, sealed=parcel.sealed)
