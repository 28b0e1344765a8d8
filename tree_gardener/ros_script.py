"""Runs a Python file as its own program; fields of ROS messages are checked, and errors have a place.

`python -m tree_gardener.ros_script FILE ARGUMENTS…` runs the nodes of launch files. The file is the module
`__main__`, as without this one. An exception that ends the program is written as Python does, and then in a
line `FILE:LINE: what is wrong`.
"""

import pathlib
import sys
import threading
import types

from tree_gardener.errors import describe, raised_at, traceback_of
from tree_gardener.ros_fields import check_fields, users_frames

__all__ = ["main"]


def main() -> None:
    """Runs the file that the first argument names."""
    del sys.argv[0]
    file = pathlib.Path(sys.argv[0]).absolute()
    if not getattr(sys.flags, "safe_path", False):
        del sys.path[0]  # the folder in which Python was started
    sys.path.insert(0, str(file.resolve().parent))
    check_fields()
    sys.excepthook = _report
    threading.excepthook = _report_of_thread
    module = types.ModuleType("__main__")
    module.__file__ = sys.argv[0]
    sys.modules["__main__"] = module
    exec(compile(file.read_bytes(), str(file), "exec"), module.__dict__)  # noqa: S102 - its purpose


def _report(kind: type[BaseException], error: BaseException, trace: types.TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)
        return
    own = trace
    while trace is not None:
        is_ours = trace.tb_frame.f_code.co_filename == __file__
        trace = trace.tb_next
        own = trace if is_ours else own
    error = error.with_traceback(own)
    sys.stderr.write(f"{traceback_of(error)}{_place(error)}{describe(error)}\n")


def _report_of_thread(arguments: threading.ExceptHookArgs) -> None:
    if arguments.exc_value is not None and not issubclass(arguments.exc_type, SystemExit):
        _report(arguments.exc_type, arguments.exc_value, arguments.exc_traceback)


def _place(error: BaseException) -> str:
    """Returns `FILE:LINE: ` of the innermost own line; a file in the current folder is relative to it."""
    here = f"{pathlib.Path.cwd()}/"
    folders = (here, f"{sys.path[0]}/")
    if isinstance(error, SyntaxError) and error.filename:
        file, line = error.filename, error.lineno or 1
    else:
        own = [place for place in users_frames(error.__traceback__) if place[0].startswith(folders)]
        file, line = own[-1] if own else raised_at(error)
    return f"{file.removeprefix(here) if here != '//' else file}:{line}: " if file else ""


if __name__ == "__main__":
    main()
