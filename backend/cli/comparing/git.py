"""`bt-studio git`: sets BT Studio up as git's diff and merge driver for trees, in one repository."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from translator.difference.projects import Version

git = typer.Typer(
    name="git",
    help="Compare and merge trees by nodes in a git repository.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)

Folder = Annotated[Path, typer.Argument(help="A folder in the repository.")]
Yes = Annotated[bool, typer.Option("--yes", help="Do not ask.")]


@git.command()
def install(folder: Folder = Path(), yes: Yes = False) -> None:  # noqa: FBT002
    """Shows the changes to the repository's own config and .gitattributes, asks, and writes them."""
    from backend.cli.comparing.git_repository import Repository, settings

    repository = Repository(folder)
    print(f"To the config of {repository.top}:\n")
    for key, value in settings().items():
        print(f"  {key} = {value}")
    print(f"\nTo {repository.attributes}:\n")
    for line in repository.block().splitlines():
        print(f"  {line}")
    if not yes:
        typer.confirm("\nWrite this?", abort=True)
    repository.install()
    print("\nDone. bt-studio git uninstall takes it back.")


@git.command()
def uninstall(folder: Folder = Path(), yes: Yes = False) -> None:  # noqa: FBT002
    """Removes the settings that `install` wrote."""
    from backend.cli.comparing.git_repository import DRIVER, Repository

    repository = Repository(folder)
    print(f"From the config of {repository.top}: diff.{DRIVER}.*, merge.{DRIVER}.*")
    print(f"From {repository.attributes}: the lines of bt-studio")
    if not yes:
        typer.confirm("\nTake them away?", abort=True)
    repository.uninstall()
    print("Done.")


@git.command(hidden=True)
def changes(paths: Annotated[list[str], typer.Argument()]) -> None:
    """Prints one file's difference for git, which gives path, old file, hash, mode, new file, hash, mode."""
    from backend.cli.comparing.git_repository import show_lines
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from translator import TranslatorError
    from translator.difference.projects import compare_versions
    from translator.difference.words import lines, shown

    if len(paths) < 7:
        raise CliError("git runs this command with seven arguments", status=BAD_ARGUMENTS)
    name, older, newer = paths[0], Path(paths[1]), Path(paths[4])
    try:
        found = compare_versions(_version(older, name), _version(newer, name))
    except (TranslatorError, OSError):
        show_lines(older, newer)
        return
    print(f"bt-studio diff {shown(name)}")
    for line in lines(found):
        print(line)
    if not found.trees:
        print("  the trees are equal; layout or other parts of the file differ (git diff --no-ext-diff)")
    sys.stdout.flush()


def _version(path: Path, name: str) -> Version:
    """Returns one side; a file that git says is not there has no trees."""
    from translator.diagram import to_diagram
    from translator.difference.projects import Version, own_ids
    from translator.merge.files import read_diagram
    from translator.xml.read import read_document

    raw = path.read_bytes()
    if not raw.strip():
        return Version(name, {})
    if raw.lstrip()[:1] == b"<":
        document = read_document(raw, file=name)
        trees = {each.tree.id: to_diagram(each.tree) for each in document.trees}
        return Version(name, trees, ids=own_ids(raw))
    diagram = read_diagram(raw, name)
    return Version(name, {diagram["id"]: diagram})
