"""`bt-studio`: each command is a function in its own module, imported only when it is used."""

from __future__ import annotations

import importlib
import tempfile
import traceback
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import typer
from typer.core import TyperCommand, TyperGroup
from typer.main import get_command as command_of

from backend.cli.shared.engine import require_engine
from backend.cli.shared.errors import WORK_FAILED, CliError, exit_with
from backend.cli.shared.one_ros import require_one_ros
from backend.cli.shared.removed import refuse_removed

if TYPE_CHECKING:
    from typer._click import Command, Context


class Verb(NamedTuple):
    """The module of a command, and its description in one line."""

    module: str
    function: str


VERBS: Final[dict[str, Verb]] = {
    "serve": Verb("serve", "serve"),
    "open": Verb("open_log", "open_log"),
    "run": Verb("run", "run"),
    "dap": Verb("debugging.dap", "dap"),
    "attach": Verb("debugging.attach", "attach"),
    "check": Verb("check", "check"),
    "test": Verb("behaviour_tests", "run_tests"),
    "evaluate": Verb("evaluating.evaluate", "evaluate"),
    "tune": Verb("evaluating.tune", "tune"),
    "diff": Verb("comparing.diff", "diff"),
    "merge": Verb("comparing.merge", "merge"),
    "git": Verb("comparing.git", "git"),
    "translate": Verb("translate", "translate"),
    "import": Verb("import_", "import_"),
    "import-robot": Verb("import_robot", "import_robot"),
    "import-universe": Verb("import_universe", "import_universe"),
    "package": Verb("package", "package"),
    "conformance": Verb("conformance", "conformance"),
    "manager": Verb("manager", "manager"),
    "new": Verb("new", "new"),
    "export": Verb("export", "export"),
    "projects": Verb("projects", "projects"),
    "admin": Verb("admin", "admin"),
    "convert": Verb("convert", "convert"),
    "backup": Verb("backup", "backup"),
    "restore": Verb("backup", "restore"),
}
# These load rclpy, in this process or in one that they start.
ON_ROS: Final = frozenset({"serve", "open", "run", "dap", "evaluate", "tune", "manager"})


class VerbCommand(TyperCommand):
    """A command that knows which of its options were removed."""

    def parse_args(self, ctx: Context, args: list[str]) -> list[str]:
        """Reads the arguments, unless one is an option that was removed."""
        options = args[: args.index("--")] if "--" in args else args
        for word in options:
            refuse_removed(str(self.name), word.partition("=")[0])
        return super().parse_args(ctx, args)

    def invoke(self, ctx: Context) -> Any:
        """Runs the command, unless the engine is another one, or it needs ROS and finds two."""
        require_engine()
        if self.name in ON_ROS:
            require_one_ros()
        return super().invoke(ctx)


class VerbGroup(TyperGroup):
    """Finds a command's module by the command's name: `check` does not load ROS, `run` not Django."""

    def list_commands(self, ctx: Context) -> list[str]:
        """Returns the commands, in the order of the table."""
        return list(VERBS)

    def get_command(self, ctx: Context, cmd_name: str) -> Command | None:
        """Returns a command, made from its function's signature."""
        refuse_removed(cmd_name)
        if cmd_name not in VERBS:
            return None
        verb = VERBS[cmd_name]
        module = importlib.import_module(f"backend.cli.{verb.module}")
        found = getattr(module, verb.function)
        if isinstance(found, typer.Typer):  # a command with subcommands
            return command_of(found)
        app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
        app.command(name=cmd_name, cls=VerbCommand)(found)
        return command_of(app)


app = typer.Typer(
    cls=VerbGroup,
    name="bt-studio",
    help="A web IDE for programming robots with behaviour trees.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)


@app.callback()
def _root() -> None:
    """A web IDE for programming robots with behaviour trees."""


def main() -> None:
    """Runs one command. Exit status: 0 success, 1 failure, 2 bad arguments."""
    try:
        app()
    except CliError as error:
        exit_with(error)
    except Exception as error:  # noqa: BLE001, RUF100 - the last resort: no traceback in a user's face
        report = _write_report()
        sentence = f"bt-studio: this is a defect of BT Studio: {type(error).__name__}: {error}"
        exit_with(CliError(sentence, f"The details are in {report}; please report them.", status=WORK_FAILED))


def _write_report() -> Path:
    with tempfile.NamedTemporaryFile("w", prefix="bt-studio-", suffix=".log", delete=False) as file:
        traceback.print_exc(file=file)
    return Path(file.name)


if __name__ == "__main__":
    main()
