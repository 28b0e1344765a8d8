"""Builds ROS message packages that have no wheel, and installs them beside the others.

Set-up runs `python -m executor.ros.build_interfaces`. The definitions are in `interfaces/`; the generators
are in the rosidl wheels and get their own copy of `empy<4`. A package is built again when its definition,
that of a package that it uses, this program or a generator has changed. If the build fails, the program
prints a sentence with the reason and the missing packages; the exit status is still 0, since nothing else
needs these packages. The file `COMPLETE` exists when all were built.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor, wait
from importlib.metadata import distributions
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.ros.environment import lockstep_environment
from executor.ros.interface_definitions import FOLDER, PACKAGES, definitions_of, needed_by

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

EMPY: Final = "empy>=3.3,<4"
RUNTIME: Final = (
    "rosidl_runtime_c",
    "rosidl_typesupport_c",
    "rosidl_typesupport_fastrtps_c",
    "rosidl_typesupport_fastrtps_cpp",
    "rosidl_typesupport_introspection_c",
    "rosidl_typesupport_cpp",
    "rosidl_typesupport_interface",
    "rosidl_runtime_cpp",
    "rosidl_dynamic_typesupport",
    "rmw",
    "rcutils",
    "fastcdr",
)
RUNTIME_LIBRARIES: Final = (
    "rosidl_typesupport_fastrtps_c",
    "rosidl_typesupport_fastrtps_cpp",
    "rosidl_typesupport_introspection_c",
    "rosidl_typesupport_c",
    "rosidl_runtime_c",
    "rcutils",
    "fastcdr",
)
# rosidl looks for the parts of a package's type support under these names. Here one library has all of them.
SUPPORTS: Final = ("typesupport_fastrtps_c", "typesupport_introspection_c")
INTROSPECTION: Final = "introspection"  # the folder that generate_interfaces makes beside the packages
PREFIX: Final = Path(sys.prefix)
STAMPS: Final = PREFIX / "share" / "bt_studio_interfaces"
COMPLETE: Final = STAMPS / "complete"
_PROGRAMS: Final = ("build_interfaces.py", "generate_interfaces.py", "interface_definitions.py")
_ERROR: Final = re.compile(r"\berror: |^\S*(?:Error|Support)\b.*:")
_STATIC: Final = re.compile(r"^static .*?(\w+)(?:\[\w*\])? =", re.MULTILINE)
# Optimizing for size halves the time to compile, and messages are converted equally fast.
_FLAGS: Final = ("-Os", "-fPIC", "-w")

# Imported now, so that a type support that does not load fails the build.
_CHECK: Final = """
import importlib, sys, rclpy
from rclpy.type_support import check_for_type_support
rclpy.init()
node = rclpy.create_node("check")
for package in sys.argv[1:]:
    for kind in ("msg", "srv", "action"):
        try:
            module = importlib.import_module(f"{package}.{kind}")
        except ModuleNotFoundError:
            continue
        for interface in vars(module).values():
            if hasattr(interface, "__import_type_support__"):
                check_for_type_support(interface)
                parts = [getattr(interface, name, None) for name in ("Request", "Goal")]
                message = next((part for part in parts if part is not None), interface)()
                if kind == "msg":
                    publisher = node.create_publisher(interface, f"/check/{interface.__name__}", 1)
                    publisher.publish(message)
    node.destroy_node()
    node = rclpy.create_node("check")
rclpy.shutdown()
"""


class CannotBuildError(Exception):
    """The packages cannot be built; the text is the reason."""


def missing() -> list[str]:
    """Returns the packages that are not built, or are outdated."""
    return [package for package in PACKAGES if not _is_current(package)]


def build(packages: Sequence[str], say: Callable[[str], None]) -> None:
    """Generates, compiles and installs packages.

    Raises:
        CannotBuildError: a tool is missing, or failed.
    """
    _check_tools()
    with tempfile.TemporaryDirectory(prefix="interfaces-") as folder:
        work = Path(folder)
        _fetch_empy(work / "empy")
        _Build(work, say).run(packages)
    _run([sys.executable, "-c", _CHECK, *packages], {**os.environ, **lockstep_environment()})
    for package in packages:
        (STAMPS / package).write_text(_digest(package), encoding="utf-8")


class _Build:
    """One build: packages in parallel, with as many programs at the same time as there are processors."""

    def __init__(self, work: Path, say: Callable[[str], None]) -> None:
        self._work = work
        self._say = say
        self._processors = threading.Semaphore(os.cpu_count() or 2)
        self._failures: list[CannotBuildError] = []
        self._described: dict[str, Future[None]] = {}
        self._linked: dict[str, Future[None]] = {}
        self._environment = {
            **os.environ,
            "PYTHONPATH": str(work / "empy"),
            "AMENT_PREFIX_PATH": str(PREFIX),
        }

    def run(self, packages: Iterable[str]) -> None:
        """Builds the packages and the built-in packages that they use; installs all of them at the end."""
        wanted = {name for package in packages for name in (package, *needed_by(package)) if name in PACKAGES}
        (self._work / "lib").mkdir()
        # Each package blocks several threads that wait for its steps and for the packages that it uses.
        with ThreadPoolExecutor(8 * len(wanted)) as pool:
            for package in (name for name in PACKAGES if name in wanted):
                self._described[package] = pool.submit(self._describe, package)
                self._linked[package] = pool.submit(self._make, package, pool)
            wait(self._linked.values())
        if self._failures:
            raise self._failures[0]
        for done in self._linked.values():
            done.result()
        for package in wanted:
            self._install(package)

    def _describe(self, package: str) -> None:
        folder = self._work / package
        for path, text in definitions_of(package).items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text, encoding="utf-8")
        self._wait(self._described, package)
        self._generate("describe", package)

    def _make(self, package: str, pool: ThreadPoolExecutor) -> None:
        self._described[package].result()
        steps = ("structures", "support", "python")
        for step in [pool.submit(self._generate, step, package) for step in steps]:
            step.result()
        units = self._units(package)
        self._wait(self._described, package)
        objects = [pool.submit(self._compile, package, name, sources) for name, sources in units.items()]
        compiled = [each.result() for each in objects]
        self._wait(self._linked, package)
        self._link(package, compiled)
        self._say(f"{package} ({len(definitions_of(package))} interfaces)")

    def _wait(self, others: dict[str, Future[None]], package: str) -> None:
        for name in needed_by(package):
            if name in others:
                others[name].result()

    def _generate(self, step: str, package: str) -> None:
        script = Path(__file__).with_name("generate_interfaces.py")
        shares = [
            self._work / name if name in PACKAGES else PREFIX / "share" / name for name in needed_by(package)
        ]
        command = [sys.executable, str(script), step, str(self._work / package), *map(str, shares)]
        self._take_turn(command, self._environment)

    def _units(self, package: str) -> dict[str, list[Path]]:
        """Returns the sources of each compilation unit.

        Sources are combined so that common headers are parsed once.
        """
        folder = self._work / package
        descriptions = sorted(folder.glob("*/detail/*__description.c"))
        structures = [path for path in sorted(folder.glob("*/detail/*.c")) if path not in descriptions]
        return {
            "support.cpp": sorted(folder.glob("*/detail/*.cpp")),
            "structures.c": structures,
            "python.c": sorted(folder.glob("*/*_s.c")),
            "descriptions.c": descriptions,
            "introspection.c": sorted((self._work / INTROSPECTION / package).glob("*/detail/*.c")),
            "types.cpp": sorted(folder.glob("*/*.cpp")),
        }

    def _compile(self, package: str, name: str, sources: list[Path]) -> Path:
        unit = self._work / package / name
        unit.write_text("".join(map(_included, sources)), encoding="utf-8")
        target = unit.with_name(unit.name + ".o")
        compiler = "c++" if unit.suffix == ".cpp" else "cc"
        includes = self._includes(package)
        self._take_turn([compiler, *_FLAGS, *includes, "-c", str(unit), "-o", str(target)])
        return target

    def _includes(self, package: str) -> list[str]:
        import numpy as np  # noqa: PLC0415 - the set-up's Python may lack it; then this is an honest error

        folders = [PREFIX / "include" / name for name in (*needed_by(package), *RUNTIME)]
        folders += [
            self._work,
            self._work / INTROSPECTION,
            PREFIX / "include",
            Path(sysconfig.get_path("include")),
            Path(np.get_include()),
        ]
        return [f"-I{folder}" for folder in folders]

    def _link(self, package: str, objects: list[Path]) -> None:
        """Makes the library of the package, and the extension that registers it in Python."""
        lib, own = self._work / "lib", f"{package}__bt_studio"
        others = [f"{name}__bt_studio" for name in needed_by(package) if name in PACKAGES]
        for name in needed_by(package):
            kinds = ("generator_c", *SUPPORTS, "typesupport_c", "generator_py")
            links = [f"{name}__rosidl_{kind}" for kind in kinds]
            others += [link for link in links if (PREFIX / "lib" / f"lib{link}.so").is_file()]
        paths = [f"-L{lib}", f"-L{PREFIX / 'lib'}", f"-Wl,-rpath-link,{PREFIX / 'lib'}"]
        links = [f"-l{name}" for name in (*others, *RUNTIME_LIBRARIES)]
        target = lib / f"lib{own}.so"
        head = ["c++", "-shared", "-Wl,--as-needed"]
        self._take_turn([*head, *map(str, objects), *paths, "-Wl,-rpath,$ORIGIN", *links, "-o", str(target)])
        folder = self._work / package
        (entry,) = folder.glob("_*.ep.rosidl_typesupport_c.c")
        suffix = sysconfig.get_config_var("EXT_SUFFIX")
        extension = folder / f"{package}_s__rosidl_typesupport_c{suffix}"
        compiled = self._compile(package, "entry.c", [entry])
        up = "-Wl,-rpath,$ORIGIN/../../.."
        self._take_turn([*head, str(compiled), *paths, up, f"-l{own}", *links, "-o", str(extension)])

    def _install(self, package: str) -> None:
        """Copies the runtime files, the package's folder last; so a partial copy never looks complete."""
        STAMPS.mkdir(parents=True, exist_ok=True)
        (STAMPS / package).unlink(missing_ok=True)
        library = f"lib{package}__bt_studio.so"
        _replace(self._work / "lib" / library, PREFIX / "lib" / library)
        for support in SUPPORTS:
            name = PREFIX / "lib" / f"lib{package}__rosidl_{support}.so"
            name.unlink(missing_ok=True)
            name.symlink_to(library)
        (self._work / package / "__init__.py").touch()
        target = Path(sysconfig.get_path("platlib")) / package
        shutil.rmtree(target, ignore_errors=True)
        leave = ("detail", "*.c", "*.cpp", "*.h", "*.o", "*.json", "*.idl", "*.msg", "*.srv", "*.action")
        shutil.copytree(self._work / package, target, ignore=shutil.ignore_patterns(*leave))

    def _take_turn(self, command: list[str], environment: dict[str, str] | None = None) -> None:
        with self._processors:
            if self._failures:
                raise CannotBuildError("another part failed")  # this text is shown
            try:
                _run(command, environment)
            except CannotBuildError as error:
                self._failures.append(error)
                raise


def _included(source: Path) -> str:
    """Returns the text that includes a source.

    Static names get a suffix, since other sources define the same names.
    """
    names: list[str] = []
    if source.name.endswith("__description.c"):
        names = sorted(set(_STATIC.findall(source.read_text(encoding="utf-8"))))
    suffix = source.name.removesuffix(".c") + "__" + source.parents[1].name
    before = "".join(f"#define {name} {name}__{suffix}\n" for name in names)
    after = "".join(f"#undef {name}\n" for name in names)
    return f'{before}#include "{source}"\n{after}'


def _is_current(package: str) -> bool:
    stamp, library = STAMPS / package, PREFIX / "lib" / f"lib{package}__bt_studio.so"
    folder = Path(sysconfig.get_path("platlib")) / package
    made = stamp.is_file() and library.is_file() and (folder / "__init__.py").is_file()
    return made and stamp.read_text(encoding="utf-8") == _digest(package)


def _digest(package: str) -> str:
    """Returns a digest of all sources of a package."""
    digest = hashlib.sha256(sysconfig.get_platform().encode() + str(PREFIX).encode())
    for name in (package, *needed_by(package)):
        if name in PACKAGES:
            digest.update((FOLDER / f"{name}.txt").read_bytes())
    for program in _PROGRAMS:
        digest.update(Path(__file__).with_name(program).read_bytes())
    versions = (f"{found.name} {found.version}" for found in distributions())
    digest.update("\n".join(sorted(line for line in versions if line.startswith(("ros", "numpy ")))).encode())
    return digest.hexdigest()


def _check_tools() -> None:
    if None in (shutil.which("cc"), shutil.which("c++")):
        raise CannotBuildError("there is no C and C++ compiler (Debian: apt-get install g++)")
    if not (Path(sysconfig.get_path("include")) / "Python.h").is_file():
        raise CannotBuildError("Python's headers are missing (Debian: apt-get install python3.11-dev)")


def _fetch_empy(target: Path) -> None:
    uv = Path(sys.executable).parent / "uv"
    program = [str(uv), "pip"] if uv.is_file() else [sys.executable, "-m", "pip"]
    _run([*program, "install", "--quiet", "--target", str(target), EMPY])


def _replace(source: Path, target: Path) -> None:
    """Replaces a file without writing into it, since a running program may have mapped it."""
    beside = target.with_name(f".{target.name}.new")
    shutil.copy2(source, beside)
    beside.replace(target)


def _run(command: list[str], environment: dict[str, str] | None = None) -> None:
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    except OSError as error:
        raise CannotBuildError(f"{command[0]} cannot be run: {error}") from error
    if done.returncode != 0:
        lines = (done.stderr or done.stdout).strip().splitlines() or ["no output"]
        errors = [line for line in lines if _ERROR.search(line)]
        raise CannotBuildError(f"{Path(command[0]).name} failed: {(errors or lines)[-1]}")


def main() -> None:
    """Builds the missing packages; reports the result in one sentence."""
    packages = missing()
    if not packages:
        COMPLETE.touch()
        print(f"{_listed(PACKAGES)} are there.")  # noqa: T201 - the sentence that set-up shows
        return
    COMPLETE.unlink(missing_ok=True)
    began_s = time.monotonic()
    try:
        build(packages, lambda text: print(f"  built {text}", flush=True))  # noqa: T201
    except (CannotBuildError, ImportError, OSError) as error:
        without = " and /tf" if "tf2_msgs" in packages else ""
        print(f"{_listed(packages)} were not built, so they{without} are left out: {error}.")  # noqa: T201
        return
    COMPLETE.touch()
    print(f"{_listed(packages)} were built in {time.monotonic() - began_s:.0f} s.")  # noqa: T201


def _listed(names: Iterable[str]) -> str:
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


if __name__ == "__main__":
    main()
