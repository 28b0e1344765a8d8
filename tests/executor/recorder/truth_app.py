"""Random applications that print, write values of all kinds, drive, raise, and observe themselves."""

from __future__ import annotations

import json
import random
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from tests.tree_gardener.testing.random_trees import random_tree

UNIVERSES = ("walled_room", "football", "narrow_passages", "random_obstacles", "line", "crowd")
ACT = """
import random
import sys
import py_trees
from geometry_msgs.msg import Twist
from tree_gardener.ports import Port, set_output
from TruthObserver import TruthObserver

RAISES = 0.01
STATUS = py_trees.common.Status
WEIRD = {"lists": [1, [2, {"three": None}]], "text": "ö ✓ \\" \\\\ \\n", "": False}
CHOICES = (
    lambda: random.randrange(-1000, 1000), lambda: random.uniform(-1e3, 1e3),
    lambda: random.choice("äbc") * 3,
    lambda: [random.random() for _ in range(random.randrange(5))],
    lambda: dict(WEIRD, n=random.random()),
    lambda: "x" * random.choice((10, 4094, 4095, 9000)), lambda: {"preview": "no preview"}, Twist,
    lambda: float("nan"), lambda: None, lambda: True, lambda: (1, 2.5), lambda: {1: 2}, lambda: {3},
)


class Act(py_trees.behaviour.Behaviour):
    OUTPUT_PORTS = {"value": Port(object)}
    INPUT_PORTS = {"text": Port(str, default="")}
    RESULTS = (STATUS.SUCCESS, STATUS.FAILURE, STATUS.RUNNING)
    mine = None

    def setup(self, **kwargs):
        self.node = kwargs["node"]
        self.publisher = self.node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        chance = random.random()
        if chance < 0.3:
            self.mine = random.choice(CHOICES)()
            set_output(self, "value", self.mine)
        elif chance < 0.4 and type(self.mine) is list and len(self.mine) < 50:
            self.mine.append(len(self.mine))
        if random.random() < 0.1:
            text = random.choice(("one line", "two\\nlines", "", "ünicode ✓", "  spaces  ", "long " * 300))
            out = random.choice((sys.stdout, sys.stderr))
            TruthObserver.note(
                "print", t=self.node.get_clock().now().nanoseconds * 1e-9, text=text, error=out is sys.stderr)
            print(text, file=out)
        if random.random() < 0.2:
            twist = Twist()
            twist.linear.x, twist.angular.z = random.uniform(-0.3, 0.5), random.uniform(-1.5, 1.5)
            self.publisher.publish(twist)
        if random.random() < RAISES:
            TruthObserver.note("raise")
            raise ValueError("on purpose")
        return random.choice(self.RESULTS)
"""
CHECK = """
from Act import Act, STATUS

class Check(Act):
    NODE_KIND = "Condition"
    RESULTS = (STATUS.SUCCESS, STATUS.FAILURE)
"""


def random_app(seed: int, notes: Path, *, raises: bool = True) -> dict[str, bytes]:
    """Returns the files of an application with one random tree; its observer writes to a file."""
    chance = random.Random(seed)  # noqa: S311 - a reproducible tree, no secret
    body = random_tree(chance, size=chance.choice((6, 12, 25)))
    script = "s := s + 1; half := s / 2.0; word := 'a'"
    inner = random_tree(chance, size=5).replace("{v1}", "{out}")
    parts = [
        f"<RunOnce><Script code={quoteattr('s := 0')}/></RunOnce>",
        f"<Script code={quoteattr(script)}/>",
        f"<ForceSuccess>{body}</ForceSuccess>",
        '<SetBlackboard value="{half}" output_key="copy"/>',
        '<ForceSuccess><SubTree ID="Inner" out="{from_inner}"/></ForceSuccess>',
    ]
    if chance.random() < 0.5:
        parts.append('<UnsetBlackboard key="copy"/>')
    tree = (
        '<root BTCPP_format="4" main_tree_to_execute="Main"><BehaviorTree ID="Main"><ReactiveSequence>'
        f"<TruthObserver/><Sequence>{''.join(parts)}</Sequence></ReactiveSequence></BehaviorTree>"
        f'<BehaviorTree ID="Inner">{inner}</BehaviorTree>'
    )
    source = Path(__file__).with_name("truth_observer.py").read_text(encoding="utf-8")
    source = source.replace('PLACE = "/dev/null"', f"PLACE = {str(notes)!r}")
    source = source.replace("HEARS_SCANS = False", f"HEARS_SCANS = {seed % 4 != 0}")
    settings = {"format": "bt-studio/project", "version": 1, "name": f"truth {seed}"}
    settings |= {"universe": chance.choice(UNIVERSES), "tick_hz": chance.choice((5, 20, 30))}
    actions = {
        "Act": ACT if raises else ACT.replace("RAISES = 0.01", "RAISES = 0.0"),
        "Check": CHECK,
        "TruthObserver": source,
    }
    code = "".join(f'<Action name="{name}">{escape(text)}</Action>' for name, text in actions.items())
    files = {f"actions/{name}.py": text.encode() for name, text in actions.items()}
    files["project.json"] = json.dumps(settings).encode()
    files["self_contained_tree.xml"] = f"{tree}<Code>{code}</Code></root>".encode()
    return files
