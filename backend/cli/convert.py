"""`bt-studio convert`: makes an MCAP recording of a robot's log, or of an older or a cut recording."""

from __future__ import annotations

from pathlib import Path  # noqa: TC003 - typer reads the annotations
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from executor.recorder.outside.convert import Converted


def convert(
    source: Annotated[
        Path,
        typer.Argument(
            help="A robot's log: .btlog or SQLite of BehaviorTree.CPP, a bag of ROS 2; or a recording: "
            ".jsonl, .jsonl.gz, a cut .mcap, or the folder that a killed run left."
        ),
    ],
    output: Annotated[Path, typer.Option("-o", "--output", help="The .mcap to make.")],
) -> None:
    """Converts a robot's log, or a recording of older versions, to MCAP; completes a cut one."""
    from backend.cli.shared.errors import BAD_ARGUMENTS, CliError
    from executor.headless.errors import HeadlessError
    from executor.headless.recording import check_name
    from executor.recorder.reader import RecordingError

    try:
        check_name(output)
    except HeadlessError as error:
        raise CliError(str(error), status=BAD_ARGUMENTS) from error
    if output.exists():
        raise CliError(f"{output}:1:1: it exists already (choose another name)", status=BAD_ARGUMENTS)
    partial = output.with_name(f"{output.name}.partial")
    try:
        if not source.exists():
            raise CliError(f"{source}: No such file or directory", status=BAD_ARGUMENTS)
        made = _convert(source, partial)
        if not made.messages:
            raise CliError(f"{source}:1:1: there is no recording in it", status=BAD_ARGUMENTS)
        partial.rename(output)
    except RecordingError as error:
        raise CliError(str(error)) from error
    except OSError as error:
        raise CliError(f"{error.filename or output}: {error.strerror}", status=BAD_ARGUMENTS) from error
    finally:
        partial.unlink(missing_ok=True)
    left_out = f"; the last {made.lost_bytes} bytes were not whole" if made.lost_bytes else ""
    late = f"; {made.late} were not in the order of time, and are sorted" if made.late else ""
    print(f"{output}: {made.messages} messages{late}{left_out}")


def _convert(source: Path, target: Path) -> Converted:
    from executor.recorder.joining import join_newest
    from executor.recorder.outside.apart import convert_apart
    from executor.recorder.outside.bags import is_bag
    from executor.recorder.outside.convert import Converted
    from executor.recorder.outside.lines import convert_lines

    if source.is_dir() and not is_bag(source):
        target.touch()
        return Converted(join_newest(source, target))
    if source.name.endswith((".jsonl", ".jsonl.gz")):
        with target.open("wb") as out:
            return Converted(convert_lines(source, out))
    return convert_apart(source, target)
