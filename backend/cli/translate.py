"""`bt-studio translate`: translates diagrams to BehaviorTree.CPP XML, plain or with the actions inside."""

from __future__ import annotations

import sys
from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import Annotated

import typer


def translate(  # noqa: PLR0913, PLR0917 - these are the options of formats.md
    project: Annotated[str, typer.Argument(help="A project folder, zip or name, a diagram or an XML file.")],
    actions: Annotated[Path | None, typer.Option(help="Folder of the actions of a single tree.")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="The XML file to write.")] = None,
    self_contained: Annotated[  # noqa: FBT002
        bool, typer.Option("--self-contained", help="Put the source of the actions into the document.")
    ] = False,
    form_2024: Annotated[  # noqa: FBT002
        bool, typer.Option("--form-2024", help="Write the self-contained form of JdeRobot's BT Studio.")
    ] = False,
    models: Annotated[  # noqa: FBT002
        bool, typer.Option("--models", help="Write the models of the project's nodes alone, as a palette.")
    ] = False,
    xsd: Annotated[  # noqa: FBT002
        bool, typer.Option("--xsd", help="Write an XML Schema of documents with the project's nodes.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the result as JSON.")] = False,  # noqa: FBT002
) -> None:
    """Translates a project or a tree to BehaviorTree.CPP v4 XML."""
    from backend.cli.shared import translation as cli
    from translator import TranslatorError, check, export_files, to_models_xml, to_xsd
    from translator import self_contained as write_self_contained
    from translator.jderobot.self_contained import write_old_form

    try:
        opened = cli.open_project(project, actions=actions, stubs=actions is None)
        if models:
            files = {"models.xml": to_models_xml(opened).encode()}
        elif xsd:
            files = {"schema.xsd": to_xsd(opened).encode()}
        elif form_2024:
            files = {"tree.xml": write_old_form(opened).encode()}
        elif self_contained:
            files = {"tree.xml": write_self_contained(opened).encode()}
        else:
            files = export_files(opened)
    except TranslatorError as error:
        raise cli.fail(error.diagnostics, as_json=as_json) from None
    first, *others = files
    found = [item for item in check(opened) if item.severity.value != "note"]
    changes = [item for item in opened.diagnostics if item.code == "BT0720"]
    if as_json:
        text = {path: raw.decode("utf-8", "replace") for path, raw in files.items()}
        cli.print_json({"files": text, "diagnostics": [item.to_json() for item in [*found, *changes]]})
    else:
        cli.tell([*found, *changes])
    if output is not None:
        cli.write_file(output, files[first])
        for path in others:
            beside = output.parent / path
            if not beside.exists():
                cli.write_file(beside, files[path])
    elif not as_json:
        sys.stdout.buffer.write(files[first])
        sys.stdout.flush()
