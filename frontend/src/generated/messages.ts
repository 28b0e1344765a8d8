// Generated from executor/messages.py by `python -m executor.generate.typescript`.
// Do not edit.

export const PROTOCOL = "bt-studio.v1";

export type StreamName = "poses" | "scan" | "camera" | "view";

export type OnFinish = "stop" | "repeat";

export type OnError = "stop" | "failure";

export type State = "idle" | "connected" | "universe_ready" | "visualization_ready" | "application_running" | "paused";

export type Rung = "connect" | "launch_universe" | "prepare_visualization" | "run_application";

export type NodeStatus = "IDLE" | "RUNNING" | "SUCCESS" | "FAILURE" | "SKIPPED";

export type LogSource = "action" | "world" | "manager" | "launch";

export type LogLevel = "debug" | "info" | "warning" | "error";

export type Role = "driver" | "viewer";

export type LaunchState = "running" | "ended" | "failed";

export type FaultKind = "exception" | "process" | "timeout" | "load";

export type FinishReason = "root_finished" | "action_raised" | "terminated" | "process_died";

/** A command without arguments. */
export type Empty = Record<string, never>;

/** A universe of the project: its YAML text and the assets that it names; errors name `file`. */
export interface UniverseDocument {
  document: string;
  assets_zip_base64?: string;
  file?: string;
}

/**
 * Starts world and robots, paused. `universe` is a built-in id or a document.
 *
 * `none` starts no world: the application runs against an outside ROS graph of this machine, in the domain
 * `domain_id`; null is the `ROS_DOMAIN_ID` with which the server was started.
 */
export interface LaunchUniverse {
  universe: string | UniverseDocument;
  robot?: string | null;
  seed?: number;
  speed?: number;
  domain_id?: number | null;
}

/** (Re)starts the application from an app zip and un-pauses the world. */
export interface RunApplication {
  app_zip_base64: string;
  tick_hz?: number;
  on_finish?: OnFinish;
  on_error?: OnError;
}

/** Climbs all missing rungs of the ladder up to `application_running`. */
export interface Run {
  universe: LaunchUniverse;
  application: RunApplication;
}

/** Ticks a second of simulated time, from the next tick on. */
export interface SetTickRate {
  tick_hz: number;
}

/** Simulated seconds a second of real time, 0.1 to 10; 0 runs as fast as the machine can. */
export interface SetSpeed {
  speed: number;
}

/** Writes an entry; `scope` is the path of a subtree, "" the root. Only while paused. */
export interface SetBlackboard {
  scope: string;
  key: string;
  value: unknown;
}

/** Drives the robot by hand: linear x in m/s, angular z in rad/s. */
export interface Teleop {
  linear: number;
  angular: number;
}

/** Puts a body somewhere: pose [x, y, z, roll, pitch, yaw] in m and rad. Only while paused. */
export interface MoveBody {
  id: string;
  pose: [number, number, number, number, number, number];
}

/** Camera of the server's own view: eye and target in m, world frame. */
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
 * Sends the latest message of a topic as `topic_message`, at most `max_hz`; 0 ends it.
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
 * Missing fields keep their defaults. `"inf"`, `"-inf"` and `"nan"` stand for the numbers that JSON lacks.
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

/** Restarts a node of the project's launch files; `id` as in `launch_nodes`. */
export interface RestartNode {
  id: string;
}

/** The envelope of a command; `data` is decoded as `COMMANDS[command]`. */
export interface ClientMessage {
  id: string;
  command: string;
  data?: unknown;
}

/** The command was done. */
export type Ack = Record<string, never>;

/** The command was refused or failed; nothing else changed. */
export interface Error {
  code: string;
  message: string;
  hint: string;
}

/**
 * First message on a connection, sent again when the client's role or what the world can do changes.
 *
 * `renderer` and `tf` describe the running world: "" and false before it is ready.
 *
 * `client_id` names this client when it opens the stream socket.
 *
 * With the variables of `ros_environment` a ROS program on the session's host joins its graph; empty if the
 * session is isolated.
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

/** The state of the ladder changed; `reason` is for users, empty if a command asked for it. */
export interface StateChanged {
  state: State;
  reason: string;
}

/** Progress of a long step: fraction 0 to 1 of this rung, and a sentence. */
export interface Progress {
  rung: Rung;
  fraction: number;
  message: string;
}

/** One node of the running tree. `node_id` is the diagram's id, `tree_id` its diagram. */
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
 * The changes of one tick, or of a halt after it: then `n` is that of the tick.
 *
 * `past` replaces that of the message before: nodes that are idle again, with their last status in the tick.
 */
export interface Tick {
  n: number;
  changed: [number, NodeStatus][];
  flashed: [number, NodeStatus][];
  duration_ms: number;
  past: [number, NodeStatus][];
}

/** One changed entry; large values are sent as a preview (text), with `preview` set. */
export interface BlackboardEntry {
  scope: string;
  key: string;
  type: string;
  value: unknown;
  preview: boolean;
  removed: boolean;
}

/** Entries that changed since the last such message. */
export interface Blackboard {
  entries: BlackboardEntry[];
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

/** A failure: an exception in an action, or a process that died or hangs. */
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

/** The run ended; if the root returned its status, the node is the lowest one that decided it. */
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
}

/**
 * One ROS topic: its rate over the last two seconds, and the nodes at both of its ends.
 *
 * `hz` and `bytes_per_s` are null without a measurement: images and point clouds are measured only while a
 * client echoes them, and the first `list_topics` after a while starts the measurement. `types` has more
 * than `type` if a robot accepts several types on its command topic.
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
 * Two ends of a topic do not match, so no message arrives; reported once while both exist.
 *
 * `publisher` and `subscriber` are nodes; `reason` is the difference: message type or quality of service.
 * `hint` says how to fix it.
 */
export interface TopicMismatch {
  topic: string;
  publisher: string;
  subscriber: string;
  reason: "qos" | "type";
  message: string;
  hint: string;
}

/**
 * A process of the project's launch files; `file` and `line` are its place there.
 *
 * `end` says how it ended (exit code or signal), or why it could not be started.
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

/** Full state for a client that joins late; deltas follow. */
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
 *     shape: its kind. `size` in m is [x, y, z] for a box, [radius, length] for a cylinder or a
 *         capsule along z, [radius] for a sphere, [x, y] for a plane, [sx, sy, sz] (scale) for a mesh.
 *     pose: [x, y, z, qx, qy, qz, qw] in the object's frame.
 *     color: [r, g, b, a], each 0 to 1, sRGB.
 *     mesh: key in `Scene.meshes` for a mesh, else "".
 *     texture: key in `Scene.textures`, or "" for none; the colour tints it.
 *     ceiling: whether it is a ceiling or the upper part of a wall, which only robots' cameras see.
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

/** One rigid piece (a body, or a link of a robot) with its pose [x, y, z, qx, qy, qz, qw]. */
export interface SceneObject {
  id: number;
  body: string;
  link: string;
  kind: "actor" | "dynamic" | "robot" | "static";
  shapes: Shape[];
  pose: number[];
}

/**
 * Triangles: positions and normals as little-endian float32 (3 a vertex), indices as uint32.
 *
 * `uvs` are the texture coordinates of the file, if any: two float32 a vertex; v points up.
 */
export interface Mesh {
  positions: Uint8Array;
  normals: Uint8Array;
  indices: Uint8Array;
  uvs?: Uint8Array;
}

/**
 * A repeated image: a JPEG file, and the width and height of one repetition in m.
 *
 * `executor/render/mapping.py` maps it to shapes; on a mesh with `uvs` these do, and the size is unused.
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
 * Poses that changed: `ids` little-endian uint16, and 16 bytes of `poses` an id.
 *
 * Of these, bytes 0-8 are x, y, z as int24 in 0.1 mm; byte 9 is the index of the omitted one of qx, qy, qz,
 * qw (the largest, made positive); bytes 10-15 are the others as int16 in 1/(32767 * sqrt(2)).
 * Little-endian.
 */
export interface Poses {
  type: "poses";
  t: number;
  ids: Uint8Array;
  poses: Uint8Array;
}

/** One LIDAR scan: ranges float32 in m, counter-clockwise; pose of the sensor in the world. */
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
 * One image of a robot's camera.
 *
 * `sensor` is the sensor's name, and `robot/sensor` for every robot but the first.
 */
export interface Camera {
  type: "camera";
  t: number;
  sensor: string;
  width: number;
  height: number;
  jpeg: Uint8Array;
}

/** The world as the server draws it. */
export interface View {
  type: "view";
  t: number;
  width: number;
  height: number;
  jpeg: Uint8Array;
}

/** Payload by `command`. */
export interface Commands {
  connect: Empty;
  launch_universe: LaunchUniverse;
  prepare_visualization: Empty;
  run_application: RunApplication;
  run: Run;
  pause: Empty;
  resume: Empty;
  step: Empty;
  cancel: Empty;
  set_tick_rate: SetTickRate;
  set_speed: SetSpeed;
  restart_application: Empty;
  reset_world: Empty;
  terminate_application: Empty;
  terminate_visualization: Empty;
  terminate_universe: Empty;
  disconnect: Empty;
  set_blackboard: SetBlackboard;
  teleop: Teleop;
  move_body: MoveBody;
  subscribe: Subscribe;
  unsubscribe: Unsubscribe;
  list_topics: Empty;
  echo_topic: EchoTopic;
  publish_topic: PublishTopic;
  describe_type: DescribeType;
  restart_node: RestartNode;
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
  tree: Tree;
  tick: Tick;
  blackboard: Blackboard;
  log: Log;
  fault: Fault;
  finished: Finished;
  sim: Sim;
  topics: Topics;
  topic_message: TopicMessage;
  type_description: TypeDescription;
  topic_mismatch: TopicMismatch;
  launch_nodes: LaunchNodes;
}

/** What the stream socket sends, told by `type`. */
export type Frame = Scene | Poses | Scan | Camera | View;
