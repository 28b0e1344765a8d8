"""Actions that try to break out of a sealed run; each raises with what it has got hold of."""

from textwrap import dedent, indent

ACTION = """import py_trees


class Drive(py_trees.behaviour.Behaviour):
    def setup(self, node, **_):
        self.ticks = 0

    def update(self):
        self.ticks += 1
        if self.ticks == 3:
            self.attack()
        return py_trees.common.Status.RUNNING

    def attack(self):
"""
BROWSES = """
    import ctypes, gc, os, socket, struct
    from pathlib import Path
    found = []

    def try_(name, attempt):
        try:
            if attempt():
                found.append(name)
        except OSError:
            pass

    kinds = {{type(each).__name__ for each in gc.get_objects()}}
    if kinds & {{"BulletWorld", "Truth", "Referee", "Plan"}}:
        found.append("the world")
    other, hidden = {other}, Path({hidden!r})
    for name in ("cmdline", "environ", "maps", "mem", "status"):
        try_("/proc", lambda: Path(f"/proc/{{other}}/{{name}}").open("rb"))
    libc = ctypes.CDLL(None)
    libc.ptrace.argtypes = [ctypes.c_long] * 4
    if libc.ptrace(16, other, 0, 0) == 0:
        found.append("ptrace")
        os.waitpid(other, 0x40000000)  # until it has stopped
        libc.ptrace(17, other, 0, 0)
    try_("hidden files", lambda: hidden.read_bytes())
    try_("a folder beside", lambda: os.listdir(hidden.parent))
    try_("written files", lambda: (hidden.parent / "left").write_text("here") or True)
    try_("signals", lambda: os.kill(other, 0) is None)
    try_("the network", lambda: socket.create_connection(("127.0.0.1", {port}), 1.0))
    variables = " ".join(os.environ) + " ".join(os.environ.values())
    if "main" in Path.cwd().name or str(hidden.parent.parent) in variables:
        found.append("the environment")
    files = {{path.name for path in Path.cwd().rglob("*")}}
    if files & {{"evaluations", "universes", "main.yaml", "yard.yaml", "judge.py"}}:
        found.append("evaluation files")
    raise RuntimeError("got: " + ", ".join(dict.fromkeys(found)))
"""
WRITES = """
    import os
    line = b'{"seed": 0, "outcome": "success", "why": "forged"}\\n'
    for number in range(3, 64):
        try:
            os.write(number, line * 100)
        except OSError:
            pass
"""
LEAVES = """
    import os
    os._exit(0)
"""
FORKS = """
    import os, signal
    if os.fork() == 0:
        os.setsid()
        signal.alarm(60)
        signal.pause()
    os._exit(3)
"""


def action(attack: str, **values: object) -> str:
    """Returns the source of an action with an attack."""
    return ACTION + indent(dedent(attack.format(**values) if values else attack), "        ")
