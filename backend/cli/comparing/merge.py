"""`bt-studio merge`: merges two versions of a tree that come from a common one."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from translator.merge import MergedFile


def merge(  # noqa: PLR0913, PLR0917 - these are the options
    base: Annotated[
        Path, typer.Argument(help="The common version, a diagram or XML; an empty file if none.")
    ],
    ours: Annotated[Path, typer.Argument(help="Our version.")],
    theirs: Annotated[Path, typer.Argument(help="Their version.")],
    output: Annotated[Path | None, typer.Option("-o", "--output", help="The file to write.")] = None,
    name: Annotated[str, typer.Option(help="The file's name in messages.")] = "",
    as_git: Annotated[  # noqa: FBT002
        bool, typer.Option("--git", help="Merge by lines what is no tree, as git does.")
    ] = False,
) -> None:
    """Merges three ways, by nodes. With conflicts, exit status 1, and the file lists them."""
    from backend.cli.shared import translation as cli
    from backend.cli.shared.errors import CliError
    from translator import TranslatorError
    from translator.archive import read_file
    from translator.merge import NotMergeableError, merge_files

    shown = name or str(ours)
    try:
        done = merge_files(*(read_file(path) for path in (base, ours, theirs)), file=shown)
    except (NotMergeableError, TranslatorError) as error:
        if as_git:
            from backend.cli.comparing.git_repository import merge_lines

            sys.exit(merge_lines(base, ours, theirs, name=shown))
        if isinstance(error, TranslatorError):
            raise cli.fail(error.diagnostics, as_json=False) from None
        sentence = f"{shown}:1:1: the versions differ in comments, models or other parts that are no tree"
        raise CliError(f"{sentence} (merge them by lines, as git does)") from None
    if output is not None:
        cli.write_file(output, done.data)
    else:
        sys.stdout.buffer.write(done.data)
        sys.stdout.flush()
    if done.conflicts:
        raise CliError(*_lines(done, shown))


def _lines(done: MergedFile, name: str) -> list[str]:
    from translator.check.conflict import sentence
    from translator.difference.words import shown

    return [
        f"{shown(name)}: conflict in {shown(tree)}: {sentence(conflict)}" for tree, conflict in done.conflicts
    ]
