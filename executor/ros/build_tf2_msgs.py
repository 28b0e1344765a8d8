"""Builds `tf2_msgs` (the messages of `/tf`), of which there is no wheel, and installs it beside the others.

Set-up runs `python -m executor.ros.build_tf2_msgs`. The generators are in the rosidl wheels; they need
`empy<4` and are given one of their own. It takes seconds and is done once. Where it cannot be done, one
sentence says why, the exit status is 0 all the same, and `/tf` is left out.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from importlib.util import find_spec
from pathlib import Path
from typing import Final

PACKAGE: Final = "tf2_msgs"
DEFINITION: Final = "geometry_msgs/TransformStamped[] transforms\n"
EMPY: Final = "empy>=3.3,<4"
DEPENDENCIES: Final = ("geometry_msgs", "std_msgs", "builtin_interfaces")
RUNTIME: Final = (
    "rosidl_runtime_c",
    "rosidl_typesupport_c",
    "rosidl_typesupport_fastrtps_c",
    "rosidl_typesupport_fastrtps_cpp",
    "rosidl_typesupport_introspection_c",
    "rmw",
    "rcutils",
    "fastcdr",
)
PREFIX: Final = Path(sys.prefix)

# Runs with the older empy on its path, so in a process of its own.
_GENERATE: Final = """
import sys
from pathlib import Path
from rosidl_adapter import convert_to_idl
from rosidl_generator_c import cli as c
from rosidl_generator_py.cli import GeneratePython
from rosidl_generator_type_description.cli import HashTypeDescription
from rosidl_typesupport_c.cli import GenerateCTypesupport
from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport
from rosidl_typesupport_introspection_c.cli import GenerateIntrospectionCTypesupport

package, work, share = sys.argv[1], Path(sys.argv[2]), sys.argv[3:]
output = work / package
convert_to_idl(work, package, Path("msg/TFMessage.msg"), work)
files = [f"{work}:msg/TFMessage.idl"]
hashes = HashTypeDescription("hash").generate_type_hashes(package, files, share, output)
c.GenerateC("c").generate(package, list(files), share, output, hashes)
GenerateFastRTPSCTypesupport("fastrtps_c").generate(package, list(files), share, output)
GenerateIntrospectionCTypesupport("introspection_c").generate(package, list(files), share, output)
both = ["rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c"]
GenerateCTypesupport("c", typesupport_implementations=both).generate(package, list(files), share, output)
GeneratePython("py", typesupport_implementations=["rosidl_typesupport_c"]).generate(
    package, list(files), share, output
)
"""

_CHECK: Final = """
import rclpy
from tf2_msgs.msg import TFMessage

rclpy.init()
node = rclpy.create_node("check")
publisher = node.create_publisher(TFMessage, "/bt_studio_check_tf", 1)
publisher.publish(TFMessage())
rclpy.shutdown()
"""


class CannotBuildError(Exception):
    """Why there will be no `/tf`."""


def is_built() -> bool:
    """Tells whether the messages are there and work."""
    if find_spec(PACKAGE) is None:
        return False
    check = [sys.executable, "-c", _CHECK]
    return subprocess.run(check, capture_output=True, check=False).returncode == 0


def build() -> None:
    """Generates, compiles and installs the package.

    Raises:
        CannotBuildError: something that it takes is missing.
    """
    compilers = [shutil.which(name) for name in ("cc", "c++")]
    if None in compilers:
        raise CannotBuildError("there is no C and C++ compiler (Debian: apt-get install g++)")
    if not (Path(sysconfig.get_path("include")) / "Python.h").is_file():
        raise CannotBuildError("Python's headers are missing (Debian: apt-get install python3.11-dev)")
    with tempfile.TemporaryDirectory(prefix="tf2_msgs-") as folder:
        work = Path(folder)
        _generate(work)
        _compile(work)
        _install(work)


def _generate(work: Path) -> None:
    (work / "msg").mkdir()
    (work / "msg" / "TFMessage.msg").write_text(DEFINITION, encoding="utf-8")
    _fetch_empy(work / "empy")
    includes = [str(PREFIX / "share" / name) for name in DEPENDENCIES]
    script = work / "generate.py"
    script.write_text(_GENERATE, encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": str(work / "empy"), "AMENT_PREFIX_PATH": str(PREFIX)}
    _run([sys.executable, str(script), PACKAGE, str(work), *includes], environment)


def _fetch_empy(target: Path) -> None:
    uv = Path(sys.executable).parent / "uv"
    program = [str(uv), "pip"] if uv.is_file() else [sys.executable, "-m", "pip"]
    _run([*program, "install", "--quiet", "--target", str(target), EMPY])


def _compile(work: Path) -> None:
    generated, lib = work / PACKAGE, work / "lib"
    lib.mkdir()
    flags = ["-O2", "-fPIC", "-shared", "-w", f"-I{work}", f"-I{generated}", *_include_flags(), f"-L{lib}"]
    flags += [f"-L{PREFIX / 'lib'}", "-Wl,-rpath,$ORIGIN", f"-Wl,-rpath-link,{PREFIX / 'lib'}"]
    detail = generated / "msg" / "detail"

    def library(name: str, compiler: str, sources: list[Path], links: list[str]) -> None:
        target = lib / f"lib{PACKAGE}__{name}.so"
        _run([compiler, *map(str, sources), *flags, *(f"-l{link}" for link in links), "-o", str(target)])

    introspection = sorted(detail.glob("*__type_support.c"))
    introspection = [path for path in introspection if "introspection" in path.read_text(encoding="utf-8")]
    library(
        "rosidl_generator_c",
        "cc",
        [path for path in sorted(detail.glob("*.c")) if path not in introspection],
        ["geometry_msgs__rosidl_generator_c", "rosidl_runtime_c", "rcutils"],
    )
    library(
        "rosidl_typesupport_fastrtps_c",
        "c++",
        sorted(detail.glob("*.cpp")),
        [
            f"{PACKAGE}__rosidl_generator_c",
            "geometry_msgs__rosidl_typesupport_fastrtps_c",
            "rosidl_typesupport_fastrtps_c",
            "rosidl_typesupport_fastrtps_cpp",
            "fastcdr",
        ],
    )
    library(
        "rosidl_typesupport_introspection_c",
        "cc",
        introspection,
        [
            f"{PACKAGE}__rosidl_generator_c",
            "geometry_msgs__rosidl_typesupport_introspection_c",
            "rosidl_typesupport_introspection_c",
        ],
    )
    library(
        "rosidl_typesupport_c",
        "c++",
        sorted((generated / "msg").glob("*.cpp")),
        [f"{PACKAGE}__rosidl_generator_c", "rosidl_typesupport_c"],
    )
    library(
        "rosidl_generator_py",
        "cc",
        sorted((generated / "msg").glob("*_s.c")),
        [f"{PACKAGE}__rosidl_generator_c", "geometry_msgs__rosidl_generator_py", "rosidl_runtime_c"],
    )
    extension = f"{PACKAGE}_s__rosidl_typesupport_c{sysconfig.get_config_var('EXT_SUFFIX')}"
    entry = [str(path) for path in generated.glob("_*.ep.rosidl_typesupport_c.c")]
    links = [
        f"-l{PACKAGE}__{name}"
        for name in ("rosidl_generator_py", "rosidl_typesupport_c", "rosidl_generator_c")
    ]
    up = ["-Wl,-rpath,$ORIGIN/../../.."]
    _run(["cc", *entry, *flags, *up, *links, "-lrosidl_typesupport_c", "-o", str(generated / extension)])


def _include_flags() -> list[str]:
    import numpy as np  # noqa: PLC0415 - the set-up's Python may lack it; then this is an honest error

    folders = [
        PREFIX / "include" / name for name in (*DEPENDENCIES, *RUNTIME, "rosidl_typesupport_interface")
    ]
    folders += [PREFIX / "include" / name for name in ("rosidl_dynamic_typesupport", "service_msgs")]
    folders += [PREFIX / "include", Path(sysconfig.get_path("include")), Path(np.get_include())]
    return [f"-I{folder}" for folder in folders]


def _install(work: Path) -> None:
    """Copies what runs; the package folder last, so that a broken copy is never taken for a whole one."""
    for library in (work / "lib").iterdir():
        shutil.copy2(library, PREFIX / "lib" / library.name)
    (work / PACKAGE / "__init__.py").touch()
    target = Path(sysconfig.get_path("platlib")) / PACKAGE
    shutil.rmtree(target, ignore_errors=True)
    keep = shutil.ignore_patterns("detail", "*.c", "*.cpp", "*.h", "*.json", "*.idl")
    shutil.copytree(work / PACKAGE, target, ignore=keep)


def _run(command: list[str], environment: dict[str, str] | None = None) -> None:
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    except OSError as error:
        raise CannotBuildError(f"{command[0]} cannot be run: {error}") from error
    if done.returncode != 0:
        lines = (done.stderr or done.stdout).strip().splitlines() or ["no output"]
        errors = [line for line in lines if "error" in line.lower()]
        raise CannotBuildError(f"{Path(command[0]).name} failed: {(errors or lines)[-1]}")


def main() -> None:
    """Builds unless it is done; says in one sentence what came of it."""
    if is_built():
        print("tf2_msgs is there.")  # noqa: T201 - the sentence that set-up shows
        return
    try:
        build()
    except (CannotBuildError, ImportError, OSError) as error:
        print(f"tf2_msgs was not built, so /tf is left out: {error}.")  # noqa: T201
        return
    works = is_built()
    print("tf2_msgs was built." if works else "tf2_msgs was built but does not load; /tf is left out.")  # noqa: T201


if __name__ == "__main__":
    main()
