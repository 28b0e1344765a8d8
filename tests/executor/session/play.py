"""Tests of the session as plays: events go in, and the test compares the effects."""

from __future__ import annotations

from typing import Any

from msgspec import convert

from executor import child_messages, recorder_messages
from executor.child_messages import FromExact, FromWorld, name_of
from executor.messages import COMMANDS
from executor.replay_messages import FINGERPRINT_BYTES
from executor.session.events import (
    ChildExited,
    ChildSaid,
    ClientJoined,
    CommandCame,
    Effect,
    Event,
    Interrupt,
    Kill,
    Kind,
    Retire,
    Send,
    Spawn,
    Tell,
    TimePassed,
    Unpack,
    Unpacked,
)
from executor.session.ladder import State
from executor.session.protocol import Session
from executor.session.stage import About

UNIVERSE: dict[str, Any] = {"universe": "walled_room", "seed": 1}
APPLICATION: dict[str, Any] = {"app_zip_base64": "eA==", "tick_hz": 20.0}
DATA: dict[str, dict[str, Any]] = {
    "launch_universe": UNIVERSE,
    "run_application": APPLICATION,
    "run": {"universe": UNIVERSE, "application": APPLICATION},
    "run_on": {"app_zip_base64": "eA=="},
    "apply": {"app_zip_base64": "eA=="},
    "set_tick_rate": {"tick_hz": 10.0},
    "set_speed": {"speed": 2.0},
    "set_port": {"node_id": "n1", "path": "Act::1", "port": "gain", "value": "2"},
    "set_blackboard": {"scope": "", "key": "k", "value": 1},
    "set_breakpoints": {"breakpoints": [{"tree_id": "Main", "node_id": "n1"}]},
    "step_to": {"uid": 2, "path": "Act::2"},
    "force": {"uid": 2, "path": "Act::2"},
    "control": {"on": True},
    "profile": {"on": True},
    "serve_groot2": {"port": 1667},
    "dap": {"message": {"seq": 1, "type": "request", "command": "initialize"}},
    "teleop": {"linear": 0.1, "angular": 0.0},
    "move_body": {"id": "crate", "pose": [0, 0, 0, 0, 0, 0]},
    "subscribe": {"stream": "poses"},
    "unsubscribe": {"stream": "poses"},
    "echo_topic": {"topic": "/scan"},
    "publish_topic": {"topic": "/x", "type": "std_msgs/msg/String", "message": {"data": "x"}},
    "describe_type": {"type": "std_msgs/msg/String"},
    "read_recording": {"run": "abc", "segment": 0, "version": 0, "offset": 0, "length": 100},
    "flag": {"text": "here"},
    "evaluate": {"job": "a1", "app_zip_base64": "eA==", "evaluation": "room"},
    "try_values": {"job": "a1", "node_id": "n1", "path": "Act::1", "port": "gain", "values": ["2"]},
    "try_seeds": {"job": "a1", "seeds": [2]},
    "stop_trying": {"job": "a1"},
    "source_of_tick": {"job": "a1", "t": 1.5},
    "stop_source": {"job": "a1"},
    "name_branch": {"run": "abc", "name": "wider"},
    "drop_branch": {"run": "abc"},
    "restart_node": {"id": "launch/extra.launch.yaml:talker"},
}


HELD: dict[str, Any] = {
    "uid": 2,
    "path": [1, 2],
    "why": "breakpoint 1 before its tick",
    "ahead": [2, 3],
    "cause": "breakpoint",
    "event": "before",
    "tick": 7,
}
ANSWERS = {
    child_messages.Pause: "paused",
    child_messages.Resume: "resumed",
    child_messages.StepTick: "stepped",
    child_messages.SetBlackboard: "blackboard_set",
}


def child_message(child: Kind, type_: str, /, **fields: Any) -> Any:
    """Returns a child's message, as its channel would decode it."""
    kinds = FromExact if child in ("application", "trying", "source") else FromWorld
    return convert({"type": type_, **fields}, kinds)


class Play:
    """A session with a driver and well-behaved children by default."""

    def __init__(self, *, driver: str = "d", obedient: bool = True) -> None:
        about = About(version="test", ros_domain_id=41, ros_environment={"ROS_DOMAIN_ID": "41"})
        self.session = Session(about)
        self.now = 0.0
        self.obedient = obedient
        self.effects: list[Effect] = []
        self._requests = 0
        self.happens(ClientJoined(driver))

    @property
    def state(self) -> State:
        return self.session.state

    def happens(self, event: Event) -> list[Effect]:
        """Handles an event, and the answers of obedient children; returns all effects."""
        effects = self.session.handle(event, self.now)
        self.effects += effects
        if self.obedient:
            for effect in list(effects):
                if isinstance(effect, Tell) and effect.kind == "source":
                    continue  # it says only what a test lets it say
                for answer in self.answers(effect):
                    effects += self.happens(answer)
        return effects

    def answers(self, effect: Effect) -> list[Event]:  # noqa: PLR0911 - one line an effect
        """Yields the answers of obedient children and the manager to an effect."""
        if (found := self._answers_of_exact_run(effect)) is not None:
            return found
        match effect:
            case Tell(message=child_messages.StartWorld()):
                return [self._said(effect, "ready", renderer="egl", tf=True, universe="Walled room")]
            case Tell(message=child_messages.StartApplication()):
                return [self._said(effect, "ready")]
            case Tell(kind="application", message=child_messages.Stop()):
                return [ChildExited(effect.kind, effect.number, "ended with exit code 0")]
            case Tell(message=child_messages.Continue(step="continue") as message):
                answers: list[Event] = [self._said(effect, "released", paused=message.pauses)]
                if message.request:
                    answers.append(self._said(effect, "answer", request=message.request))
                return answers
            case Tell(message=recorder_messages.FindKeyframe(t=t_s)):
                frame = recorder_messages.WorldKeyframe(t_s or 9.0, b"as it was", '[["","k","int",3]]')
                reply = self._said(effect, "answer", request=getattr(effect.message, "request", None))
                return [ChildSaid(effect.kind, effect.number, frame), reply]
            case Tell(message=message) if getattr(message, "request", None):
                return [self._said(effect, "answer", request=getattr(message, "request", None))]
            case Tell(kind="application", message=message) if type(message) in ANSWERS:
                return [self._said(effect, ANSWERS[type(message)])]
            case Retire() | Kill():
                return [ChildExited(effect.kind, effect.number, "was killed")]
            case Unpack():
                return [Unpacked(effect.token, "/somewhere")]
            case _:
                return []

    def _answers_of_exact_run(self, effect: Effect) -> list[Event] | None:
        """Returns what an exact run, or the world that it takes over, answers; None to other effects."""
        match effect:
            case Tell(message=child_messages.DumpWorld(request=request)):
                state = self._said(effect, "world_state", data=b"as it is")
                return [state, self._said(effect, "answer", request=request)]
            case Tell(message=child_messages.TakeSnapshot()):
                return [self._said(effect, "no_snapshots", reason="of a test", is_wanted=True)]
            case Tell(message=child_messages.ForWorld(command=command)):
                request = getattr(command, "request", None)
                return [self._said(effect, "answer", request=request)] if request else []
            case Tell(message=child_messages.StartApplication(replay=replay)) if replay is not None:
                t_s = 9.0 if replay.until_s is None else replay.until_s
                ticks = 1 if replay.until_s is not None else len(replay.fingerprints) // FINGERPRINT_BYTES
                inputs = sum(each.tick <= ticks for each in replay.inputs) if replay.until_s is None else 0
                fields = {"t": t_s, "ticks": ticks, "inputs": inputs, "resets": 0, "tick_hz": 20.0}
                return [self._said(effect, "went_back", **fields), self._said(effect, "ready")]
            case Tell(kind="application", message=child_messages.Stop()) if self.session.children.host:
                left = self._said(effect, "world_state", data=b"as it was left")
                return [left, ChildExited(effect.kind, effect.number, "ended with exit code 0")]
            case _:
                return None

    @staticmethod
    def _said(effect: Tell, type_: str, /, **fields: Any) -> ChildSaid:
        return ChildSaid(effect.kind, effect.number, child_message(effect.kind, type_, **fields))

    def command(self, name: str, /, client: str = "d", **data: Any) -> str:
        """Sends a command; returns the id of the request."""
        self._requests += 1
        request = f"r{self._requests}"
        payload = convert(data or DATA.get(name, {}), COMMANDS[name])
        self.happens(CommandCame(client, request, name, payload))
        return request

    def child_says(self, child: Kind, type_: str, /, **fields: Any) -> None:
        number = self.session.children.living[child].number
        self.happens(ChildSaid(child, number, child_message(child, type_, **fields)))

    def child_dies(self, kind: Kind, reason: str = "was killed by SIGKILL", *lines: str) -> None:
        self.happens(ChildExited(kind, self.session.children.living[kind].number, reason, lines))

    def later(self, seconds: float) -> None:
        self.now += seconds
        self.happens(TimePassed())

    def reply(self, request: str) -> str | None:
        """Returns the reply to a request: `ack`, the code of an error, or None."""
        for effect in self.effects:
            if isinstance(effect, Send) and effect.request == request:
                return "ack" if effect.name == "ack" else effect.payload.code  # type: ignore[attr-defined]
        return None

    def sent(self, name: str, client: str | None = None) -> list[Any]:
        """Returns the data of the events of one kind that were sent to all clients, or to one."""
        return [
            e.payload for e in self.effects if isinstance(e, Send) and e.name == name and e.client == client
        ]

    def told(self, kind: Kind) -> list[str]:
        """Returns the types of messages that were sent to a kind of child."""
        return [name_of(e.message) for e in self.effects if isinstance(e, Tell) and e.kind == kind]

    def did(self, effect_type: type[Spawn | Kill | Retire | Interrupt]) -> list[str]:
        """Returns the kinds of children that were spawned, killed, …"""
        return [e.kind for e in self.effects if isinstance(e, effect_type)]

    def climb(self, state: State) -> None:
        """Climbs to a state."""
        way = {
            State.IDLE: [],
            State.CONNECTED: ["connect"],
            State.UNIVERSE_READY: ["connect", "launch_universe"],
            State.VISUALIZATION_READY: ["connect", "launch_universe", "prepare_visualization"],
            State.APPLICATION_RUNNING: ["run"],
            State.PAUSED: ["run", "pause"],
            State.HELD: ["run"],
        }[state]
        for name in way:
            assert self.reply(self.command(name)) == "ack"
        if state is State.HELD:
            self.child_says("application", "held", **HELD)
        assert self.state is state
