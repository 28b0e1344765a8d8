import type { LogLevel, NodeStatus, RecordingStopped, Scene, Segment, TreeNode } from '@/generated/messages';

/** The statuses by their numbers in a recording. */
export const STATUSES: readonly NodeStatus[] = ['IDLE', 'RUNNING', 'SUCCESS', 'FAILURE', 'SKIPPED'];

export type StatusOf = readonly [uid: number, status: NodeStatus];

/** Where the recording of a run is read from: a session, or a file on the server. */
export interface RecordingSource {
  segments(): readonly Segment[];
  read(segment: Segment, offset: number, length: number): Promise<Uint8Array>;
  /** The most bytes of a read after the first of a segment; without it, 1 MiB, as of a session. */
  readonly partBytes?: number;
  /** Whether all is one complete file that can be read at any place. */
  readonly isOneFile?: boolean;
  /** Calls back when segments came, grew or went; returns a function that stops it. */
  subscribe(changed: () => void): () => void;
}

/** A node as it ran, with what its ports were given. */
export interface RecordedNode extends TreeNode {
  readonly ports: Readonly<Record<string, string>>;
}

/** A value of the blackboard at a moment. */
export interface Entry {
  readonly scope: string;
  readonly key: string;
  readonly type: string;
  readonly value: unknown;
  /** Whether the value was too long, or has no JSON form: then `value` is its beginning as text. */
  readonly isPreview: boolean;
}

/** What identifies a value of the blackboard. */
export type EntryName = Pick<Entry, 'scope' | 'key'>;

/** A write of a value of the blackboard, or its removal. */
export interface WriteAt {
  readonly t: number;
  readonly value: unknown;
  readonly isRemoved: boolean;
  /** The name of the node that wrote; empty if it was none, null if it is unknown. */
  readonly by: string | null;
}

export interface EntryAt extends Entry {
  /** The time of the last write in s; null if the part of the recording with it is not read or is gone. */
  readonly since: number | null;
  /** The node that wrote; null if unknown, 0 from outside, `IN_PLACE` if it was changed without a write. */
  readonly writer: number | null;
}

export const IN_PLACE = 0xffffffff;

/** Returns the name of a node as the blackboard shows its writers. */
export const writerName = ({ name, type }: Pick<TreeNode, 'name' | 'type'>): string =>
  name.replace(/::\d+$/, '') || type;

export interface RecordedLine {
  readonly t: number;
  readonly source: string;
  readonly level: LogLevel;
  readonly text: string;
  readonly path: string;
}

export interface RecordedFault {
  readonly t: number;
  readonly uid: number;
  readonly kind: string;
  readonly file: string;
  readonly line: number;
  readonly message: string;
  readonly traceback: string;
  readonly path: string;
}

export type MarkKind = 'fault' | 'collision' | 'finished' | 'flag' | 'stopped' | 'held' | 'forced';

export interface Mark {
  readonly t: number;
  readonly kind: MarkKind;
  readonly text: string;
  /** What identifies a flag within its run. */
  readonly id?: string;
  /** Who set a flag, if it is known. */
  readonly user?: string;
  /** The node at which the tree was held, that raised a fault, or whose result was forced. */
  readonly uid?: number;
  /** The tick within which the tree was held. */
  readonly tick?: number;
  /** Why the recording stopped, as the session tells it. */
  readonly stop?: Pick<RecordingStopped, 'reason' | 'goes_on'>;
}

/** A flag as it was set, changed or, with an empty text, removed. */
export type FlagMark = Mark & { readonly kind: 'flag'; readonly id: string };

/** A tick: several can have one time, since a world that is slow stands between them. */
export interface TickAt {
  readonly t: number;
  readonly tick: number;
}

/** What belongs to the whole recording, as far as it has been read. */
export interface Overview {
  readonly run: string;
  /** The ranges of time that have been read, in order, in s. */
  readonly read: readonly (readonly [from: number, to: number])[];
  /** The status of the root from each time on. */
  readonly root: readonly (readonly [t: number, status: NodeStatus])[];
  readonly marks: readonly Mark[];
  readonly lines: readonly RecordedLine[];
  readonly faults: readonly RecordedFault[];
}

/** Poses as on the stream: packed, of all objects. */
export interface PosesAt {
  readonly ids: Uint8Array;
  readonly poses: Uint8Array;
}

export interface ScanAt {
  readonly t: number;
  readonly sensor: string;
  readonly angleMin: number;
  readonly angleIncrement: number;
  readonly rangeMax: number;
  readonly ranges: Float32Array;
}

export interface PictureAt {
  readonly t: number;
  readonly topic: string;
  readonly jpeg: Uint8Array;
}

/** What a tick left behind. */
export interface Ticked {
  /** The nodes that are not idle. */
  readonly statuses: readonly StatusOf[];
  /** Results within the tick that did not stay. */
  readonly flashes: readonly StatusOf[];
  /** The nodes whose status the tick changed, with the status from before. */
  readonly was: readonly StatusOf[];
  /** The uids of the nodes whose result in the tick was forced by the debugger. */
  readonly forced: readonly number[];
}

/** Everything that was recorded for one moment of a run. */
export interface Moment extends Ticked {
  readonly t: number;
  /** The number of the last tick; 0 before the first. */
  readonly tick: number;
  /** The time of the last tick in s; null before the first. */
  readonly tickT: number | null;
  readonly durationMs: number | null;
  /** The generation of the tree; its nodes are sent only when the asker does not know them. */
  readonly generation: number;
  readonly tree: readonly RecordedNode[] | null;
  /** The attached diagrams by their names in the recording; sent with the nodes. */
  readonly files: Readonly<Record<string, string>> | null;
  /** The last tick itself, if the tree was halted after it; else null. */
  readonly halted: Ticked | null;
  readonly entries: readonly EntryAt[];
  /** The world: sent only when the asker has another one. */
  readonly scene: Scene | null;
  /** Which world it is, in this recording; -1 without one. */
  readonly sceneId: number;
  readonly poses: PosesAt | null;
  readonly scan: ScanAt | null;
  readonly pictures: readonly PictureAt[];
}

/** What changed between two moments. */
export interface Changes {
  readonly statuses: readonly { uid: number; path: string; from: NodeStatus; to: NodeStatus }[];
  /** With the time of the last write before the second moment; null if it is not read. */
  readonly entries: readonly {
    scope: string;
    key: string;
    from: unknown;
    to: unknown;
    since: number | null;
  }[];
  readonly poses: readonly MovedAt[];
}

/** A body of the scene that moved between two moments. */
export interface MovedAt {
  readonly id: number;
  readonly metres: number;
  readonly degrees: number;
}

/** An error of a recording: what, and where. */
export class RecordingError extends Error {
  override readonly name = 'RecordingError';
  constructor(
    readonly code: 'not_mcap' | 'damaged' | 'too_large' | 'wrong_type',
    message: string,
    readonly where: string,
  ) {
    super(`${message} (${where})`);
  }
}

/** Returns a time in s as recordings have it, in whole ns: times of the session can be a little beside theirs. */
export const recordedTime = (t: number): number => Math.round(t * 1e9) / 1e9;
