"""A Python file as its own program, with the place of what is wrong."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys

import pytest

from translator.package.launch_files import as_program
from tree_gardener import ros_script
from tree_gardener.ros_fields import VARIABLE

ROOT = pathlib.Path(__file__).parents[2]
SENTENCE = "geometry_msgs/Vector3.x takes a float, not the int 1: write 1.0"
ENVIRONMENT = {
    **{key: value for key, value in os.environ.items() if key != VARIABLE},
    "PYTHONPATH": str(ROOT),
    "PATH": f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}",
}


def ran(folder: pathlib.Path, source: str, *words: str) -> subprocess.CompletedProcess[str]:
    """Runs a source from its folder, as the session does."""
    file = folder / "nodes/one.py"
    file.parent.mkdir(exist_ok=True)
    file.write_text(source)
    command = [sys.executable, "-P", "-m", ros_script.__name__, str(file), *words]
    return subprocess.run(command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=False)


MESSAGE = "from geometry_msgs.msg import Vector3\n"


def test_a_wrong_field_has_a_place_and_a_remedy(tmp_path: pathlib.Path) -> None:
    done = ran(tmp_path, f"{MESSAGE}def turn():\n    Vector3(x=1)\nturn()\n")
    *trace, last = done.stderr.splitlines()
    assert (done.returncode, last) == (1, f"nodes/one.py:3: {SENTENCE}")
    assert trace[0] == "Traceback (most recent call last):"
    assert "ros_script" not in done.stderr
    in_thread = f"{MESSAGE}import threading\nthreading.Thread(target=Vector3, kwargs={{'x': 1}}).start()\n"
    assert ran(tmp_path, in_thread).stderr.splitlines()[-1].endswith(SENTENCE)


@pytest.mark.parametrize(
    ("source", "last"),
    [
        ("import json\njson.loads('{')\n", "nodes/one.py:2: JSONDecodeError: "),
        ("x = (\n", "nodes/one.py:1: SyntaxError: "),
        ("raise SystemExit('no')\n", "no"),
        ("raise KeyboardInterrupt\n", "KeyboardInterrupt"),
    ],
)
def test_other_ends_are_those_of_python(tmp_path: pathlib.Path, source: str, last: str) -> None:
    done = ran(tmp_path, source)
    assert done.returncode != 0
    assert done.stderr.splitlines()[-1].startswith(last)


SEEN = """import pickle, sys, beside
class Own: pass
pickle.loads(pickle.dumps(Own()))
print(__name__, __file__ == sys.argv[0], sys.argv[1:], beside.WORD)
"""


def test_the_file_sees_what_a_program_sees(tmp_path: pathlib.Path) -> None:
    (tmp_path / "nodes").mkdir()
    (tmp_path / "nodes/beside.py").write_text("WORD = 'beside'\n")
    (tmp_path / "queue.py").write_text("raise RuntimeError('the folder of the project hides no module')\n")
    done = ran(tmp_path, SEEN, "a", "--b")
    assert (done.stdout, done.stderr) == ("__main__ True ['a', '--b'] beside\n", "")


def test_an_executable_of_a_package_says_the_same(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "talker.py"
    file.write_bytes(as_program(f"{MESSAGE}Vector3(x=1)\n".encode()))
    file.chmod(0o700)
    done = subprocess.run([file], cwd="/", env=ENVIRONMENT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr.splitlines()[-1]) == (1, f"{file}:3: {SENTENCE}")
