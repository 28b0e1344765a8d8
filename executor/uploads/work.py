"""Makes the files of a robot or a universe from an unpacked upload, with the report."""

from __future__ import annotations

import base64
import logging
import os
import posixpath
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from executor.headless.trial_drive import fit
from executor.imports.maps import import_map
from executor.imports.worlds import import_sdf
from executor.robots.importing.bring import make_robot, places_of
from executor.robots.importing.wheels import NoDriveError
from executor.sdf.files import DiskFiles
from executor.universes.document import DocumentError
from executor.uploads.look import items, name_of
from tree_gardener.packages import Packages, Place, installed_places

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.headless.trial_drive import Trial

_PLACE: Final = re.compile(r"(?P<file>[^\s:][^:]*):(?P<line>\d+)(?::\d+)?: (?P<text>.*)", re.DOTALL)


class Wish(NamedTuple):
    """The part that is asked for; `main` and `name` may be "" where they are clear."""

    kind: str
    main: str
    name: str
    arguments: dict[str, str]
    simplify: bool


class ChoiceError(Exception):
    """The file to import is not clear; `items` are those that may be meant."""

    def __init__(self, found: list[dict[str, Any]]) -> None:
        super().__init__("It is not clear what to import.")
        self.items = found


class RefusedError(Exception):
    """It cannot be imported; `diagnostics` are the reasons, with file and line."""

    def __init__(self, diagnostics: list[dict[str, Any]]) -> None:
        super().__init__("It cannot be imported.")
        self.diagnostics = diagnostics


def make(root: Path, scratch: Path, wish: Wish) -> dict[str, Any]:
    """Returns the answer about one robot or universe: its files, and the report.

    A file that is as it was uploaded is named by its path in the upload instead of its bytes.

    Raises:
        ChoiceError: it is not clear which file is meant.
        RefusedError: it cannot be imported.
    """
    logging.getLogger("executor.robots").setLevel(logging.ERROR)  # its notes are in the report
    main = _main(root, wish)
    name = wish.name or name_of(main, root)
    try:
        if wish.kind == "robot":
            made = _robot(root, scratch, main, name, wish)
        else:
            made = _universe(root, main, name, wish)
    except (DocumentError, NoDriveError) as error:
        raise RefusedError(_diagnostics(error, main.relative_to(root))) from error
    files = _files(root, made.pop("files"))
    return {"name": name, **made, "files": files}


def _diagnostics(error: DocumentError | NoDriveError, main: Path) -> list[dict[str, Any]]:
    if isinstance(error, NoDriveError):
        text = f"the robot cannot be imported: {error}"
        return [{"file": main.as_posix(), "line": 1, "message": text, "hint": ""}]
    file = error.file or main.name
    if not file.startswith("/"):
        file = _beside(main, file)
    return [
        {"file": file, "line": found.line, "message": found.message, "hint": found.hint}
        for found in error.problems
    ]


def _beside(main: Path, file: str) -> str:
    """Returns the path in the upload of a file that is named beside the main one."""
    return posixpath.normpath((main.parent / file).as_posix())


def _main(root: Path, wish: Wish) -> Path:
    found = [item for item in items(root) if item["kind"] == wish.kind]
    if wish.main:
        path = root / wish.main
        is_below = ".." not in path.parts and path.resolve().is_relative_to(root.resolve())
        if is_below and path.is_file():
            return path
        raise ChoiceError(found)
    mains = [item for item in found if item["is_main"]]
    if len(mains) != 1:
        raise ChoiceError(found)
    return Path(root, mains[0]["path"])


def _robot(root: Path, scratch: Path, main: Path, name: str, wish: Wish) -> dict[str, Any]:
    made = make_robot(main, name, places_of(main, root, None), wish.arguments)
    trial = fit(made, name, main.name, scratch)
    report, shown = made.report, main.relative_to(root)
    return {
        "path": f"robots/{name}/robot.yaml",
        "files": {f"robots/{name}/{path}": data for path, data in made.written(main.name).items()},
        "report": {
            "taken": [_line(text, shown) for text in report.taken],
            "assumed": [_line(text, shown) for text in report.assumed],
            "left_out": [_line(text, shown) for text in report.left_out],
        },
        "test_drive": _driven(trial),
        "can_simplify": False,
        "things": None,
    }


def _driven(trial: Trial) -> dict[str, Any]:
    return {
        "way_m": round(trial.way_m, 4),
        "aside_m": round(trial.aside_m, 4),
        "turn_deg": round(trial.turn_deg, 2),
        "fits": trial.fits,
    }


def _universe(root: Path, main: Path, name: str, wish: Wish) -> dict[str, Any]:
    files = DiskFiles(Packages(main.parent, [Place("what is imported", root)], installed_places(os.environ)))
    data = main.read_bytes()
    if main.suffix in (".yaml", ".yml"):
        made = import_map(data, str(main), files)
    else:
        made = import_sdf(data, str(main), files, name=name, simplify=wish.simplify)
    file = main.relative_to(root).as_posix()
    left_out = [{"file": file, "line": found.line, "text": found.message} for found in made.left_out]
    return {
        "path": f"universes/{name}.yaml",
        "files": {f"universes/{name}.yaml": made.text.encode(), **made.files},
        "report": {"taken": [], "assumed": [], "left_out": left_out},
        "test_drive": None,
        "can_simplify": any("import again with simplify" in found.message for found in made.left_out),
        "things": made.things,
    }


def _line(text: str, main: Path) -> dict[str, Any]:
    """Returns a line of a report; what is before its text is the place."""
    found = _PLACE.fullmatch(text)
    if found is None:
        return {"file": "", "line": None, "text": text}
    return {"file": _beside(main, found["file"]), "line": int(found["line"]), "text": found["text"]}


def _files(root: Path, made: Mapping[str, bytes]) -> list[dict[str, str]]:
    sizes: dict[int, list[Path]] = {}
    for file in sorted(root.rglob("*")):
        if file.is_file():
            sizes.setdefault(file.stat().st_size, []).append(file)
    answer: list[dict[str, str]] = []
    for path, data in made.items():
        same = next((source for source in sizes.get(len(data), []) if source.read_bytes() == data), None)
        if same is not None and data:
            answer.append({"path": path, "source": same.relative_to(root).as_posix()})
        else:
            answer.append({"path": path, "base64": base64.b64encode(data).decode()})
    return answer
