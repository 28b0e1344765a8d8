import type {
  Applied,
  Attached,
  AttachedTree,
  BlackboardEntry,
  Branch,
  Fault,
  Finished,
  FlagSet,
  Forced,
  Held,
  HeldInPython,
  Introspection,
  LaunchNode,
  Log,
  PortSet,
  Profile,
  Progress,
  RecordingStopped,
  Segment,
  Sim,
  State,
  TopicMismatch,
  TreeNode,
  Waiting,
} from '@/generated/messages';
import type { Connection } from './connectionStates';

export interface LogLine extends Log {
  /** Increases within this page; it is the key of a console row. */
  id: number;
  /** The run that begins with this line, which is drawn as a divider. */
  run?: number;
}

export interface BlackboardRow extends BlackboardEntry {
  /** The number of the last message that changed the entry; a new number makes its row flash. */
  changedAt: number;
  /** The last write, of a row that is shown at a past moment: its time in s, if it is known, and its writer. */
  written?: { readonly t: number | null; readonly by: string | null };
}

/** The turn of a session that waits for a place on the server. */
export interface QueuedTurn {
  /** The number of robots that get a place before it. */
  readonly before: number;
  /** Whether it waits until another robot of the same user ends. */
  readonly isOwn: boolean;
}

/** The state of the session as this page knows it. */
export interface SessionData {
  connection: Connection;
  connectionMessage: string;
  /** For how many seconds the executor has not answered; 0 while they are too few to show. */
  silentS: number;
  projectId: string | null;
  sessionId: string | null;
  introspection: Introspection | null;
  /** Whether this page controlled the session until another page took control. */
  wasTakenOver: boolean;
  executor: State;
  executorReason: string;
  progress: Progress | null;
  /** Set while the session waits for a place on the server. */
  queued: QueuedTurn | null;
  /**
   * When the present tick began to hang, in ms of the page's clock (`performance.now`), as a fault has reported;
   * null again after another tick or state.
   */
  hungSince: number | null;
  /** The number of runs that began while this page was connected. */
  runs: number;
  /** Whether Run was pressed and has neither succeeded nor failed yet. */
  isLaunching: boolean;
  tree: TreeNode[];
  blackboard: Record<string, BlackboardRow>;
  logs: LogLine[];
  nextLogId: number;
  faults: Fault[];
  /** The processes of the project's launch files. */
  launchNodes: LaunchNode[];
  finished: Finished | null;
  /** The ports that were changed since the program was started, by node and port. */
  ports: Record<string, PortSet>;
  /** The last answer to the command *Apply*: what it did, or would do. */
  applied: Applied | null;
  /** Topics whose ends do not match now. */
  mismatches: TopicMismatch[];
  /** The segments of the recordings of this session that can be read, those of the last run at the end. */
  segments: Segment[];
  /** The flags of the present run. */
  flags: FlagSet[];
  /** Where recordings of this session stopped. */
  stops: RecordingStopped[];
  /** The runs of this session that continue others. */
  branches: Branch[];
  /** The runs in which one can go back, those of the last run at the end. */
  repeatableRuns: string[];
  /** Those of them that are live: their world goes back, and their tree begins again. */
  liveRuns: string[];
  /** When the debugger changed those that it did, in s: one can go back only to an earlier moment. */
  runsByHand: Record<string, number>;
  /** How far a run is on its way back to a moment, 0 to 1; null while none is. */
  goingBack: number | null;
  /** Where the debugger holds the tree; null while it does not. */
  held: Held | null;
  /** The hold at a line of Python within a tick; null while there is none, or the tree is held at a node. */
  heldInPython: HeldInPython | null;
  /** Whether all breakpoints were off when the last hold ended. */
  areBreakpointsOff: boolean;
  /** What is forced on nodes; null for nothing. */
  forced: Forced | null;
  /** The program that this session follows; null in a session of a project. */
  attached: Attached | null;
  /** Its tree; null before it is known. */
  attachedTree: AttachedTree | null;
  /** The times of the nodes, if they are or were measured in this run. */
  profile: Profile | null;
  /** The port at which Groot2 can look at the trees of this session; 0 for none. */
  groot2: number;
  /** The action in which the present tick takes long; its text is empty for none. */
  waiting: Waiting;
  sim: Sim | null;
  simTime: number;
  tick: number;
  tickHz: number;
  speed: number;
  universe: string;
  lastSeq: number;
}
