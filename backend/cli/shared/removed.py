"""Commands and options that were removed, each with what to use instead."""

from __future__ import annotations

from typing import Final

from backend.cli.shared.errors import BAD_ARGUMENTS, CliError

REMOVED: Final[dict[tuple[str, ...], str]] = {
    ("hosts",): (
        "robots on several machines run on Kubernetes, see “Three machines with k3s” in "
        "docs/how-to/run-on-kubernetes.md"
    ),
    ("debug",): "debug in the page (`bt-studio serve`), or in an editor with `bt-studio dap`",
    ("run", "--serve-viewer"): (
        "to look at a run, start it in the page (`bt-studio serve`), or record it with --record and show the "
        "recording with `bt-studio open`"
    ),
    ("run", "--headless"): "leave it out, since each run in the terminal is headless",
}


def refuse_removed(*words: str) -> None:
    """Refuses a command, or an option of a command, that was removed.

    Raises:
        CliError: it was removed; the sentence says what to use instead.
    """
    instead = REMOVED.get(words)
    if instead is not None:
        text = f"bt-studio {' '.join(words)} was removed: {instead}"
        raise CliError(text, status=BAD_ARGUMENTS)
