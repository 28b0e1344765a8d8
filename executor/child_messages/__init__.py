"""Messages between the manager and its child processes, defined once for both ends.

Each message is a tagged struct; its tag is the field ``type``. A channel decodes one of these unions:

    ToWorld, FromWorld                world process (`executor.world.process`)
    ToApplication, FromApplication    application process (`executor.application.process`)
    ToExact, FromExact                process of an exact run (`executor.exact.process`): both in one
    ToRecorder, FromRecorder          recorder process (`executor.recorder_messages`)

Bytes that are not a message of the union cannot be decoded: the manager ends such a child with a fault that
says why, and a child ends itself. Both ends always have the same version, so nothing is versioned here.
Messages that become events of the session protocol extend the event of the same name (`executor.messages`).

A message with a `request` asks for an answer; the answer repeats that token.

The structs are in a module for each channel; the unions here name them all.
"""

from __future__ import annotations

from typing import Final

import msgspec

from executor.child_messages.application import (
    ApplicationReady,
    Applied,
    ApplyApplication,
    Attached,
    AttachedTree,
    Blackboard,
    BlackboardSet,
    ConnectDebugger,
    Continue,
    Control,
    DebugStep,
    Fault,
    Finished,
    Forced,
    ForceResult,
    Held,
    HeldInPython,
    MeasureNodes,
    Paused,
    PortSet,
    Profile,
    PythonLineWrong,
    Released,
    ReleaseForced,
    Resumed,
    ServeGroot2,
    SetBlackboard,
    SetBreakpoints,
    SetPort,
    SetTickRate,
    StartApplication,
    Stepped,
    StepTick,
    Tick,
    TracePython,
    Tree,
)
from executor.child_messages.common import (
    Answer,
    Asked,
    Beat,
    BeginRecording,
    Log,
    Message,
    Pause,
    Place,
    Resume,
    Starting,
    Stop,
    event_of,
    name_of,
)
from executor.child_messages.exact import (
    Awake,
    Differs,
    Entered,
    Fingerprints,
    ForWorld,
    GoingBack,
    KeepSnapshots,
    NewSeed,
    NoSnapshots,
    SnapshotTaken,
    TakeSnapshot,
    TickSource,
    TryingEnded,
    TryingProgress,
    TryingStarted,
    TryMany,
    TryOutcome,
    WentBack,
)
from executor.child_messages.world import (
    DescribeType,
    DumpWorld,
    EchoTopic,
    ExpectNavigators,
    Failed,
    Frame,
    ListTopics,
    LoadWorld,
    MoveBody,
    Pace,
    Progress,
    PublishTopic,
    Reset,
    SetSpeed,
    Sim,
    StartWorld,
    StepWorld,
    StopRobot,
    Subscribe,
    Teleop,
    TopicMessage,
    TopicMismatch,
    Topics,
    TypeDescription,
    Unsubscribe,
    WorldCommand,
    WorldReady,
    WorldState,
)

__all__ = [
    "Answer",
    "ApplicationReady",
    "Applied",
    "ApplyApplication",
    "Asked",
    "Attached",
    "AttachedTree",
    "Awake",
    "Beat",
    "BeginRecording",
    "Blackboard",
    "BlackboardSet",
    "ConnectDebugger",
    "Continue",
    "Control",
    "DebugStep",
    "DescribeType",
    "Differs",
    "DumpWorld",
    "EchoTopic",
    "Entered",
    "ExpectNavigators",
    "Failed",
    "Fault",
    "Fingerprints",
    "Finished",
    "ForWorld",
    "ForceResult",
    "Forced",
    "Frame",
    "FromApplication",
    "FromExact",
    "FromWorld",
    "GoingBack",
    "Held",
    "HeldInPython",
    "KeepSnapshots",
    "ListTopics",
    "LoadWorld",
    "Log",
    "MeasureNodes",
    "Message",
    "MoveBody",
    "NewSeed",
    "NoSnapshots",
    "Pace",
    "Pause",
    "Paused",
    "Place",
    "PortSet",
    "Profile",
    "Progress",
    "PublishTopic",
    "PythonLineWrong",
    "ReleaseForced",
    "Released",
    "Request",
    "Reset",
    "Resume",
    "Resumed",
    "ServeGroot2",
    "SetBlackboard",
    "SetBreakpoints",
    "SetPort",
    "SetSpeed",
    "SetTickRate",
    "Sim",
    "SnapshotTaken",
    "StartApplication",
    "StartWorld",
    "Starting",
    "StepTick",
    "StepWorld",
    "Stepped",
    "Stop",
    "StopRobot",
    "Subscribe",
    "TakeSnapshot",
    "Teleop",
    "Tick",
    "TickSource",
    "ToApplication",
    "ToExact",
    "ToWorld",
    "TopicMessage",
    "TopicMismatch",
    "Topics",
    "TracePython",
    "Tree",
    "TryMany",
    "TryOutcome",
    "TryingEnded",
    "TryingProgress",
    "TryingStarted",
    "TypeDescription",
    "Unsubscribe",
    "WentBack",
    "WorldCommand",
    "WorldReady",
    "WorldState",
    "decode_from_application",
    "decode_from_exact",
    "decode_from_world",
    "decode_to_application",
    "decode_to_exact",
    "decode_to_world",
    "event_of",
    "name_of",
]

ToWorld = StartWorld | Stop | DumpWorld | LoadWorld | WorldCommand
FromWorld = (
    Beat
    | Log
    | Starting
    | Answer
    | WorldReady
    | Progress
    | Failed
    | Sim
    | TopicMismatch
    | Topics
    | TopicMessage
    | TypeDescription
    | Frame
    | WorldState
)
ToApplication = (
    StartApplication
    | Stop
    | BeginRecording
    | Pause
    | Resume
    | StepTick
    | SetTickRate
    | SetBlackboard
    | SetPort
    | ApplyApplication
    | SetBreakpoints
    | Continue
    | ForceResult
    | ReleaseForced
    | Control
    | MeasureNodes
    | ServeGroot2
    | ConnectDebugger
    | TracePython
)
FromApplication = (
    Beat
    | Log
    | Starting
    | Answer
    | ApplicationReady
    | Paused
    | Resumed
    | Stepped
    | BlackboardSet
    | Tree
    | Tick
    | Blackboard
    | PortSet
    | PythonLineWrong
    | Applied
    | Held
    | HeldInPython
    | Released
    | Forced
    | Attached
    | AttachedTree
    | Profile
    | Fault
    | Finished
)
ToExact = ToApplication | ForWorld | KeepSnapshots | TakeSnapshot | Awake | TryMany
FromExact = (
    FromApplication
    | Failed
    | Sim
    | TopicMismatch
    | Topics
    | TopicMessage
    | TypeDescription
    | Frame
    | WorldState
    | Entered
    | Fingerprints
    | GoingBack
    | Differs
    | WentBack
    | SnapshotTaken
    | NoSnapshots
    | TryingStarted
    | TryingProgress
    | TryOutcome
    | TryingEnded
    | TickSource
)
decode_to_world: Final = msgspec.msgpack.Decoder(ToWorld).decode
decode_from_world: Final = msgspec.msgpack.Decoder(FromWorld).decode
decode_to_application: Final = msgspec.msgpack.Decoder(ToApplication).decode
decode_from_application: Final = msgspec.msgpack.Decoder(FromApplication).decode
decode_to_exact: Final = msgspec.msgpack.Decoder(ToExact).decode
decode_from_exact: Final = msgspec.msgpack.Decoder(FromExact).decode
Request = (
    Pause
    | Resume
    | StepWorld
    | Reset
    | SetSpeed
    | MoveBody
    | DumpWorld
    | LoadWorld
    | ListTopics
    | EchoTopic
    | PublishTopic
    | DescribeType
    | SetTickRate
    | SetPort
    | ApplyApplication
    | SetBreakpoints
    | Continue
    | ForceResult
    | ReleaseForced
    | Control
    | MeasureNodes
    | ServeGroot2
)
"""Messages that a child answers with `Answer`."""
