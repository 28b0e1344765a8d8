"""Bundles of projects: what a project is exported as or run from, values and zips of its files and new ones.

A small project comes whole, and its zips are made here. Of a large one only the files come that the
translator reads. The answer then lists the files of the zips, which the web server writes part by part.
"""

from __future__ import annotations

import base64
import re
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from backend.workers import zips

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from translator import CppPackage, Ros2Package

_OWN_ROBOT: Final = re.compile(r"robots/[^/]+/robot\.yaml")
_WORLDS: Final = ("assets/", "robots/", "universes/")
BASE64: Final = "_base64"
"""The end of the names of values that are zips in base64."""

Files = dict[str, bytes]
Answer = dict[str, Any]


class Bundle(NamedTuple):
    """The values of an answer, and the files of its zips.

    Attributes:
        values: the values but for the zips.
        zips: the files of each zip, by the path of its value: names of values within values, with slashes.
    """

    values: Answer
    zips: dict[str, Mapping[str, bytes]]


def app(files: Files, *, universe: str, built_in: bytes | None, revision: int) -> Bundle:
    """Returns the data of the command with which the browser runs the project in the executor.

    Args:
        files: the files of the project.
        universe: the name of the universe; "" for the project's own choice.
        built_in: the document of the built-in universe of that name, if the project has none.
        revision: the revision of the project.
    """
    import translator  # noqa: PLC0415 - keeps the start of the server short
    from translator.package.app import sound_app_files  # noqa: PLC0415 - as above

    project = translator.load(files)
    packed: dict[str, Mapping[str, bytes]] = {"app_zip_base64": sound_app_files(project)}
    settings = project.settings
    values: Answer = {
        "tick_hz": settings.tick_hz,
        "on_finish": settings.on_finish,
        "on_error": settings.on_error,
        "time": settings.time,
        "universe": _universe(files, universe or settings.universe, built_in),
        "robot": settings.robot,
        "revision": revision,
    }
    if isinstance(values["universe"], dict):
        worlds = {path: data for path, data in project.files.items() if path.startswith(_WORLDS)}
        packed["universe/assets_zip_base64"] = worlds
    return Bundle(values, packed)


def _universe(files: Files, name: str, built_in: bytes | None) -> str | dict[str, str]:
    """Returns a universe of the project as a document, or the id of a built-in one.

    If the project has custom robots, a built-in universe is also returned as a document, since its assets
    include them.
    """
    from translator.diagnostic import Place, TranslatorError, diagnostic  # noqa: PLC0415

    path = f"universes/{name}.yaml"
    document = files.get(path)
    if document is None and any(_OWN_ROBOT.fullmatch(path) for path in files):
        document = built_in
    if document is None:
        return name
    try:
        text = document.decode("utf-8")
    except UnicodeDecodeError as error:
        raise TranslatorError([diagnostic("BT0002", Place(path), byte=error.start)]) from error
    return {"document": text, "file": path}


def app_zip(files: Files) -> Bundle:
    """Returns the app for the manager."""
    import translator  # noqa: PLC0415
    from translator.package.app import sound_app_files  # noqa: PLC0415

    return Bundle({}, {"zip": sound_app_files(translator.load(files))})


def package(files: Files, *, name: str | None) -> Bundle:
    """Returns the ROS 2 package, with the engine's package."""
    import translator  # noqa: PLC0415

    return _package(translator.to_ros2_package(translator.load(files), name=name))


def cpp_package(files: Files, *, name: str | None) -> Bundle:
    """Returns the package for BehaviorTree.CPP."""
    import translator  # noqa: PLC0415

    return _package(translator.to_cpp_package(translator.load(files), name=name))


def _package(made: Ros2Package | CppPackage) -> Bundle:
    return Bundle({"name": made.name}, {"zip": made.files})


KINDS: Final[dict[str, Callable[..., Bundle]]] = {
    kind.__name__: kind for kind in (app, app_zip, package, cpp_package)
}


def whole(kind: str) -> Callable[..., Answer]:
    """Returns the job that makes the values of a kind of bundle with its zips."""

    def job(files: Files, **asked: Any) -> Answer:
        made = KINDS[kind](files, **asked)
        for place, held in made.zips.items():
            packed = zips.zipped(held)
            put(made.values, place, base64.b64encode(packed).decode() if place.endswith(BASE64) else packed)
        return made.values

    return job


def bundle(files: Files, *, kind: str, others: Mapping[str, int], **asked: Any) -> Answer:
    """Returns the values of a kind of bundle, and the files of its zips.

    Each file of a zip is its path and a file of the project, or its path and its content.

    Args:
        files: the files of the project that the translator reads.
        kind: the kind.
        others: the paths of the other files of the project, with their sizes.
        asked: what else the kind is made of.
    """
    everything = with_others(files, others)
    made = KINDS[kind](everything, **asked)
    sources = {id(raw): path for path, raw in everything.items()}
    listed = {
        place: [[path, sources.get(id(raw), raw)] for path, raw in held.items()]
        for place, held in made.zips.items()
    }
    return {"values": made.values, "zips": listed}


def package_preview(files: Files, *, others: Mapping[str, int], name: str | None) -> Answer:
    """Returns the list of the files of the ROS 2 package; the arguments are as for `bundle`."""
    import translator  # noqa: PLC0415

    everything = with_others(files, others)
    sizes = {id(everything[path]): size for path, size in others.items()}
    made = translator.to_ros2_package(translator.load(everything), name=name)
    listed = [
        {"path": path, "size": sizes.get(id(raw), len(raw))} for path, raw in sorted(made.files.items())
    ]
    return {
        "name": made.name,
        "files": listed,
        "manifest": made.files.get(f"{made.name}/package.xml", b"").decode(),
        "diagnostics": [found.to_json() for found in made.diagnostics],
    }


def with_others(files: Files, others: Iterable[str]) -> Files:
    """Returns files with stand-ins for others.

    The translator passes contents on as they are, so that they are known by the objects themselves.
    """
    return files | {path: f"content of {path}".encode() for path in others}


def put(values: Answer, place: str, value: Any) -> None:
    """Sets a value within values, by its names with slashes."""
    *outer, name = place.split("/")
    for each in outer:
        values = values[each]
    values[name] = value
