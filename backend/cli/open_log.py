"""`bt-studio open`: shows a robot's log in the browser."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from backend.runs.models import Run


def open_log(  # noqa: PLR0913, PLR0917 - one parameter an option
    source: Annotated[
        Path,
        typer.Argument(
            help="A robot's log: .btlog or SQLite of BehaviorTree.CPP, MCAP, a bag of ROS 2 or its folder."
        ),
    ],
    host: Annotated[str | None, typer.Option(help="Address to listen on; loopback only.")] = None,
    port: Annotated[
        int | None, typer.Option(help="Port to listen on; 0 takes a free one.", min=0, max=65535)
    ] = None,
    data_dir: Annotated[Path | None, typer.Option(help="Folder of the database and the logs.")] = None,
    browser: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,  # noqa: FBT002
    ready_file: Annotated[
        Path | None, typer.Option(help="Write {url, port, pid} there as soon as the page can be opened.")
    ] = None,
) -> None:
    """Makes a project of the tree in a robot's log, and shows the log on its time axis until Ctrl+C."""
    from backend.cli.serve import serve_page, take_options
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from backend.cli.shared.stored import stored_projects
    from executor.recorder.reader import RecordingError

    take_options(HOST=host, PORT=port, DATA_DIR=data_dir)
    if not source.exists():
        raise CliError(f"{source}: No such file or directory", status=BAD_ARGUMENTS)
    with stored_projects():
        from backend.config.environment import environment
        from backend.runs.length import DamagedError

        if environment().is_team:
            raise CliError("This server has accounts: open the log in its page.", status=BAD_ARGUMENTS)
        try:
            run = _stored(source)
        except RecordingError as error:
            raise CliError(str(error)) from error
        except DamagedError as error:
            raise CliError(f"{source}: no recording was made of it: {error}") from error
        print(f"{source}: the run “{run.name}” of the new project “{run.project.name}”", flush=True)
        page = f"/projects/{run.project_id}?run={run.id}"
        if (holder := _holder(environment().data_dir)) is not None:
            print(f"The server that runs already (process {holder}) has it at {page}")
            return
    serve_page(page, browser=browser, ready_file=ready_file)


def _stored(source: Path) -> Run:
    from backend.accounts.writes import local_user
    from backend.runs.facts import facts_of
    from backend.runs.logs import Recording, open_log
    from executor.recorder.outside.apart import convert_apart

    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "run.mcap"
        convert_apart(source, made)
        file = made.open("rb")
    facts = facts_of(file, "cli")
    files = _project(facts.xml, source.stem)
    return open_log(Recording(source.name, file, facts), files, acting_user=local_user())


def _project(xml: bytes, name: str) -> dict[str, bytes]:
    """Returns the project of a tree; nothing if none can be made of it."""
    from translator import TranslatorError, open_files

    try:
        return dict(open_files({"tree.xml": xml}, name=name).files) if xml else {}
    except TranslatorError:
        return {}


def _holder(data_dir: Path) -> str | None:
    """Returns the process of the server that uses a data folder; None if there is none."""
    from backend.config.server import ServeError, data_folder

    try:
        with data_folder(data_dir):
            return None
    except ServeError:
        return (data_dir / "serve.lock").read_text(encoding="utf-8").strip() or "?"
