"""Sets up a fresh clone: `python3.11 backend/setup {run|test}`.

It needs only the standard library, since it runs before anything is installed. Python 3.7 and later can parse
it, so that it can report a wrong version. A step is skipped when its result is still current, so that a
second start costs a few hundred milliseconds. Everything is written into the clone: `.venv`,
`frontend/node_modules`, `frontend/dist`, `var`. The only exception are the Debian packages that the tests
need, which are installed if the user is root.
"""

from __future__ import annotations

import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import venv
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, NoReturn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

ROOT = Path(__file__).resolve().parent.parent.parent
VENV = ROOT / ".venv"
PYTHON = VENV / "bin" / "python"
FRONTEND = ROOT / "frontend"
STAMPS = ROOT / "var" / "setup"
NEEDED_NODE = (20, 19)
INTERFACE_PROGRAMS = ("build_interfaces", "generate_interfaces", "interface_definitions")
TEST_PACKAGES = (
    "chromium",
    "libegl1",
    "libgl1-mesa-dri",
    "postgresql",
    "redis-server",
    "kubernetes-client",
    "caddy",
)


class Step(NamedTuple):
    """One step of the set-up. It is repeated if its inputs have changed or its result is missing."""

    name: str
    sentence: str
    sources: Iterable[Path]
    product: Path
    make: Callable[[], None]


def main(arguments: list[str]) -> None:
    """Sets up for `run` or for `test`."""
    goal = arguments[0] if arguments else "run"
    if goal not in ("run", "test"):
        stop(f"The goal is run or test, not {goal}.")
    check_machine()
    check_node()
    steps = [
        python_step(),
        packages_step(goal),
        own_package_step(),
        bytecode_step(),
        node_step(),
        front_end_step(),
        interfaces_step(),
    ]
    if goal == "test":
        steps.append(ram_client_step())
    for step in steps:
        take(step)
    if goal == "test":
        ensure_debian_packages()


def stop(sentence: str) -> NoReturn:
    """Reports in one sentence why set-up cannot continue, and exits."""
    print(f"set-up: {sentence}", file=sys.stderr)
    sys.exit(1)


def say(sentence: str) -> None:
    """Prints the current step of the set-up."""
    print(f"set-up: {sentence}", flush=True)


def check_machine() -> None:
    """Checks the platform, since PyBullet and ROS 2 have wheels for one platform only."""
    if sys.platform != "linux" or platform.machine() not in ("x86_64", "AMD64"):
        stop(
            "BT Studio runs on Linux x86-64 with CPython 3.11; "
            f"this is {platform.system()} on {platform.machine()}."
        )
    if sys.version_info[:2] != (3, 11) or platform.python_implementation() != "CPython":
        stop(
            f"BT Studio needs CPython 3.11 and this is {platform.python_implementation()} "
            f"{platform.python_version()}; install it (Debian: apt install python3.11 python3.11-venv; "
            "anywhere: pyenv install 3.11, or uv python install 3.11) so that `python3.11` is found."
        )


def check_node() -> None:
    """Checks that Node.js is available, which builds the front end."""
    remedy = "install Node 20.19 or newer with npm (see nodejs.org) so that `node` and `npm` are found."
    if shutil.which("node") is None or shutil.which("npm") is None:
        stop(f"Node.js is missing; {remedy}")
    version = output_of(["node", "--version"]) or ""
    found = re.match(r"v(\d+)\.(\d+)", version)
    if not found or (int(found[1]), int(found[2])) < NEEDED_NODE:
        stop(f"Node.js {version.strip() or 'of an unknown version'} is too old; {remedy}")


def output_of(command: list[str]) -> str | None:
    """Returns the standard output of a command, or None if it fails."""
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None


def python_step() -> Step:
    """Returns the step that makes a virtual environment of this Python."""
    return Step("python", "making .venv", [], PYTHON, make_venv)


def make_venv() -> None:
    """Makes the virtual environment."""
    try:
        venv.create(VENV, with_pip=True, clear=VENV.exists())
    except (subprocess.CalledProcessError, ImportError):
        stop("Python's venv module is incomplete; install it (Debian: apt install python3.11-venv).")


def packages_step(goal: str) -> Step:
    """Returns the step that installs the locked Python packages.

    The lock of the tests includes that of `run`.
    """
    run_lock, test_lock, build_lock = (
        ROOT / name for name in ("requirements.lock", "requirements-dev.lock", "requirements-build.lock")
    )
    lock = test_lock if goal == "test" or stamp_file("packages-test").exists() else run_lock
    name = "packages-test" if lock is test_lock else "packages"
    return Step(
        name,
        "installing the Python packages (about 1 GB, from a hash-pinned lock)",
        [lock, build_lock],
        VENV / "bin" / "uv",
        lambda: install_packages(lock, build_lock),
    )


def install_packages(lock: Path, build_lock: Path) -> None:
    """Installs the build tools with pip, and with them the packages of the lock, by their hashes."""
    pip = [str(PYTHON), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    run([*pip, "--require-hashes", "-r", str(build_lock)])
    run([*uv_install(), "--compile-bytecode", "--require-hashes", "-r", str(lock)])


def uv_install() -> list[str]:
    """Returns the command that installs packages into .venv."""
    return [str(VENV / "bin" / "uv"), "pip", "install", "--python", str(PYTHON), "--quiet"]


# Adds a path instead of an import hook, which every process would have to load.
OWN_OPTIONS = ["--no-deps", "--no-build-isolation", "--config-settings", "editable_mode=compat"]


def own_package_step() -> Step:
    """Returns the step that installs the distributions of this clone: the engine, and `bt-studio` on it."""
    folders = [ROOT / "tree_gardener", ROOT]
    editable = [word for folder in folders for word in ("--editable", str(folder))]
    return Step(
        "bt-studio",
        "installing bt-studio itself into .venv",
        [folder / "pyproject.toml" for folder in folders],
        VENV / "bin" / "bt-studio",
        lambda: run([*uv_install(), *OWN_OPTIONS, *editable]),
    )


def bytecode_step() -> Step:
    """Returns the step that compiles the modules to bytecode, so that processes start in half the time."""
    packages = [ROOT / name for name in ("backend", "executor", "translator", "tree_gardener")]
    compile_all = [str(PYTHON), "-m", "compileall", "-q", "-j", "0", *map(str, packages)]
    return Step(
        "bytecode",
        "compiling BT Studio's own modules",
        [source for package in packages for source in sorted(package.rglob("*.py"))],
        VENV,
        lambda: run(compile_all),
    )


def node_step() -> Step:
    """Returns the step that installs the npm packages of the lock."""
    return Step(
        "npm",
        "installing the npm packages",
        [FRONTEND / "package-lock.json"],
        FRONTEND / "node_modules" / ".package-lock.json",
        lambda: run(["npm", "ci", "--no-audit", "--no-fund", "--loglevel=error"], cwd=FRONTEND),
    )


def ram_client_step() -> Step:
    """Returns the step that installs JdeRobot's npm client, with which tests drive the manager."""
    folder = ROOT / "tests" / "ram_client"
    return Step(
        "ram-client",
        "installing the npm client of the RAM tests",
        [folder / "package-lock.json"],
        folder / "node_modules" / ".package-lock.json",
        lambda: run(["npm", "ci", "--no-audit", "--no-fund", "--loglevel=error"], cwd=folder),
    )


def front_end_step() -> Step:
    """Returns the step that builds the front end."""
    sources = [*sorted((FRONTEND / "src").rglob("*")), *sorted((FRONTEND / "public").rglob("*"))]
    names = ("index.html", "vite.config.ts", "compressed.ts", "package-lock.json")
    configuration = [FRONTEND / name for name in names]
    catalog = ROOT / "tree_gardener" / "catalog.json"
    return Step(
        "front-end",
        "building the front end",
        [*sources, *configuration, catalog],
        FRONTEND / "dist" / "index.html",
        lambda: run(["npm", "run", "--silent", "build"], cwd=FRONTEND),
    )


def interfaces_step() -> Step:
    """Returns the step that builds ROS 2's message packages without wheels.

    Without a compiler these packages are left out, and each start tries again.
    """
    ros = ROOT / "executor" / "ros"
    programs = [ros / f"{name}.py" for name in INTERFACE_PROGRAMS]
    return Step(
        "interfaces",
        "building ROS 2's messages of tf2, Nav2, control and vision (a minute or two, once)",
        [*programs, *sorted((ros / "interfaces").glob("*.txt")), ROOT / "requirements.lock"],
        VENV / "share" / "bt_studio_interfaces" / "complete",
        lambda: run([str(PYTHON), "-m", "executor.ros.build_interfaces"], cwd=ROOT),
    )


def take(step: Step) -> None:
    """Runs a step, unless its result is up to date."""
    stamp = stamp_file(step.name)
    digest = digest_of(step.sources)
    if step.product.exists() and stamp.exists() and stamp.read_text() == digest:
        return
    say(f"{step.sentence} …")
    step.make()
    stamp.parent.mkdir(parents=True, exist_ok=True)
    stamp.write_text(digest)


def stamp_file(name: str) -> Path:
    """Returns the file with the digest of a step's inputs."""
    return STAMPS / name


def digest_of(sources: Iterable[Path]) -> str:
    """Returns a digest of names and contents, and of the clone's path, which scripts in .venv contain."""
    digest = hashlib.sha256(str(ROOT).encode())
    for path in sources:
        if path.is_file():
            digest.update(str(path.relative_to(ROOT)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def run(command: list[str], cwd: Path = ROOT) -> None:
    """Runs a command; if it fails, stops with a sentence below the command's output."""
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": ""}
    try:
        subprocess.run(command, cwd=cwd, env=environment, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        shown = " ".join(command[:4])
        stop(f"`{shown} …` failed ({error}); what it says stands above. Fix it and run make again.")


def ensure_debian_packages() -> None:
    """Installs Chromium, EGL, PostgreSQL, Redis and kubectl for the tests, if the user is root."""
    missing = [name for name, present in test_programs() if not present]
    if not missing:
        return
    install = ["apt-get", "install", "-y", "--no-install-recommends", *missing]
    if os.geteuid() != 0 or shutil.which("apt-get") is None:
        stop(f"the tests need {' and '.join(missing)}; install them with: sudo {' '.join(install)}")
    say(f"installing the Debian packages {' '.join(missing)} on this machine, for the tests …")
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    subprocess.run(["apt-get", "update", "-q"], env=quiet, check=False, stdout=subprocess.DEVNULL)
    # Another installation on this machine, such as the set-up of a second clone, has ten minutes to end.
    patient = [*install, "-o", "DPkg::Lock::Timeout=600"]
    if subprocess.run(patient, env=quiet, check=False, stdout=subprocess.DEVNULL).returncode:
        stop(f"`{' '.join(install)}` failed; what it says stands above.")


def test_programs() -> list[tuple[str, bool]]:
    """Returns the Debian packages, each with whether its program exists."""
    libraries = output_of(["ldconfig", "-p"]) or ""
    drivers = [*Path("/usr/lib").glob("*/dri/swrast_dri.so"), *Path("/usr/lib").glob("*/libgallium*.so")]
    present = (
        shutil.which("chromium") is not None,
        "libEGL.so.1" in libraries,
        bool(drivers),
        any(Path("/usr/lib/postgresql").glob("*/bin/initdb")),
        shutil.which("redis-server") is not None,
        shutil.which("kubectl") is not None,
        shutil.which("caddy") is not None,
    )
    return list(zip(TEST_PACKAGES, present, strict=True))


if __name__ == "__main__":
    main(sys.argv[1:])
