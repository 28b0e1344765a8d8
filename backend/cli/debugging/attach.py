"""`bt-studio attach`: follows the tree of another program in the terminal, by Groot2's protocol."""

from __future__ import annotations

import json
import sys
import time
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from pathlib import Path  # noqa: TC003 - typer reads it
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from executor.headless.attached import AttachedFile
    from tree_gardener.groot.client import Groot2Client
    from tree_gardener.groot.remote import NodeState, RemoteNode, RemoteTree

RETRY_S: Final = 0.5
LONGEST_TEXT: Final = 500
UNPRINTABLE: Final = "\N{REPLACEMENT CHARACTER}"
Line = dict[str, Any]


def attach(
    address: Annotated[
        str, typer.Argument(help="[ssh://[USER@]]HOST[:PORT]; the port is 1667 if none is given.")
    ],
    once: Annotated[bool, typer.Option("--once", help="Show the tree as it is, and end.")] = False,  # noqa: FBT002
    hz: Annotated[float, typer.Option(min=0.1, max=100.0, help="How often to ask.")] = 20.0,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object a line.")] = False,  # noqa: FBT002
    record: Annotated[Path | None, typer.Option(help="MCAP file (.mcap) for all that is seen.")] = None,
) -> None:
    """Follows a tree of BehaviorTree.CPP 4 with a Groot2 publisher, or of tree_gardener, until Ctrl+C.

    It only looks: the program is neither stopped nor changed. With ssh:// your own ssh forwards the ports.
    """
    from backend.cli.debugging.tunnel import reached
    from backend.cli.shared.errors import CliError
    from executor.headless.errors import HeadlessError
    from translator import TranslatorError
    from tree_gardener.groot import GrootError
    from tree_gardener.groot.client import Groot2Client

    try:
        with (
            reached(address) as robot,
            _recording(record, address) as file,
            Groot2Client(robot.host, robot.port) as client,
        ):
            began_s = time.monotonic()
            for line in Following(client, file, robot.check).lines(once=once, period_s=1.0 / hz):
                t_s = round(time.monotonic() - began_s, 3)
                text = json.dumps({"t_s": t_s, **line}, ensure_ascii=False) if as_json else in_words(line)
                print(text if as_json or line["event"] == "tree" else f"{t_s:8.2f} s  {text}", flush=True)
    except (GrootError, HeadlessError) as error:
        raise CliError(str(error)) from error
    except TranslatorError as error:
        raise CliError(f"the tree cannot be recorded: {error.diagnostics[0].message}") from error
    except KeyboardInterrupt:
        sys.stderr.write("detached\n")


@contextmanager
def _recording(path: Path | None, address: str) -> Iterator[AttachedFile | None]:
    from executor.headless.attached import AttachedFile

    if path is None:
        yield None
        return
    with closing(AttachedFile(path, address)) as file:
        yield file


@dataclass
class Following:
    """The other program as it was last seen.

    Attributes:
        client: asks the program.
        file: takes all for a recording; None without one.
        check: called when the program is silent; what it raises ends the following.
        tree: its tree; None before the first answer.
        states: the states of its nodes by uid.
        boards: its blackboards by name.
        is_silent: whether it did not answer the last time.
    """

    client: Groot2Client
    file: AttachedFile | None = None
    check: Callable[[], None] = lambda: None
    tree: RemoteTree | None = None
    states: dict[int, NodeState] = field(default_factory=dict)
    boards: dict[str, dict[str, Any]] = field(default_factory=dict)
    is_silent: bool = False

    def lines(self, *, once: bool, period_s: float) -> Iterator[Line]:
        """Yields the tree and each change, until the program refuses; with `once` it asks a single time.

        Raises:
            GrootError: the program answers in a way that cannot be used; with `once` also if it is silent.
        """
        from tree_gardener.groot.client import SilenceError

        while True:
            began_s = time.monotonic()
            try:
                yield from self.look()
                self.is_silent = False
            except SilenceError as error:
                self.check()
                if once:
                    raise
                if not self.is_silent:
                    yield {"event": "silence", "text": f"{error}; asking again until it answers"}
                self.is_silent = True
                time.sleep(RETRY_S)
            if once:
                return
            time.sleep(max(period_s - (time.monotonic() - began_s), 0.0))

    def look(self) -> Iterator[Line]:
        """Asks once, and yields the tree if it is another one, and the changes."""
        states, _ = self.client.statuses()
        tree, is_cut = self.tree, self.client.take_cut()
        # Each process of BehaviorTree.CPP 4.8 has the same id, so after a cut the tree itself is compared.
        found = self.client.tree() if tree is None or is_cut or self.client.publisher != tree.id else tree
        if tree is not None and (tree.id, tree.document) == (found.id, found.document):
            if is_cut and self.file is not None:
                self.file.resume(self.client)
        else:
            tree = self.tree = found
            self.states, self.boards = states, {}
            if self.file is not None:
                self.file.tree(tree, self.client)
            yield {"event": "tree", "nodes": [_row(node, states) for node in tree.nodes]}
        for node in tree.nodes:
            state = states.get(node.uid)
            if state is not None and state != self.states.get(node.uid):
                yield {"event": "status", "uid": node.uid, "path": node.path, "status": shown(state)}
        self.states = states
        boards = self.client.blackboards(tree.scopes)
        if self.file is not None:
            self.file.look(self.client, boards)
        for scope in boards.keys() | self.boards.keys():
            yield from _changed_entries(scope, self.boards.get(scope, {}), boards.get(scope, {}))
        self.boards = boards


def shown(state: NodeState) -> str:
    """Returns a state in words: the status, and what the node was before it became IDLE."""
    was = state.was.name
    return state.status.name if was == "IDLE" else f"{state.status.name} (was {was})"


def in_words(line: Line) -> str:
    """Returns a line for people, without signs that control a terminal."""
    if line["event"] == "tree":
        return "\n".join(_in_words_of_node(row) for row in line["nodes"])
    if line["event"] == "status":
        return f"#{line['uid']} {_safe(line['path'])} {line['status']}"
    if line["event"] == "blackboard":
        place = _safe(f"{line['scope']}.{line['key']}")
        return f"{place} = {_safe(json.dumps(line['value']))}" if "value" in line else f"{place} was removed"
    return str(line["text"])


def _in_words_of_node(row: Line) -> str:
    kind = "" if row["name"] == row["type"] else f" [{_safe(row['type'])}]"
    return f"{'  ' * row['depth']}#{row['uid']} {_safe(row['name'])}{kind} {row['status']}"


def _row(node: RemoteNode, states: dict[int, NodeState]) -> Line:
    status = shown(states[node.uid]) if node.uid in states else "unknown"
    return {
        "uid": node.uid,
        "depth": node.depth,
        "path": node.path,
        "type": node.type,
        "name": node.name,
        "status": status,
    }


def _changed_entries(scope: str, before: dict[str, Any], now: dict[str, Any]) -> Iterator[Line]:
    for key, value in now.items():
        if key not in before or before[key] != value:
            yield {"event": "blackboard", "scope": scope, "key": key, "value": _plain(value)}
    for key in before.keys() - now.keys():
        yield {"event": "blackboard", "scope": scope, "key": key}


def _plain(value: Any) -> Any:
    """Returns a value in a form that JSON has."""
    try:
        json.dumps(value)
    except (TypeError, ValueError, RecursionError):
        return str(value)[:LONGEST_TEXT]
    return value


def _safe(text: str) -> str:
    return "".join(sign if sign.isprintable() else UNPRINTABLE for sign in text[:LONGEST_TEXT])
