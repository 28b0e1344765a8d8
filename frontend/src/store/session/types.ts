import type {
  BlackboardEntry,
  Fault,
  Finished,
  Introspection,
  LaunchNode,
  Log,
  PortSet,
  Progress,
  Sim,
  State,
  TopicMismatch,
  TreeNode,
} from '@/generated/messages';
import type { Connection } from './connectionStates';

export interface LogLine extends Log {
  /** Increases within this page; the key of console rows. */
  id: number;
  /** The line begins this run and is drawn as a divider. */
  run?: number;
}

export interface BlackboardRow extends BlackboardEntry {
  /** The number of the last message that changed it; a new number makes the row flash. */
  changedAt: number;
}

/** The state of the session, as this page has received it. */
export interface SessionData {
  connection: Connection;
  connectionMessage: string;
  /** The seconds without an answer of the executor; 0 while they are too few to show. */
  silentS: number;
  projectId: string | null;
  sessionId: string | null;
  introspection: Introspection | null;
  /** This page controlled the session until another one took control. */
  wasTakenOver: boolean;
  executor: State;
  executorReason: string;
  progress: Progress | null;
  /** A tick does not return: reported as a fault, until there is another tick or another state. */
  isHanging: boolean;
  /** The number of runs that this page has seen. */
  runs: number;
  /** Run was pressed and has neither succeeded nor failed yet. */
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
  /** Topics whose ends do not match now. */
  mismatches: TopicMismatch[];
  sim: Sim | null;
  simTime: number;
  tick: number;
  tickHz: number;
  speed: number;
  universe: string;
  lastSeq: number;
}
