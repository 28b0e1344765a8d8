import type {
  BlackboardEntry,
  Fault,
  Finished,
  Introspection,
  LaunchNode,
  Log,
  Progress,
  Sim,
  State,
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
  /** For how long the tick had hung when that was reported, s. */
  hungS: number;
  /** The number of runs since the session began. */
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
  sim: Sim | null;
  simTime: number;
  tick: number;
  tickHz: number;
  speed: number;
  universe: string;
  lastSeq: number;
}
