"""Commands and events of Groot2's protocol, both ways: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

AttachState = Literal["connecting", "following", "silent"]


class Control(Struct, forbid_unknown_fields=True):
    """Sets whether the user controls the robot whose program this session is attached to.

    Without it breakpoints have no effect there and nothing is forced. When it ends, all that was set there
    is removed, and a held tree runs on. Refused with `not_attached` in another session.
    """

    on: bool


class Attached(Struct):
    """The other program of an attached session, sent each second and at each change.

    `age_s` is the time since its last answer, or null before the first. `dropped` counts what it sent that
    could not be read. `controls` tells whether the user controls the robot. `problem` says in words why
    nothing is shown, or what the program refuses.
    """

    address: str
    state: AttachState
    age_s: float | None = None
    dropped: int = 0
    controls: bool = False
    problem: str = ""


class AttachedTree(Struct):
    """The tree of the other program as diagrams, sent before its event `tree`.

    `files` are the texts of the diagrams and of `project.json` by path, `actions` the models of its nodes
    that are not built in, and `xml` the tree in the form in which it can be imported.
    """

    name: str
    main_tree: str
    files: dict[str, str]
    actions: list[dict[str, Any]]
    xml: str


class ServeGroot2(Struct, forbid_unknown_fields=True):
    """Allows Groot2, or another client of its protocol on this machine, to look at the tree that runs.

    It answers at `port` and the next one, also in later runs of the session; with 0 no longer. Refused with
    `port_taken` while a run cannot have the ports, and with `isolated` where no other program of the machine
    reaches the session.
    """

    port: Annotated[int, Meta(ge=0, le=65534)] = 1667


class Groot2(Struct):
    """The port at which Groot2 can look at the trees of this session; 0 for none."""

    port: int = 0
