"""`bt-studio diff`: shows the differences between two versions, by nodes instead of lines."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import Annotated

import typer


def diff(  # noqa: PLR0913, PLR0917 - these are the options
    older: Annotated[
        str, typer.Argument(help="A project folder, zip or name, NAME@REVISION, a diagram or an XML file.")
    ],
    newer: Annotated[str, typer.Argument(help="The later version.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print the operations as JSON.")] = False,  # noqa: FBT002
    html: Annotated[Path | None, typer.Option(help="Write a self-contained page.")] = None,
    picture: Annotated[Path | None, typer.Option(help="Write both versions as one SVG.")] = None,
    layout: Annotated[  # noqa: FBT002
        bool, typer.Option("--layout", help="Count positions, folding and layout as changes, too.")
    ] = False,
) -> None:
    """Prints the differences between two projects or trees; nothing if they are equal."""
    from backend.cli.comparing.versions import open_version
    from backend.cli.shared import translation as cli
    from translator import TranslatorError
    from translator.difference.page import page
    from translator.difference.picture import picture as drawn
    from translator.difference.projects import compare_versions
    from translator.difference.words import lines

    try:
        found = compare_versions(open_version(older), open_version(newer), layout=layout)
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=as_json) from None
    if html is not None:
        cli.write_file(html, page(found).encode())
    if picture is not None:
        cli.write_file(picture, drawn(found.trees).encode())
    if as_json:
        cli.print_json(found.to_json())
    elif html is None and picture is None:
        for line in lines(found):
            print(line)
