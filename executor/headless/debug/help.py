"""The commands of the prompt, each with its form and its effect."""

from __future__ import annotations

from typing import Final

HELP: Final[dict[str, tuple[str, str]]] = {
    "break": (
        "[NODE [before|after|success|failure|running|skipped|halted] [if 'CONDITION'] [hits N] [log 'TEXT']]",
        "sets a breakpoint; without a node, lists all",
    ),
    "delete": ("N|all", "removes a breakpoint by its number, or all"),
    "off": ("", "switches all breakpoints off"),
    "on": ("", "switches all breakpoints on"),
    "continue": ("", "continues to the next breakpoint; Ctrl+C holds at the next node"),
    "into": ("", "continues to the next event at any node"),
    "over": ("", "continues until this node is done"),
    "out": ("", "continues until the parent of this node is done"),
    "tick": ("", "continues to the start of the next tick"),
    "to": ("NODE", "continues to the next tick of a node"),
    "where": ("", "prints the path that led here, and why the tree is held"),
    "ahead": ("", "prints the nodes that may still be ticked in this tick; possible ones, not certain ones"),
    "tree": ("", "prints all nodes with their statuses; an arrow marks where the tree is held"),
    "print": ("[KEY]", "prints a blackboard entry in the scope of this node; without a key, all entries"),
    "set": ("SCRIPT", "runs a script in the scope of this node, as in `set speed := 0.5`"),
    "force": (
        "NODE success|failure|skipped [once] [after]",
        "forces a result in place of the tick, or after it; once, or until it is released",
    ),
    "freeze": ("NODE", "keeps a node RUNNING without a tick, until it is released"),
    "skip": ("NODE", "skips the siblings before a node, once; below sequences and fallbacks"),
    "alone": ("NODE", "ticks a node in place of the root from the next tick on; all else is halted"),
    "release": ("NODE|all", "ends what is forced on a node, or on all"),
    "forces": ("", "lists what is forced"),
    "quit": ("", "ends the run"),
    "help": ("[COMMAND]", "lists the commands"),
}
