"""The command `apply` and its event: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from msgspec import Struct


class Apply(Struct, forbid_unknown_fields=True):
    """Replaces the running tree by that of an app zip, between two ticks; world and program continue.

    The event `applied` comes before the reply. With `dry` it says what would happen, and nothing changes.
    Refused with `not_applied`, with file and line where they are known, if the new tree or its code cannot be
    loaded, set up, or take over; the running tree continues. Launch nodes are not restarted.
    """

    app_zip_base64: str
    dry: bool = False


class RunOn(Struct, forbid_unknown_fields=True):
    """Resumes a paused run, with the tree of an app zip if there is one: as `apply`, then `resume`.

    After `go_back` it is what would have happened with that tree. Refused as `apply` is; then the run stays
    paused, and its tree is as it was.
    """

    app_zip_base64: str = ""


class AppliedNode(Struct):
    """A node of the tree: its path, and the block of the diagram from which it was made."""

    path: str
    node_id: str
    tree_id: str


class LatePort(AppliedNode):
    """A port that keeps its old text: its node continues, and read it before the first tick."""

    port: str


class Applied(Struct):
    """The running tree was replaced, or would be (`dry`).

    `kept` is the number of nodes that stay as they are. `renewed` stay with a new object of their changed
    code. `halted` are those of the old tree that were RUNNING and cannot continue.
    """

    dry: bool
    kept: int
    renewed: list[AppliedNode]
    added: list[AppliedNode]
    removed: list[AppliedNode]
    halted: list[AppliedNode]
    late_ports: list[LatePort]
