"""Writes `scripts.json`: results of the engine's parser, which the editor's parser must match.

python -m tests.shared.make_scripts
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Final

from tree_gardener.script import ScriptError, names_read, names_written, parse

HERE: Final = Path(__file__).parent
FILE: Final = HERE / "scripts.json"
TABLE: Final = HERE.parent / "conformance" / "script_table.json"
BROKEN: Final = (
    "",
    "   ",
    "a +",
    "a + * b",
    "(a",
    "a)",
    "a ? b",
    "a ? b : ",
    "a := ",
    ":= 1",
    "1.",
    ".5",
    "1.5.2",
    "0x1..2",
    "0x1.5",
    "x := 1..",
    "x := 1e400",
    "x := 1.5e-400 + 1",
    "0x",
    "12ab",
    "'open",
    '"double"',
    "a % b",
    "{key}",
    "a, b",
    "a == ",
    "!",
    "- - ",
    "a # b",
    "é := 1",
    "x := 'a' + ;",
    "(" * 251 + "1" + ")" * 251,
    "-" * 251 + "1",
    "a b := )",
    "a $",
)
SOUND: Final = (
    "x := 1; y := x + 2",
    "x = 3",
    "battery < 20 && !docked",
    "status == SUCCESS ? 1 : 0",
    "@shared += 1",
    "name := 'a' .. 'b'",
    "a := b := 3",
    "1 < x <= 5",
    "x := 0x1F; ; y := 1e3",
    "a b c",
    "~mask & 0xFF | flag ^ 1",
    "true || false",
    "-(-x)",
    "(" * 250 + "x" + ")" * 250,
    "1+(" * 200 + "x" + ")" * 200,
    "-" * 250 + "x",
    "+".join(["x"] * 600),
)


def described(text: str) -> dict[str, Any]:
    """The verdict on one script; spans count code points."""
    try:
        program = parse(text)
    except ScriptError as error:
        return {
            "script": text,
            "error": {"span": list(error.span), "message": error.message, "hint": error.hint},
        }
    return {
        "script": text,
        "read": [[each.name, *each.span] for each in names_read(program)],
        "written": [[each.name, *each.span] for each in names_written(program)],
    }


def document() -> list[dict[str, Any]]:
    """All cases: those above, and every script of the table that BehaviorTree.CPP evaluated."""
    table = [each["expr"] for each in json.loads(TABLE.read_text(encoding="utf-8"))]
    return [described(text) for text in dict.fromkeys((*SOUND, *BROKEN, *table))]


def main() -> None:
    """Writes the file."""
    lines = ",\n".join(json.dumps(each, ensure_ascii=False) for each in document())
    FILE.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
