"""What the translator says of a project. Answers are kept by content, since most calls repeat one."""

from __future__ import annotations

import base64
import hashlib
import logging
import re
from collections import OrderedDict
from dataclasses import dataclass
from threading import Lock
from typing import TYPE_CHECKING, Any, Final, NoReturn

from backend.config.environment import REPOSITORY
from backend.config.problems import InvalidInputError
from backend.projects.errors import CheckFailedError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from translator import Ros2Package, TranslatorError

log = logging.getLogger(__name__)

_KEPT: Final = 64
_UNIVERSES: Final = REPOSITORY / "executor" / "universes"
_OWN_ROBOT: Final = re.compile(r"robots/[^/]+/robot\.yaml")


@dataclass(frozen=True, slots=True)
class Report:
    """Diagnostics and actions of a project, as JSON."""

    diagnostics: list[dict[str, Any]]
    actions: list[dict[str, Any]]
    is_whole: bool = True
    """Whether the project was checked at all; else the actions are not known."""

    def to_json(self) -> dict[str, Any]:
        """As the API tells it."""
        return {"actions": self.actions, "diagnostics": self.diagnostics, "checked": self.is_whole}


class _Reports:
    """The newest reports by the hash of what they are about; used by several threads."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._reports: OrderedDict[str, Report] = OrderedDict()

    def get(self, key: str) -> Report | None:
        with self._lock:
            if key in self._reports:
                self._reports.move_to_end(key)
            return self._reports.get(key)

    def put(self, key: str, report: Report) -> None:
        with self._lock:
            self._reports[key] = report
            while len(self._reports) > _KEPT:
                self._reports.popitem(last=False)


_reports: Final = _Reports()


def report(read: Callable[[], Mapping[str, bytes]]) -> Report:
    """Checks the project whose files `read` fetches, and never fails.

    What it tells of is stored already: that it cannot be checked must not look as if it had not been saved.
    """
    try:
        return _checked(read())
    except Exception as error:
        log.exception("a project could not be checked")
        return _unchecked(error)


def _unchecked(error: Exception) -> Report:
    from translator.diagnostic import Place, diagnostic  # noqa: PLC0415

    return Report([diagnostic("BT0009", Place(), problem=type(error).__name__).to_json()], [], is_whole=False)


def _checked(files: Mapping[str, bytes]) -> Report:
    key = _fingerprint(files)
    found = _reports.get(key)
    if found is None:
        found = _report(files)
        _reports.put(key, found)
    return found


def _report(files: Mapping[str, bytes]) -> Report:
    import translator  # noqa: PLC0415 - keeps the start of the server short

    try:
        project = translator.load(files)
    except translator.TranslatorError as error:
        return Report([d.to_json() for d in error.diagnostics], [])
    diagnostics = [d.to_json() for d in translator.check(project)]
    return Report(diagnostics, [action.to_json() for action in project.actions.values()])


def _fingerprint(files: Mapping[str, bytes]) -> str:
    digest = hashlib.sha256()
    for path in sorted(files):
        name = path.encode()
        digest.update(b"%d %d " % (len(name), len(files[path])) + name)
        digest.update(files[path])
    return digest.hexdigest()


def xml(files: Mapping[str, bytes], *, self_contained: bool) -> str:
    """The tree as BT.CPP XML.

    Raises:
        CheckFailedError: the project has errors.
    """
    import translator  # noqa: PLC0415

    try:
        project = translator.load(files)
        return translator.self_contained(project) if self_contained else translator.to_xml(project)
    except translator.TranslatorError as error:
        refuse(error)


def app(files: Mapping[str, bytes], universe_id: str | None = None) -> dict[str, Any]:
    """What the browser sends to the executor to run the project, there or in its own universe.

    Raises:
        CheckFailedError: the project has errors.
    """
    import translator  # noqa: PLC0415

    try:
        project = translator.load(files)
        zipped = translator.to_app_zip(project)
    except translator.TranslatorError as error:
        refuse(error)
    settings = project.settings
    return {
        "app_zip_base64": base64.b64encode(zipped).decode("ascii"),
        "tick_hz": settings.tick_hz,
        "on_finish": settings.on_finish,
        "on_error": settings.on_error,
        "universe": universe(files, universe_id or settings.universe),
        "robot": settings.robot,
    }


def app_zip(files: Mapping[str, bytes]) -> bytes:
    """The dockerized app.

    Raises:
        CheckFailedError: the project has errors.
    """
    import translator  # noqa: PLC0415

    try:
        return translator.to_app_zip(translator.load(files))
    except translator.TranslatorError as error:
        refuse(error)


def package(files: Mapping[str, bytes], name: str | None = None) -> Ros2Package:
    """The ROS 2 package with the engine beside it.

    Raises:
        CheckFailedError: the project has errors, or the name is none for a ROS package.
    """
    import translator  # noqa: PLC0415

    try:
        return translator.to_ros2_package(translator.load(files), name=name)
    except translator.TranslatorError as error:
        refuse(error)


def opened(files: Mapping[str, bytes], name: str, *, repair: bool = False) -> dict[str, bytes]:
    """The files of a project of ours, made of one of JdeRobot's, of Groot2's, or of BT.CPP XML.

    Raises:
        CheckFailedError: it is none of them.
    """
    import translator  # noqa: PLC0415

    try:
        return dict(translator.open_files(files, name=name, repair=repair).files)
    except translator.TranslatorError as error:
        refuse(error)


def universe(files: Mapping[str, bytes], name: str) -> str | dict[str, str]:
    """A universe of the project as document with its assets, or the id of a built-in one.

    Where the project has robots of its own, a built-in universe goes as document, too: they come with it.
    """
    from backend.projects.archive import pack  # noqa: PLC0415 - it imports this module

    path = f"universes/{name}.yaml"
    document = files.get(path)
    if document is None and any(_OWN_ROBOT.fullmatch(path) for path in files):
        built_in = {path.stem: path for path in _UNIVERSES.glob("*.yaml")}.get(name)
        document = built_in.read_bytes() if built_in else None
    if document is None:
        return name
    try:
        text = document.decode("utf-8")
    except UnicodeDecodeError as error:
        raise InvalidInputError(f"{path} is not UTF-8 text.", field="universe") from error
    assets = {p: data for p, data in files.items() if p.startswith(("assets/", "robots/", "universes/"))}
    packed = base64.b64encode(pack(assets)).decode("ascii")
    return {"document": text, "assets_zip_base64": packed, "file": path}


def inspect(source: str, filename: str) -> dict[str, Any]:
    """What the source of an action says about it."""
    import translator  # noqa: PLC0415

    return translator.inspect_action(source, filename).to_json()


def refuse(error: TranslatorError) -> NoReturn:
    """Raises what the translator refused as an answer with `diagnostics`."""
    diagnostics = [diagnostic.to_json() for diagnostic in error.diagnostics]
    first = next(
        (d for d in diagnostics if d["severity"] == "error"), diagnostics[0] if diagnostics else None
    )
    raise CheckFailedError(
        first["message"] if first else "The project cannot be translated.",
        hint=(first or {}).get("hint") or "The list of problems says what to do about each.",
        diagnostics=diagnostics,
    ) from error
