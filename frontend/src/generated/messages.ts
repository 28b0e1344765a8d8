// Generated from executor/messages.py by `python -m executor.generate.typescript`.
// Do not edit.

export const PROTOCOL = "bt-studio.v1";

export type AttachState = "connecting" | "following" | "silent";

export type NodeStatus = "IDLE" | "RUNNING" | "SUCCESS" | "FAILURE" | "SKIPPED";

export type ResultName = "RUNNING" | "SUCCESS" | "FAILURE" | "SKIPPED";

export type BreakpointMoment = "before" | "after" | "returns" | "halted";

export type ForceEffect = "result" | "skip_to" | "alone";

export type HeldEvent = "before" | "after" | "decided" | "halted";

export type HeldCause = "breakpoint" | "step" | "condition";

export type StreamName = "poses" | "scan" | "camera" | "view";

export type OnFinish = "stop" | "repeat";

export type OnError = "stop" | "failure";

export type RunTime = "exact" | "live";

export type EvaluationEnd = "complete" | "refused" | "failed" | "replaced";

export type TryEnd = "running" | "finished" | "fault" | "refused" | "held" | "died" | "late";

export type TryingEnd = "complete" | "refused" | "failed" | "cancelled";

export type CallEnd = "returned" | "raised" | "open";

export type CallPart = "callback" | "tick";

export type StopReason = "disk_full" | "disk_failed" | "recorder_died" | "recorder_hung";

export type RunResult = "success" | "failure" | "fault" | "collision" | "stopped";

export type LaunchState = "running" | "ended" | "failed";

export type MismatchCode = "type" | "reliability" | "durability" | "qos" | "unpublished" | "elsewhere" | "unserved";

export type PortEffect = "next_tick" | "next_start";

export type State = "idle" | "connected" | "universe_ready" | "visualization_ready" | "application_running" | "paused" | "held";

export type Rung = "connect" | "launch_universe" | "prepare_visualization" | "run_application";

export type LogSource = "action" | "world" | "manager" | "launch";

export type LogLevel = "debug" | "info" | "warning" | "error";

export type Role = "driver" | "viewer";

export type FaultKind = "exception" | "process" | "timeout" | "load";

export type FinishReason = "root_finished" | "action_raised" | "terminated" | "process_died";

/**
 * Replaces the running tree by that of an app zip, between two ticks; world and program continue.
 *
 * The event `applied` comes before the reply. With `dry` it says what would happen, and nothing changes.
 * Refused with `not_applied`, with file and line where they are known, if the new tree or its code cannot be
 * loaded, set up, or take over; the running tree continues. Launch nodes are not restarted.
 */
export interface Apply {
  app_zip_base64: string;
  dry?: boolean;
}

/**
 * Resumes a paused run, with the tree of an app zip if there is one: as `apply`, then `resume`.
 *
 * After `go_back` it is what would have happened with that tree. Refused as `apply` is; then the run stays
 * paused, and its tree is as it was.
 */
export interface RunOn {
  app_zip_base64?: string;
}

/** A node of the tree: its path, and the block of the diagram from which it was made. */
export interface AppliedNode {
  path: string;
  node_id: string;
  tree_id: string;
}

/** A port that keeps its old text: its node continues, and read it before the first tick. */
export interface LatePort {
  path: string;
  node_id: string;
  tree_id: string;
  port: string;
}

/**
 * The running tree was replaced, or would be (`dry`).
 *
 * `kept` is the number of nodes that stay as they are. `renewed` stay with a new object of their changed
 * code. `halted` are those of the old tree that were RUNNING and cannot continue.
 */
export interface Applied {
  dry: boolean;
  kept: number;
  renewed: AppliedNode[];
  added: AppliedNode[];
  removed: AppliedNode[];
  halted: AppliedNode[];
  late_ports: LatePort[];
}

/**
 * Sets whether the user controls the robot whose program this session is attached to.
 *
 * Without it breakpoints have no effect there and nothing is forced. When it ends, all that was set there
 * is removed, and a held tree runs on. Refused with `not_attached` in another session.
 */
export interface Control {
  on: boolean;
}

/**
 * The other program of an attached session, sent each second and at each change.
 *
 * `age_s` is the time since its last answer, or null before the first. `dropped` counts what it sent that
 * could not be read. `controls` tells whether the user controls the robot. `problem` says in words why
 * nothing is shown, or what the program refuses.
 */
export interface Attached {
  address: string;
  state: AttachState;
  age_s: number | null;
  dropped: number;
  controls: boolean;
  problem: string;
}

/**
 * The tree of the other program as diagrams, sent before its event `tree`.
 *
 * `files` are the texts of the diagrams and of `project.json` by path, `actions` the models of its nodes
 * that are not built in, and `xml` the tree in the form in which it can be imported.
 */
export interface AttachedTree {
  name: string;
  main_tree: string;
  files: Record<string, string>;
  actions: Record<string, unknown>[];
  xml: string;
}

/**
 * Allows Groot2, or another client of its protocol on this machine, to look at the tree that runs.
 *
 * It answers at `port` and the next one, also in later runs of the session; with 0 no longer. Refused with
 * `port_taken` while a run cannot have the ports, and with `isolated` where no other program of the machine
 * reaches the session.
 */
export interface ServeGroot2 {
  port?: number;
}

/** The port at which Groot2 can look at the trees of this session; 0 for none. */
export interface Groot2 {
  port: number;
}

/**
 * A breakpoint on a block.
 *
 * `tree_id` is the ID of the block's BehaviorTree, and `node_id` its id in the diagram. `instance` has the
 * ids of the SubTree nodes that lead to one instance, from the main tree on; null stands for all instances.
 * `when` is the moment, and `status` the result for `returns`. `condition` is a script that must be true,
 * and `hits` the first hit that counts. With `log` this line is written in place of a stop.
 */
export interface Breakpoint {
  tree_id: string;
  node_id: string;
  instance: string[] | null;
  when: BreakpointMoment;
  status: ResultName | null;
  condition: string;
  hits: number;
  log: string;
  on: boolean;
}

/**
 * Replaces all breakpoints of the session; they also hold for later runs.
 *
 * With `on` false none has an effect. Refused with `bad_breakpoint` if one cannot be set in the running
 * tree; all are as they were then. A program that is loading or ending, or that does not answer, cannot
 * refuse them: what it does not take then, it names in the log.
 */
export interface SetBreakpoints {
  breakpoints: Breakpoint[];
  on?: boolean;
}

/** Continues until a node is to be ticked. */
export interface StepTo {
  uid: number;
  path: string;
}

/**
 * Forces a result on a node, in place of what was forced on it before.
 *
 * `effect` is `result` for the result `status` in place of its tick (with `after`, of the tick's own
 * result), `skip_to` to skip the siblings before it once, or `alone` to tick it in place of the
 * root. RUNNING freezes the node. `once` is for one tick, else it holds until it is released.
 * Refused with `not_forced`.
 */
export interface Force {
  uid: number;
  path: string;
  effect?: ForceEffect;
  status?: ResultName;
  once?: boolean;
  after?: boolean;
}

/** Ends what is forced on a node; null for all nodes. */
export interface Release {
  uid?: number | null;
}

/**
 * A message of the Debug Adapter Protocol, for breakpoints in Python; both ways, for the driver alone.
 *
 * `message` is a request of the client, or a response or event. Files have their names in the project. A
 * client sends `initialize` once; the session attaches to each program by itself, and `initialized` comes
 * before the code of the program is loaded. The session refuses requests that are not listed
 * (`not_allowed`), files outside of the project (`bad_path`), and more than 1 MiB (`too_large`).
 */
export interface Dap {
  message: Record<string, unknown>;
}

/**
 * The tree is held at a node, within a tick.
 *
 * `path` has the uids from the root to the node `uid`, and `ahead` those that the rules may still tick in
 * this tick: possible ones, not certain ones. `why` is the reason in words, and `cause` its kind. `event` is
 * what happens at the node: `status` is its result, and `decided` the pre-condition that gave it without a
 * tick. `statuses` are those of all nodes that are not IDLE. `hook` counts the stops of the tick, from 0.
 * With `outside` the robot is not held: it belongs to an outside ROS graph.
 */
export interface Held {
  uid: number;
  path: number[];
  why: string;
  ahead: number[];
  cause: HeldCause;
  event: HeldEvent;
  tick: number;
  status: ResultName | null;
  decided: string;
  statuses: [number, ResultName][];
  hook: number;
  outside: boolean;
}

/**
 * The program is held at a line of Python within a tick, of which this is known so far.
 *
 * `path` has the uids from the root to the node `uid`, whose code is held. `statuses` are those of all nodes
 * that are not IDLE. It holds until the state is not `held` any more, or until the next event `tick`, `held`
 * or `held_in_python`.
 */
export interface HeldInPython {
  uid: number;
  path: number[];
  tick: number;
  statuses: [number, NodeStatus][];
}

/**
 * The tree is not held any more.
 *
 * With `off` all breakpoints are off now, as after a hold that lasted too long.
 */
export interface Released {
  off: boolean;
}

/** A result that is forced on a node; `skips_to` is the node to which the skips lead, or 0. */
export interface ForcedNode {
  uid: number;
  status: ResultName;
  once: boolean;
  after: boolean;
  skips_to: number;
}

/** All that is forced now; `alone` is the uid of the node that runs alone, or 0. */
export interface Forced {
  nodes: ForcedNode[];
  alone: number;
}

/**
 * Measures the time of each node from the next tick on, also in later runs, or no longer.
 *
 * With `sample`, the Python code of that leaf of the running tree is sampled too, until the next `profile`;
 * `path` is its path there. Refused with `unknown_node`, or `no_python` if it is no action of the project.
 * The times begin again with each command.
 */
export interface SetProfile {
  on?: boolean;
  sample?: number | null;
  path?: string | null;
}

/**
 * The action in which the present tick has been for more than half a second; empty once it has returned.
 *
 * `text` names the place for people. In an exact run the world waits for the action.
 */
export interface Waiting {
  text: string;
  node_id: string;
  node_path: string;
}

/** The time of one node: how often it was ticked, with the nodes below it and without them, in ms. */
export interface NodeTime {
  uid: number;
  calls: number;
  total_ms: number;
  self_ms: number;
}

/** A stack that was seen in a sampled leaf, the outermost call first, and how often it was seen. */
export interface SampledStack {
  frames: string[];
  samples: number;
}

/**
 * The times since the profile was switched on, or since the run began, of the nodes that were ticked.
 *
 * `ticks` is the number of ticks, and `tick_ms` their whole time in ms. `on` is false in the last one.
 * `sample` is the uid of the leaf that is sampled, `samples` how often it was seen, and `stacks` what was
 * seen most, at most 200 stacks.
 */
export interface Profile {
  on: boolean;
  ticks: number;
  tick_ms: number;
  nodes: NodeTime[];
  sample: number | null;
  samples: number;
  stacks: SampledStack[];
}

/** A command without arguments. */
export type Empty = Record<string, never>;

/**
 * A universe of the project: its YAML text, and the assets that it names.
 *
 * `file` is its name in errors.
 */
export interface UniverseDocument {
  document: string;
  assets_zip_base64?: string;
  file?: string;
}

/**
 * Starts world and robots, paused. `universe` is a built-in id or a document.
 *
 * `none` starts no world: the application joins an outside ROS graph of this machine, in the domain
 * `domain_id`. If that is null, it is the `ROS_DOMAIN_ID` of the server's environment.
 *
 * With the time `exact`, runs are repeatable: world and tree are one process, and time waits for the tree. A
 * run whose time cannot wait is live, and a `log` says why.
 */
export interface LaunchUniverse {
  universe: string | UniverseDocument;
  robot?: string | null;
  seed?: number;
  speed?: number;
  domain_id?: number | null;
  time?: RunTime;
}

/**
 * (Re)starts the application from an app zip and un-pauses the world.
 *
 * `revision` is that of the project, if it is known; the recording names it.
 */
export interface RunApplication {
  app_zip_base64: string;
  tick_hz?: number;
  on_finish?: OnFinish;
  on_error?: OnError;
  revision?: number | null;
}

/** Climbs all rungs of the ladder up to `application_running`. */
export interface Run {
  universe: LaunchUniverse;
  application: RunApplication;
}

/** Sets the number of ticks for each second of simulated time, from the next tick on. */
export interface SetTickRate {
  tick_hz: number;
}

/**
 * Sets the simulated seconds for each second of real time, 0.1 to 10.
 *
 * With 0 it runs as fast as the machine can.
 */
export interface SetSpeed {
  speed: number;
}

/**
 * Writes an entry of the blackboard; `scope` is the path of a SubTree, "" for the root.
 *
 * Only while paused or held.
 */
export interface SetBlackboard {
  scope: string;
  key: string;
  value: unknown;
}

/**
 * Gives a port of a running node another text from the next tick on; null removes its text.
 *
 * The node is the one with the id `node_id` in the diagram at `path`, which names its instance as in the
 * event `tree`. `value` is a text as in the diagram: a literal, or `{key}`. Refused with `port_fixed` if the
 * engine reads the port only when the tree is built, and with `bad_port` if the port does not take the text.
 */
export interface SetPort {
  node_id: string;
  path: string;
  port: string;
  value?: string | null;
}

/** Drives the robot by hand: linear x in m/s, angular z in rad/s. */
export interface Teleop {
  linear: number;
  angular: number;
}

/** Moves a body to a pose [x, y, z, roll, pitch, yaw] in m and rad. Only while paused. */
export interface MoveBody {
  id: string;
  pose: [number, number, number, number, number, number];
}

/** Camera of the server's view of the world: eye and target in m, world frame. */
export interface CameraPose {
  eye: [number, number, number];
  target: [number, number, number];
}

/**
 * Subscribes to a stream on this client's stream socket, or changes a subscription.
 *
 * Each camera is a subscription of its own: `sensor` names it as its `camera` frames do, by the sensor's
 * name, and `robot/sensor` for every robot but the first. "" is the first camera of the world.
 */
export interface Subscribe {
  stream: StreamName;
  max_hz?: number;
  width?: number | null;
  camera_pose?: CameraPose | null;
  sensor?: string;
}

/** Ends a stream; of `camera` that of the same `sensor`. */
export interface Unsubscribe {
  stream: StreamName;
  sensor?: string;
}

/**
 * Sends the latest message of a topic as `topic_message`, at most `max_hz` times a second.
 *
 * 0 ends the echo.
 *
 * If several clients echo a topic, all receive it at the highest of their rates.
 */
export interface EchoTopic {
  topic: string;
  max_hz?: number;
}

/**
 * Publishes one message; `message` holds the fields of `type` (`std_msgs/msg/String`) as JSON.
 *
 * Missing fields get their defaults. `"inf"`, `"-inf"` and `"nan"` stand for the numbers that JSON lacks.
 */
export interface PublishTopic {
  topic: string;
  type: string;
  message: Record<string, unknown>;
}

/** Requests the fields of a message type; this client alone receives a `type_description`. */
export interface DescribeType {
  type: string;
}

/** Restarts a launch node of the project; `id` is its id in the event `launch_nodes`. */
export interface RestartNode {
  id: string;
}

/**
 * Reads a part of a segment: a frame `recording` on this client's stream socket comes before the reply.
 *
 * Refused with `not_recorded` if the segment, or this version of it, is not there any more.
 */
export interface ReadRecording {
  run: string;
  segment: number;
  version: number;
  offset: number;
  length: number;
  branch?: number;
}

/**
 * Sets, changes or removes a flag: a mark of the user in the recording of the present run.
 *
 * `t` is its moment in s; null is the present, or leaves the moment of a flag as it is. `id` names the flag
 * to change, "" sets a new one; an empty `text` removes it. `user` is who sets it, as the client names them;
 * in a session of the web server it is the user who is signed in, whatever the client says.
 * With `run` the command is refused (`not_present`) if another run has begun. Other refusals:
 * `not_recorded`, `unknown_flag`, `no_text`, and `too_many` beyond 200 flags of a run.
 */
export interface Flag {
  text: string;
  t?: number | null;
  id?: string;
  user?: string;
  run?: string;
}

/**
 * Takes world and program of a run back to the moment `t` in s, where they are paused.
 *
 * The moment is that after the first tick that is not earlier; without `t` it is the end of the run. `run`
 * is one of this session in the present world, "" the present or last one. An exact run is made again from
 * its begin, and the events `going_back` say how far it is. The world of a live run goes back to its last
 * recorded state that is not later (they are 5 s apart), and its tree begins again, with the recorded
 * blackboard; a line of the console names the entries that are left empty. What follows is recorded as a run
 * of its own (`branch`). Refused with `no_run`, `unknown_run`, `not_repeatable`, `not_recorded`, or
 * `changed_by_hand` for a moment after which the debugger had changed the program of an exact run.
 */
export interface GoBack {
  run?: string;
  t?: number | null;
}

/**
 * Takes the present exact run back to the begin of its last whole tick, where it is paused.
 *
 * A tick in which the debugger holds the tree is not whole: it is undone, too. What entered before the begin
 * of that tick is done again, the tick is not. What follows is a branch, as for `go_back`; one in which
 * nothing else happened than in its parent is thrown away. Refused with `live_run`, `first_tick` where there
 * is no earlier tick, `not_repeatable`, or `changed_by_hand`.
 */
export type TickBack = Record<string, never>;

/** Gives a branch a name, or none; the event `branch` follows. Refused with `unknown_branch`. */
export interface NameBranch {
  run: string;
  name: string;
}

/**
 * Throws a branch away, with its recording; the event `branch` follows.
 *
 * Refused with `unknown_branch`, or with `present_run` for that of the present.
 */
export interface DropBranch {
  run: string;
}

/** The envelope of a command; `data` is decoded as `COMMANDS[command]`. */
export interface ClientMessage {
  id: string;
  command: string;
  data?: unknown;
}

/**
 * Runs seeds of an evaluation of a project, beside the ladder.
 *
 * A job that already runs continues, and its outcomes so far are sent again; another job ends it.
 *
 * Attributes:
 *     job: a name of the job, chosen by the client.
 *     app_zip_base64: the files of the project.
 *     evaluation: the name of the evaluation.
 *     seeds: the seeds to run; without any, those that the evaluation says.
 *     runs: how many, if not as the evaluation says; 0 is as it says.
 *     known: [seed, outcome] of seeds that are part of the evaluation and need not be run.
 *     record: whether the first of the seeds alone is run, and recorded.
 *     sealed: whether tree and actions run in a process that sees nothing of the judge.
 */
export interface Evaluate {
  job: string;
  app_zip_base64: string;
  evaluation: string;
  seeds?: number[];
  known?: [number, string][];
  runs?: number;
  record?: boolean;
  sealed?: boolean;
}

/**
 * The evaluation was read and checked, and its first run begins.
 *
 * `seed` is the first, and `wanted` the largest number of runs. `plan` has outlines of the world for its
 * report, in m. `duration_s` is how long a run takes at most, in simulated s. `notes` has a line for each
 * part of the project that does not run, such as a launch node.
 */
export interface EvaluationStarted {
  job: string;
  workers: number;
  seed: number;
  wanted: number;
  sequential: boolean;
  duration_s: number;
  plan: Record<string, unknown>;
  notes: string;
}

/**
 * The outcome of one run.
 *
 * Attributes:
 *     line: the line of `runs.jsonl`.
 *     cpu_s: its processor time in s.
 *     rate, low, high: of all outcomes so far, with the 95 % interval.
 *     left_s: the real time that is probably left, in s.
 */
export interface EvaluationOutcome {
  job: string;
  seed: number;
  line: string;
  cpu_s: number;
  done: number;
  wanted: number;
  rate: number;
  low: number;
  high: number;
  left_s: number;
}

/**
 * A job has ended.
 *
 * Attributes:
 *     wanted: how many of the seeds belong to the evaluation; with `until` these may be fewer than asked.
 *     message: why it was refused or failed, a line for each problem.
 *     run: the name of the recording; "" without one.
 */
export interface EvaluationEnded {
  job: string;
  end: EvaluationEnd;
  wanted: number;
  message: string;
  run: string;
}

/**
 * Continues a run from a moment under several values of a port, beside the ladder.
 *
 * Nothing of it happens in the world of the session. The run is made again up to the moment `t` in s as by
 * `go_back`, then continued for `duration_s` once as it is (index 0), and once with each of `values`. Each
 * value is what `set_port` would take; null removes the text. One job runs at a time; another one ends it.
 *
 * Refused with `no_run`, `unknown_run`, `not_repeatable`, with `live_run` for a live run, or with
 * `changed_by_hand` for a moment after which the debugger had changed the program.
 */
export interface TryValues {
  job: string;
  node_id: string;
  path: string;
  port: string;
  values: (string | null)[];
  duration_s?: number;
  run?: string;
  t?: number | null;
}

/**
 * Continues a run from a moment under several seeds, beside the ladder.
 *
 * As `try_values`, but what differs from the moment on are random numbers: the noise of sensors and wheels,
 * and `random` and `numpy.random` in actions. What the universe drew at its begin stays. The seed with which
 * the run began changes nothing: its continuation is the run as it is.
 */
export interface TrySeeds {
  job: string;
  seeds: number[];
  duration_s?: number;
  run?: string;
  t?: number | null;
}

/** Ends a job of `try_values` or `try_seeds`, if it runs; what is known of it stays with the client. */
export interface StopTrying {
  job: string;
}

/**
 * The run is back at the moment, and its continuations begin.
 *
 * Attributes:
 *     t: the moment in s.
 *     at_once: how many run at the same time.
 *     outlines: the corners [x, y] in m of what stands in the world at the moment.
 */
export interface TryingStarted {
  job: string;
  t: number;
  at_once: number;
  outlines: [number, number][][];
}

/** The share of a job that is done, 0 to 1; `stage` is `going_back`, or `continuing`. */
export interface TryingProgress {
  job: string;
  stage: "continuing" | "going_back";
  fraction: number;
}

/** The begin of a collision of a robot: its time in s, its place in m, and what it hit. */
export interface Crash {
  t: number;
  x: number;
  y: number;
  body: string;
  robot: string;
}

/**
 * The outcome of one continuation.
 *
 * Attributes:
 *     index: 0 for the run as it is; n for the n-th value or seed.
 *     end: how it ended; `running` if it still ran when its time was over, `refused` if the port does not
 *         take the value, `held` if the debugger would hold it, `late` if a tick did not return.
 *     message: why, for all ends but `running`.
 *     t: the simulated time of the end in s.
 *     ticks: the number of ticks.
 *     root: the last result of the tree.
 *     nodes: the paths of the leaves that were RUNNING at the end.
 *     distance_m: how far the first robot drove.
 *     collisions: the number of collisions of all robots.
 *     crash: the first of them.
 *     paths: by robot, where it was: [time in s, x, y in m].
 *     fingerprint: equal for continuations that did the same in each tick.
 *     as_before: whether each tick was as in the recorded run, as far as that went; None if it ended there.
 */
export interface TryOutcome {
  job: string;
  index: number;
  end: TryEnd;
  message: string;
  t: number;
  ticks: number;
  root: string;
  nodes: string[];
  distance_m: number;
  collisions: number;
  crash: Crash | null;
  paths: Record<string, [number, number, number][]>;
  fingerprint: string;
  as_before: boolean | null;
}

/** A job has ended; `message` says why it was refused or failed. */
export interface TryingEnded {
  job: string;
  end: TryingEnd;
  message: string;
}

/**
 * Makes a run again up to a past tick, and says which lines of the project's Python this tick ran.
 *
 * Nothing of it happens in the world of the session: a process of its own makes the run again as for
 * `go_back`, and is ended. The tick is the first that is not earlier than `t` in s; the callbacks of ROS
 * that ran just before it belong to it. One job runs at a time; another one ends it.
 *
 * Refused with `no_run`, `unknown_run`, `not_repeatable`, `live_run` for a live run, or `changed_by_hand`
 * for a tick after the debugger has changed the program.
 */
export interface SourceOfTick {
  job: string;
  t: number;
  run?: string;
}

/** Ends a job of `source_of_tick`, if it runs. */
export interface StopSource {
  job: string;
}

/** The share of the way to the tick, 0 to 1. */
export interface SourceProgress {
  job: string;
  fraction: number;
}

/** A name and the beginning of its value as text; a field has the name `self.field`. */
export interface SourceValue {
  name: string;
  text: string;
}

/**
 * A line that ran in a call.
 *
 * Attributes:
 *     line: its number in the file, from 1.
 *     times: how often it ran.
 *     values: what had another value after it ran, as it was after the last time.
 */
export interface SourceLine {
  line: number;
  times: number;
  values: SourceValue[];
}

/**
 * A call of a function of the project: of an action, or of a module that actions import.
 *
 * Attributes:
 *     file: the file in the project.
 *     function: the name of the function with that of its class.
 *     line: the line in which it begins.
 *     uid: the node whose action called; 0 if it is none.
 *     path: the path of this node.
 *     part: `callback` if ROS called it before the tick.
 *     end: how it ended; a generator that yields has returned. `open` if it was not followed to its end.
 *     result: what it returned, or the exception.
 *     lines: the lines that ran, in the order of the file.
 *     locals: its local variables at the end.
 *     fields: the fields of `self` at the end.
 */
export interface SourceCall {
  file: string;
  function: string;
  line: number;
  uid: number;
  path: string;
  part: CallPart;
  end: CallEnd;
  result: string;
  lines: SourceLine[];
  locals: SourceValue[];
  fields: SourceValue[];
}

/**
 * The end of a job of `source_of_tick`: what the code of the project did in the tick.
 *
 * Attributes:
 *     t: the time of the tick in s.
 *     tick: the number of the tick in the run.
 *     calls: the calls, in the order in which they began.
 *     files: the text of each file with a call, as it ran; a file that is too long is left out.
 *     left_out: the number of calls that are not in `calls`, since there were too many.
 *     is_cut: whether so much happened that lines and values are missing.
 *     differs: the tick from which the run that was made again differs from the recorded one; None if none.
 *     problem: why nothing can be shown; "" if something can.
 */
export interface TickSource {
  job: string;
  t: number;
  tick: number;
  calls: SourceCall[];
  files: Record<string, string>;
  left_out: number;
  is_cut: boolean;
  differs: number | null;
  problem: string;
}

/**
 * A part of the recording of a run: 20 s of simulated time, and an MCAP file by itself.
 *
 * It is sent again each second while it grows: `bytes` of it can be read then. `complete` tells that it has
 * its end. A new `version` replaces it when old pictures were removed; with 0 `bytes` it is gone.
 * `run_number` counts the runs of the session from 1, and stays with a run when others are thrown away.
 * `result` says how the run ended, once it has: by the status of the root, by a fault, or stopped by the
 * user; one that is stopped after its robot bumped into something ended by that `collision`.
 */
export interface Segment {
  run: string;
  branch: number;
  number: number;
  version: number;
  from_t: number;
  to_t: number;
  bytes: number;
  complete: boolean;
  run_number: number;
  result: RunResult | null;
}

/** A flag of the user was set or changed in a run, at a moment in s; with an empty `text` it is gone. */
export interface FlagSet {
  run: string;
  id: string;
  t: number;
  text: string;
  user: string;
}

/**
 * The recording of a run stopped at a simulated time in s; the run itself continues.
 *
 * What happens from then on is missing: until another recorder has started if it `goes_on`, else to the end
 * of the run. `detail` is the cause as the system tells it.
 */
export interface RecordingStopped {
  run: string;
  t: number;
  reason: StopReason;
  detail: string;
  goes_on: boolean;
}

/**
 * A run continues another one: `run` is as `parent` was up to the moment `from_t` in s.
 *
 * It is sent again when the branch gets a `name`, and when it was thrown away (`is_gone`).
 */
export interface Branch {
  run: string;
  parent: string;
  from_t: number;
  name: string;
  is_gone: boolean;
}

/**
 * The runs of this session in which one can go back, the present or last one at the end.
 *
 * Of those that are `live`, the world goes back to a recorded state, and the tree begins again there. In
 * those of `by_hand` the Python debugger has changed the program, at a moment in s: one can go back only to
 * an earlier one.
 */
export interface RepeatableRuns {
  runs: string[];
  live: string[];
  by_hand: Record<string, number>;
}

/** A run is made again up to a moment; `fraction` is 0 to 1, and 1 also where that failed. */
export interface GoingBack {
  fraction: number;
}

/**
 * A run that is made again differs from the first time, from a tick on, at a simulated time `t` in s.
 *
 * `cause` names what may not be repeatable in the program.
 */
export interface Differs {
  tick: number;
  t: number;
  cause: string;
}

/**
 * One ROS topic: its rate over the last two seconds, and the nodes at both of its ends.
 *
 * `hz` and `bytes_per_s` are null without a measurement: images and point clouds are measured only while a
 * client echoes them, and the first `list_topics` after a while starts the measurement. `types` holds all
 * types of the topic; several only if a robot accepts several types on its command topic.
 */
export interface TopicInfo {
  name: string;
  type: string;
  hz: number | null;
  bytes_per_s: number | null;
  publishers: string[];
  subscribers: string[];
  types: string[];
}

/** The topics of the session's ROS graph. */
export interface Topics {
  topics: TopicInfo[];
}

/**
 * One message of a topic that a client echoes.
 *
 * Numbers that JSON lacks (infinite, not a number) are null. Long arrays and texts are shortened: `cut`
 * names them by their path (`ranges`, `pose.covariance`) with their true length. `bytes` is the size of the
 * message on the wire.
 */
export interface TopicMessage {
  topic: string;
  type: string;
  message: Record<string, unknown>;
  bytes: number;
  cut: Record<string, number>;
}

/** A message type: its fields (`{"linear": "geometry_msgs/Vector3"}`) and a message with defaults. */
export interface TypeDescription {
  type: string;
  fields: Record<string, string>;
  example: Record<string, unknown>;
}

/**
 * Two ends of a topic do not match, or one is missing: no message arrives. Reported once while it is so.
 *
 * `publisher` and `subscriber` are names of ROS nodes. `reason` is the difference: message type or quality
 * of service; or `nobody`, if nobody publishes the topic (then `publisher` is empty), or serves the service
 * or action whose client `subscriber` is. `code` names it exactly, and `values` holds what `message` tells
 * except the names. `hint` says how to fix it. With `resolved`, what was reported is so no more.
 */
export interface TopicMismatch {
  topic: string;
  publisher: string;
  subscriber: string;
  reason: "nobody" | "qos" | "type";
  message: string;
  hint: string;
  code: MismatchCode;
  values: Record<string, string>;
  resolved: boolean;
}

/**
 * A process of the project's launch files; `file` and `line` are its place there.
 *
 * `end` is the exit code or the signal with which it ended, or the reason why it could not be started.
 */
export interface LaunchNode {
  id: string;
  name: string;
  package: string;
  executable: string;
  file: string;
  line: number;
  state: LaunchState;
  restarts: number;
  end: string;
}

/** All launch nodes of the application, sent when one of them changes. */
export interface LaunchNodes {
  nodes: LaunchNode[];
}

/** One node of the running tree. `node_id` is its id in the diagram, `tree_id` the id of that diagram. */
export interface TreeNode {
  uid: number;
  parent: number;
  type: string;
  kind: string;
  name: string;
  path: string;
  node_id: string;
  tree_id: string;
}

/** The running tree, in pre-order; subtrees are expanded in place. */
export interface Tree {
  nodes: TreeNode[];
}

/**
 * The changes of one tick, or of a halt after it; a halt has the number `n` of that tick.
 *
 * `past` holds the nodes that are idle again, with their last status in the tick; it replaces the `past` of
 * the previous message. `forced` holds the uids of the nodes whose result in the tick was forced.
 */
export interface Tick {
  n: number;
  changed: [number, NodeStatus][];
  flashed: [number, NodeStatus][];
  duration_ms: number;
  past: [number, NodeStatus][];
  forced: number[];
}

/** One changed entry; a large value is sent as a preview (text), and `preview` is then true. */
export interface BlackboardEntry {
  scope: string;
  key: string;
  type: string;
  value: unknown;
  preview: boolean;
  removed: boolean;
}

/** Entries that changed since the previous message of this kind. */
export interface Blackboard {
  entries: BlackboardEntry[];
}

/**
 * A port of a node of the running tree was given another text.
 *
 * `saved` is the text with which the tree was built; null stands for none. `effect` says when the node uses
 * the new text: from the next tick on, or, because its action read the port only before the first tick, when
 * the program starts again.
 */
export interface PortSet {
  node_id: string;
  tree_id: string;
  path: string;
  port: string;
  value: string | null;
  saved: string | null;
  effect: PortEffect;
}

/** The command was done. */
export type Ack = Record<string, never>;

/** The command was refused or failed; it changed nothing. */
export interface Error {
  code: string;
  message: string;
  hint: string;
}

/**
 * First message on a connection, sent again when the client's role or the properties of the world change.
 *
 * `renderer` and `tf` describe the running world: "" and false before it is ready.
 *
 * `client_id` names this client when it opens the stream socket.
 *
 * A ROS program on the session's host joins the session's graph with the variables of `ros_environment`;
 * they are empty if the session is isolated.
 */
export interface Introspection {
  protocol: string;
  client_id: string;
  role: Role;
  state: State;
  version: string;
  ros_distro: string;
  ros_domain_id: number;
  renderer: string;
  tf: boolean;
  ros_environment: Record<string, string>;
}

/**
 * The session entered another state of the ladder.
 *
 * `reason` is for users, and empty if a command caused it.
 */
export interface StateChanged {
  state: State;
  reason: string;
}

/** Progress of a long step: the fraction of this rung, 0 to 1, and a sentence. */
export interface Progress {
  rung: Rung;
  fraction: number;
  message: string;
}

/**
 * The session waits for a place on the server, which sends this in place of the manager.
 *
 * `before` is the number of robots that get a place before this one, null as soon as it has one; with
 * `is_own` it waits until another robot of the same user ends.
 */
export interface Queued {
  before: number | null;
  is_own: boolean;
}

/** One line of output. */
export interface Log {
  source: LogSource;
  level: LogLevel;
  text: string;
  node_id: string;
  node_path: string;
  time: number;
  launch_node: string;
}

/** A run-time error: an exception in an action, or a process that ended or hangs. */
export interface Fault {
  kind: FaultKind;
  message: string;
  hint: string;
  node_id: string;
  tree_id: string;
  node_path: string;
  file: string;
  line: number;
  traceback: string;
}

/** The run ended. If the root returned a status, the node is the lowest one that decided it. */
export interface Finished {
  status: NodeStatus;
  reason: FinishReason;
  message: string;
  node_id: string;
  tree_id: string;
  node_path: string;
}

/** The load of the simulation, about once a second. */
export interface Sim {
  real_time_factor: number;
  speed: number;
  paused: boolean;
  tick_ms: number;
  tick_budget_ms: number;
  collisions: number;
  distance_m: number;
  pose: [number, number, number];
  camera_share: number;
  hits: number;
}

/** The full state for a client that joins late; later events change it. */
export interface Snapshot {
  state: State;
  tree: Tree | null;
  statuses: [number, NodeStatus][];
  blackboard: BlackboardEntry[];
  logs: Log[];
  faults: Fault[];
  tick_hz: number;
  speed: number;
  universe: string;
  launch_nodes: LaunchNode[];
  mismatches: TopicMismatch[];
  past: [number, NodeStatus][];
  finished: Finished | null;
  ports: PortSet[];
  runs: number;
  run_starts: [number, number][];
  hanging_s: number;
  segments: Segment[];
  flags: FlagSet[];
  stops: RecordingStopped[];
  branches: Branch[];
  repeatable_runs: string[];
  live_runs: string[];
  runs_by_hand: Record<string, number>;
  held: Held | null;
  held_in_python: HeldInPython | null;
  forced: Forced | null;
  attached: Attached | null;
  attached_tree: AttachedTree | null;
  profile: Profile | null;
  groot2: Groot2 | null;
  waiting: Waiting;
}

/** The envelope of an event. */
export interface ServerMessage {
  id: string;
  command: string;
  data: unknown;
  seq: number;
  t: number;
  tick?: number;
}

/**
 * A visual shape in its object's frame.
 *
 * Args:
 *     shape: the kind of shape; its `size` in m is [x, y, z] for a box, [radius, length] for a cylinder or a
 *         capsule along z, [radius] for a sphere, [x, y] for a plane, [sx, sy, sz] (scale) for a mesh.
 *     pose: [x, y, z, qx, qy, qz, qw] in the object's frame.
 *     color: [r, g, b, a], each 0 to 1, sRGB.
 *     mesh: key in `Scene.meshes` for a mesh, else "".
 *     texture: key in `Scene.textures`, or "" for none; the colour tints it.
 *     ceiling: whether the shape is a ceiling or the upper part of a wall, which only robots' cameras see.
 */
export interface Shape {
  shape: "box" | "capsule" | "cylinder" | "mesh" | "plane" | "sphere";
  size: number[];
  pose: number[];
  color: number[];
  mesh?: string;
  texture?: string;
  ceiling?: boolean;
}

/** One rigid object: a body, or a link of a robot; `pose` is [x, y, z, qx, qy, qz, qw]. */
export interface SceneObject {
  id: number;
  body: string;
  link: string;
  kind: "actor" | "dynamic" | "robot" | "static";
  shapes: Shape[];
  pose: number[];
}

/**
 * The triangles of a mesh.
 *
 * Positions and normals are little-endian float32 (3 for each vertex), indices are uint32.
 *
 * `uvs` are the texture coordinates of the file, if it has any: two float32 for each vertex; v points up.
 */
export interface Mesh {
  positions: Uint8Array;
  normals: Uint8Array;
  indices: Uint8Array;
  uvs?: Uint8Array;
}

/**
 * An image that is repeated: a JPEG file, and the width and height of one repetition in m.
 *
 * `executor/render/mapping.py` maps it to shapes; a mesh with `uvs` uses these coordinates, and the size is
 * not used.
 */
export interface Texture {
  jpeg: Uint8Array;
  tile: number[];
}

/** A directional light, with the direction of its rays. */
export interface Light {
  direction: number[];
  intensity: number;
}

/** Pose of a sensor in the frame of object `object_id`; `fov` is horizontal, in rad. */
export interface SensorPlacement {
  name: string;
  kind: "camera" | "lidar";
  object_id: number;
  pose: number[];
  fov: number;
  range: number;
}

/** The world, sent once to each client and again when it changes. */
export interface Scene {
  type: "scene";
  name: string;
  t: number;
  objects: SceneObject[];
  meshes: Record<string, Mesh>;
  lights: Light[];
  ground_color: number[];
  sensors: SensorPlacement[];
  textures?: Record<string, Texture>;
  ground_texture?: string;
}

/**
 * The poses that changed: `ids` as little-endian uint16, and in `poses` 16 bytes for each id.
 *
 * Of these 16 bytes, bytes 0-8 are x, y, z as int24 in 0.1 mm; byte 9 is the index of the omitted one of qx,
 * qy, qz, qw (the largest, made positive); bytes 10-15 are the others as int16 in 1/(32767 * sqrt(2)).
 * Little-endian.
 */
export interface Poses {
  type: "poses";
  t: number;
  ids: Uint8Array;
  poses: Uint8Array;
}

/** One LIDAR scan: ranges as float32 in m, counter-clockwise, and the pose of the sensor in the world. */
export interface Scan {
  type: "scan";
  t: number;
  sensor: string;
  pose: number[];
  angle_min: number;
  angle_increment: number;
  range_max: number;
  ranges: Uint8Array;
}

/**
 * One JPEG image of a robot's camera.
 *
 * `sensor` is the name of the sensor; for robots other than the first it is `robot/sensor`.
 */
export interface Camera {
  type: "camera";
  t: number;
  sensor: string;
  width: number;
  height: number;
  jpeg: Uint8Array;
}

/** One JPEG frame of the stream `view`: the world, drawn by the server. */
export interface View {
  type: "view";
  t: number;
  width: number;
  height: number;
  jpeg: Uint8Array;
}

/** A part of a segment of a recording, as `read_recording` asked for it. */
export interface RecordingPart {
  type: "recording";
  run: string;
  branch: number;
  segment: number;
  version: number;
  offset: number;
  data: Uint8Array;
}

/** Payload by `command`. */
export interface Commands {
  dap: Dap;
  connect: Empty;
  launch_universe: LaunchUniverse;
  prepare_visualization: Empty;
  run_application: RunApplication;
  apply: Apply;
  run: Run;
  pause: Empty;
  resume: Empty;
  step: Empty;
  go_back: GoBack;
  tick_back: TickBack;
  run_on: RunOn;
  branches: Empty;
  name_branch: NameBranch;
  drop_branch: DropBranch;
  cancel: Empty;
  set_tick_rate: SetTickRate;
  set_speed: SetSpeed;
  restart_application: Empty;
  reset_world: Empty;
  run_world: Empty;
  terminate_application: Empty;
  terminate_visualization: Empty;
  terminate_universe: Empty;
  disconnect: Empty;
  set_blackboard: SetBlackboard;
  set_port: SetPort;
  set_breakpoints: SetBreakpoints;
  continue_run: Empty;
  step_into: Empty;
  step_over: Empty;
  step_out: Empty;
  step_to: StepTo;
  force: Force;
  release: Release;
  control: Control;
  profile: SetProfile;
  serve_groot2: ServeGroot2;
  teleop: Teleop;
  move_body: MoveBody;
  subscribe: Subscribe;
  unsubscribe: Unsubscribe;
  list_topics: Empty;
  echo_topic: EchoTopic;
  publish_topic: PublishTopic;
  describe_type: DescribeType;
  restart_node: RestartNode;
  read_recording: ReadRecording;
  flag: Flag;
  evaluate: Evaluate;
  try_values: TryValues;
  try_seeds: TrySeeds;
  stop_trying: StopTrying;
  source_of_tick: SourceOfTick;
  stop_source: StopSource;
  take_over: Empty;
  ping: Empty;
}

/** Payload by `command`. */
export interface Events {
  ack: Ack;
  error: Error;
  introspection: Introspection;
  "state-changed": StateChanged;
  snapshot: Snapshot;
  progress: Progress;
  queued: Queued;
  tree: Tree;
  tick: Tick;
  blackboard: Blackboard;
  port_set: PortSet;
  applied: Applied;
  log: Log;
  fault: Fault;
  finished: Finished;
  sim: Sim;
  topics: Topics;
  topic_message: TopicMessage;
  type_description: TypeDescription;
  topic_mismatch: TopicMismatch;
  launch_nodes: LaunchNodes;
  segment: Segment;
  flag: FlagSet;
  recording_stopped: RecordingStopped;
  branch: Branch;
  repeatable_runs: RepeatableRuns;
  going_back: GoingBack;
  differs: Differs;
  held: Held;
  held_in_python: HeldInPython;
  released: Released;
  forced: Forced;
  attached: Attached;
  attached_tree: AttachedTree;
  profile: Profile;
  groot2: Groot2;
  waiting: Waiting;
  dap: Dap;
  evaluation_started: EvaluationStarted;
  evaluation_outcome: EvaluationOutcome;
  evaluation_ended: EvaluationEnded;
  trying_started: TryingStarted;
  trying_progress: TryingProgress;
  try_outcome: TryOutcome;
  trying_ended: TryingEnded;
  source_progress: SourceProgress;
  tick_source: TickSource;
}

/** What the stream socket sends, told by `type`. */
export type Frame = Scene | Poses | Scan | Camera | View | RecordingPart;
