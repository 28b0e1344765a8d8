"""`bt-studio convert`: makes an MCAP recording of an older or a cut one."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import Annotated

import typer


def convert(
    source: Annotated[
        Path,
        typer.Argument(
            help="A recording: .jsonl, .jsonl.gz, a cut .mcap, or the folder that a killed run left."
        ),
    ],
    output: Annotated[Path, typer.Option("-o", "--output", help="The .mcap to make.")],
) -> None:
    """Converts a recording of older versions to MCAP, or completes one that was cut off."""
    from backend.cli.errors import BAD_ARGUMENTS, CliError
    from executor.headless.errors import HeadlessError
    from executor.headless.recording import check_name
    from executor.recorder.joining import join_newest
    from executor.recorder.lines import convert_lines
    from executor.recorder.reader import RecordingError
    from executor.recorder.recover import recover

    try:
        check_name(output)
    except HeadlessError as error:
        raise CliError(str(error), status=BAD_ARGUMENTS) from error
    if output.exists():
        raise CliError(f"{output}:1:1: it exists already (choose another name)", status=BAD_ARGUMENTS)
    partial = output.with_name(f"{output.name}.partial")
    try:
        with partial.open("wb") as out:
            if source.is_dir():
                messages, lost = join_newest(source, partial), 0
            elif source.suffix == ".mcap":
                with source.open("rb") as file:
                    found = recover(file, source.name, out)
                messages, lost = found.messages, found.lost_bytes
            else:
                messages, lost = convert_lines(source, out), 0
        if not messages:
            raise CliError(f"{source}:1:1: there is no recording in it", status=BAD_ARGUMENTS)
        partial.rename(output)
    except RecordingError as error:
        raise CliError(str(error)) from error
    except OSError as error:
        raise CliError(f"{error.filename or output}: {error.strerror}", status=BAD_ARGUMENTS) from error
    finally:
        partial.unlink(missing_ok=True)
    left_out = f"; the last {lost} bytes were not whole" if lost else ""
    print(f"{output}: {messages} messages{left_out}")
