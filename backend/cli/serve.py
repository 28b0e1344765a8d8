"""`bt-studio serve`: starts the IDE."""

from __future__ import annotations

import os
import secrets
import sys
import threading
from pathlib import Path  # noqa: TC003 - read at run time
from typing import TYPE_CHECKING, Annotated

import typer

from backend.cli.shared.errors import CliError

if TYPE_CHECKING:
    from backend.config.environment import Environment


def serve(  # noqa: PLR0913, PLR0917 - one parameter an option
    host: Annotated[
        str | None, typer.Option(help="Address to listen on; loopback only, unless there are accounts.")
    ] = None,
    port: Annotated[
        int | None, typer.Option(help="Port to listen on; 0 takes a free one.", min=0, max=65535)
    ] = None,
    data_dir: Annotated[Path | None, typer.Option(help="Folder of the database and the logs.")] = None,
    launcher: Annotated[str | None, typer.Option(help="What starts executors: process.")] = None,
    workers: Annotated[
        int | None, typer.Option(help="Processes that answer requests; several on a team's server.", min=1)
    ] = None,
    browser: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,  # noqa: FBT002
    ready_file: Annotated[
        Path | None, typer.Option(help="Write {url, port, pid} there as soon as the page can be opened.")
    ] = None,
) -> None:
    """Serves the IDE until Ctrl+C."""
    take_options(HOST=host, PORT=port, DATA_DIR=data_dir, LAUNCHER=launcher, WORKERS=workers)
    serve_page("/", browser=browser, ready_file=ready_file)


def take_options(**options: object) -> None:
    """Writes options, and a token if there is none, into the environment; the settings are read from it."""
    for name, value in options.items():
        if value is not None:
            os.environ[f"BT_STUDIO_{name}"] = str(value)
    if not os.environ.get("BT_STUDIO_TOKEN"):  # compose files pass an unset variable as empty
        os.environ["BT_STUDIO_TOKEN"] = secrets.token_urlsafe(24)


def serve_page(page: str, *, browser: bool, ready_file: Path | None) -> None:
    """Serves the IDE until Ctrl+C.

    Args:
        page: the path of the page that the link names, without a token.
        browser: whether the page is opened in the browser.
        ready_file: gets the link, the port and the process.

    Raises:
        CliError: a setting is invalid, or the server cannot start.
    """
    from backend.config.environment import InvalidEnvironmentError, environment
    from backend.config.server import ServeError
    from backend.config.worker_count import judge_workers, too_little_memory

    try:
        settings = environment()
        may_listen = settings.is_team or settings.published_on_loopback
        if not may_listen and settings.host not in {"127.0.0.1", "localhost", "::1"}:
            raise ServeError(
                f"Without accounts the IDE is served on this machine only, not on {settings.host}: "
                "use --host 127.0.0.1 and an SSH tunnel to reach it from elsewhere, "
                "or a server with accounts (BT_STUDIO_MODE=team, see docs/how-to/run-a-team-server.md)."
            )
        judge_workers(settings)
        if warning := too_little_memory(settings):
            print(warning, file=sys.stderr, flush=True)
        if settings.launcher == "kubernetes":
            _check_cluster(settings)
        _serve(page, open_browser=browser, ready_file=ready_file)
    except InvalidEnvironmentError as error:
        raise CliError(str(error), status=2) from error
    except ServeError as error:
        raise CliError(str(error)) from error


def _check_cluster(settings: Environment) -> None:
    from django.core.exceptions import ImproperlyConfigured

    from backend.config.server import ServeError
    from backend.sessions.launchers.kubernetes.launcher import Files, read_settings

    try:
        read_settings(Files(settings.pod_template, settings.tools_template, settings.rayjob_file))
    except ImproperlyConfigured as error:
        raise ServeError(str(error)) from error


def _serve(page: str = "/", *, open_browser: bool, ready_file: Path | None) -> None:
    from backend.config.environment import environment
    from backend.config.parent import serve_by_several
    from backend.config.server import (
        bind,
        data_folder,
        ended_by_interrupt,
        load,
        migrate,
        run,
        tidy,
        write_ready_file,
    )
    from backend.config.worker_count import workers_of

    os.environ.setdefault("DJANGO_SETTINGS_MODULE", "backend.config.settings")
    settings = environment()
    folder = data_folder(settings.data_dir, is_shared=settings.may_be_several)
    with bind(settings.host, settings.port) as listener, folder:
        with ended_by_interrupt():
            migrate()
        port: int = listener.getsockname()[1]
        host = "127.0.0.1" if settings.published_on_loopback else settings.host
        name = f"[{host}]" if ":" in host else host
        mark = "&" if "?" in page else "?"
        link = f"http://{name}:{port}{page}{mark}token={settings.token.get_secret_value()}"
        url = settings.public_url + "/" if settings.is_team else link

        def on_ready() -> None:
            robots = (
                "; robots that run continue"
                if settings.launcher != "process" and settings.is_team
                else " and every robot that runs"
            )
            print(f"BT Studio is at {url}\nCtrl+C ends it{robots}.", flush=True)
            if settings.users_run_as_server:
                print("The Python of every user runs as this server, which isolates nobody.", flush=True)
            if ready_file:
                write_ready_file(ready_file, url, port)
            if open_browser:
                threading.Thread(target=_open, args=(url,), daemon=True).start()

        def on_ready_alone() -> None:
            if settings.is_team:
                load()  # a proxy sends requests as soon as it is ready
            on_ready()
            threading.Thread(target=tidy if settings.is_team else load_and_tidy, daemon=True).start()

        def load_and_tidy() -> None:
            load()
            tidy()

        if (count := workers_of(settings)) > 1:
            serve_by_several(listener, count, on_ready=on_ready)
        else:
            run(listener, on_ready=on_ready_alone, log_level=settings.log_level)


def _open(url: str) -> None:
    import webbrowser

    webbrowser.open(url)
