import type {
  BlackboardEntry,
  Branch,
  Events,
  Fault,
  FlagSet,
  LaunchNode,
  Log,
  PortSet,
  Segment,
  ServerMessage,
  Snapshot,
  State,
  TopicMismatch,
} from '@/generated/messages';
import type { BlackboardRow, LogLine, SessionData } from './types';

/** The time in s after which the executor reports a tick that has not returned. */
const HANG_REPORTED_S = 2;

/** The states in which a program is loaded. */
const APPLICATION: readonly State[] = ['application_running', 'paused', 'held'];

/** The number of log lines that are kept, about an hour of output; older lines are dropped. */
export const MAX_LOG_LINES = 5000;

export const initialSession: SessionData = {
  connection: 'off',
  connectionMessage: '',
  silentS: 0,
  projectId: null,
  sessionId: null,
  introspection: null,
  wasTakenOver: false,
  executor: 'idle',
  executorReason: '',
  progress: null,
  queued: null,
  hungSince: null,
  runs: 0,
  isLaunching: false,
  tree: [],
  blackboard: {},
  logs: [],
  nextLogId: 1,
  faults: [],
  launchNodes: [],
  finished: null,
  ports: {},
  applied: null,
  mismatches: [],
  segments: [],
  flags: [],
  stops: [],
  branches: [],
  repeatableRuns: [],
  liveRuns: [],
  runsByHand: {},
  goingBack: null,
  held: null,
  heldInPython: null,
  areBreakpointsOff: false,
  forced: null,
  attached: null,
  attachedTree: null,
  sim: null,
  simTime: 0,
  tick: 0,
  tickHz: 20,
  profile: null,
  groot2: 0,
  waiting: { text: '', node_id: '', node_path: '' },
  speed: 1,
  universe: '',
  lastSeq: 0,
};

type Handler<K extends keyof Events> = (
  state: SessionData,
  data: Events[K],
  message: ServerMessage,
  now: number,
) => Partial<SessionData>;

const handlers: { [K in keyof Events]?: Handler<K> } = {
  introspection: (state, data) => ({
    introspection: data,
    queued: null,
    executor: data.state,
    wasTakenOver: data.role === 'viewer' && (state.wasTakenOver || state.introspection?.role === 'driver'),
  }),
  'state-changed': (state, data) => ({
    executor: data.state,
    executorReason: data.reason,
    hungSince: null,
    waiting: initialSession.waiting,
    ...(APPLICATION.includes(data.state) ? {} : { progress: state.progress }),
    ...(APPLICATION.includes(data.state)
      ? {}
      : { forced: null, profile: state.profile && { ...state.profile, on: false } }),
    ...(data.state === 'held' ? {} : { held: null, heldInPython: null }),
    ...(data.state === 'idle' || data.state === 'connected' ? { sim: null, mismatches: [] } : {}),
    // Every rung below a running application pauses the world; the next report of the world is up to 1 s away.
    ...(data.state === 'visualization_ready' && state.sim ? { sim: { ...state.sim, paused: true } } : {}),
  }),
  progress: (state, data) => ({
    progress: data,
    ...(data.rung === 'run_application' && data.fraction === 0 ? beginRun(state) : {}),
  }),
  queued: (_, { before, is_own: isOwn }) => ({ queued: before === null ? null : { before, isOwn } }),
  // A new tree means a new run, so the faults of the last run are removed. Launch nodes were started before
  // the tree, and one may already have ended, so their faults stay.
  tree: ({ faults, launchNodes }, data) => ({
    tree: data.nodes,
    blackboard: {},
    faults: faults.filter((fault) =>
      isOfLaunchNode(
        fault,
        launchNodes.filter(({ state }) => state === 'failed'),
      ),
    ),
    finished: null,
    ports: {},
    forced: null,
    profile: null,
    tick: 0,
  }),
  tick: (_, data) => ({ tick: data.n, hungSince: null, heldInPython: null }),
  blackboard: (state, data, { seq }) => ({
    blackboard: mergeBlackboard(state.blackboard, data.entries, seq),
  }),
  log: (state, data, { t }) => appendLogs(state, [{ ...data, time: data.time || t }]),
  fault: (state, data, { t }, now) => ({
    faults: [...state.faults, data],
    hungSince: hungSinceAt(state, data, now),
    ...appendLogs(state, [logOf(data, t)]),
  }),
  port_set: ({ ports }, data) => ({ ports: withPort(ports, data) }),
  applied: (_, data) => ({ applied: data }),
  topic_mismatch: (state, data, { t }) => {
    const others = state.mismatches.filter((each) => !isSameMismatch(each, data));
    if (data.resolved) return { mismatches: others };
    return { mismatches: [...others, data], ...appendLogs(state, [mismatchLog(data, t)]) };
  },
  // A node that runs again has no fault any more.
  launch_nodes: ({ faults }, data) => ({
    launchNodes: data.nodes,
    faults: faults.filter(
      (fault) =>
        !isOfLaunchNode(
          fault,
          data.nodes.filter(({ state }) => state === 'running'),
        ),
    ),
  }),
  finished: (_, data) => ({ finished: data }),
  segment: ({ segments, stops }, data) => {
    const now = withSegment(segments, data);
    // A later run is recorded again, so what was missed before it is not shown any more.
    return { segments: now, stops: stops.filter((stop) => now.some(({ run }) => run === stop.run)) };
  },
  flag: ({ flags }, data) => ({ flags: withFlag(flags, data) }),
  recording_stopped: ({ stops }, data) => ({ stops: [...stops, data] }),
  branch: ({ branches }, data) => ({ branches: withBranch(branches, data) }),
  repeatable_runs: (_, data) => ({
    repeatableRuns: data.runs,
    liveRuns: data.live,
    runsByHand: data.by_hand,
  }),
  going_back: (_, data) => ({ goingBack: data.fraction < 1 ? data.fraction : null }),
  held: (_, data) => ({ held: data, heldInPython: null, hungSince: null, areBreakpointsOff: false }),
  held_in_python: (_, data) => ({ heldInPython: data }),
  released: (_, data) => ({ held: null, areBreakpointsOff: data.off }),
  forced: (_, data) => ({ forced: data.nodes.length > 0 || data.alone > 0 ? data : null }),
  attached: (_, data) => ({ attached: data }),
  attached_tree: (_, data) => ({ attachedTree: data }),
  profile: (_, data) => ({ profile: data }),
  groot2: (_, { port }) => ({ groot2: port }),
  waiting: (_, data) => ({ waiting: data }),
  sim: (_, data) => ({ sim: data, speed: data.speed }),
  snapshot: (state, data, { seq, t }, now) => ({
    executor: data.state,
    tree: data.tree?.nodes ?? [],
    blackboard: mergeBlackboard({}, data.blackboard, seq),
    faults: data.faults,
    launchNodes: data.launch_nodes,
    // Without a world, the rates that the user chose stay: the first run starts with them.
    ...(data.state === 'idle' || data.state === 'connected'
      ? {}
      : { tickHz: data.tick_hz, speed: data.speed }),
    universe: data.universe,
    finished: data.finished,
    hungSince: data.hanging_s > 0 ? now - 1000 * data.hanging_s : null,
    runs: data.runs,
    ports: data.ports.reduce(withPort, {}),
    mismatches: data.mismatches,
    segments: data.segments,
    flags: data.flags,
    stops: data.stops,
    branches: data.branches,
    repeatableRuns: data.repeatable_runs,
    liveRuns: data.live_runs,
    runsByHand: data.runs_by_hand,
    goingBack: null,
    held: data.held,
    heldInPython: data.held_in_python,
    forced: data.forced,
    attached: data.attached,
    attachedTree: data.attached_tree,
    profile: data.profile,
    groot2: data.groot2?.port ?? 0,
    waiting: data.waiting,
    ...keptLogs({ ...state, logs: [] }, data, t),
  }),
};

/** Returns the state after a message that came `now`; messages without state leave it unchanged. */
export function reduce(
  state: SessionData,
  message: ServerMessage,
  now: number = performance.now(),
): SessionData {
  const handler = handlers[message.command as keyof Events] as Handler<keyof Events> | undefined;
  if (!handler) return state;
  const change = handler(state, message.data as Events[keyof Events], message, now);
  return { ...state, ...change, simTime: message.t || state.simTime, lastSeq: message.seq };
}

export function reduceAll(state: SessionData, messages: readonly ServerMessage[]): SessionData {
  const now = performance.now();
  return messages.reduce((before, message) => reduce(before, message, now), state);
}

/** Returns since when the present tick hangs; the end of another process says nothing about it. */
function hungSinceAt({ hungSince, executor }: SessionData, { kind }: Fault, now: number): number | null {
  if (kind === 'process') return hungSince;
  if (kind !== 'timeout' || executor !== 'application_running') return null;
  return hungSince ?? now - 1000 * HANG_REPORTED_S;
}

export function blackboardId(entry: Pick<BlackboardEntry, 'scope' | 'key'>): string {
  return `${entry.scope}\u0000${entry.key}`;
}

function mergeBlackboard(
  rows: Record<string, BlackboardRow>,
  entries: readonly BlackboardEntry[],
  changedAt: number,
): Record<string, BlackboardRow> {
  const next = { ...rows };
  for (const entry of entries) {
    const id = blackboardId(entry);
    if (entry.removed) Reflect.deleteProperty(next, id);
    else next[id] = { ...entry, changedAt };
  }
  return next;
}

const withPort = (ports: Record<string, PortSet>, set: PortSet): Record<string, PortSet> => ({
  ...ports,
  [JSON.stringify([set.path, set.node_id, set.port])]: set,
});

/** Returns the segments with a new state of one; one without bytes is gone. */
function withSegment(segments: readonly Segment[], changed: Segment): Segment[] {
  const isIt = ({ run, branch, number }: Segment) =>
    run === changed.run && branch === changed.branch && number === changed.number;
  if (changed.bytes === 0) return segments.filter((each) => !isIt(each));
  const isKnown = segments.some(isIt);
  return isKnown ? segments.map((each) => (isIt(each) ? changed : each)) : [...segments, changed];
}

/** Returns the flags of the present run with a new state of one; one without text is gone. */
function withFlag(flags: readonly FlagSet[], changed: FlagSet): FlagSet[] {
  const others = flags.filter(({ run, id }) => run === changed.run && id !== changed.id);
  return changed.text === '' ? others : [...others, changed];
}

/** Puts a branch in its place; one that was thrown away is gone. */
function withBranch(branches: readonly Branch[], changed: Branch): Branch[] {
  if (changed.is_gone) return branches.filter(({ run }) => run !== changed.run);
  const isKnown = branches.some(({ run }) => run === changed.run);
  return isKnown
    ? branches.map((branch) => (branch.run === changed.run ? changed : branch))
    : [...branches, changed];
}

const isSameMismatch = (a: TopicMismatch, b: TopicMismatch): boolean =>
  a.topic === b.topic && a.publisher === b.publisher && a.subscriber === b.subscriber && a.code === b.code;

/** Returns whether a fault belongs to one of these launch nodes, by its place in the launch file. */
export const isOfLaunchNode = (fault: Fault, nodes: readonly LaunchNode[]): boolean =>
  fault.kind === 'process' &&
  nodes.some(({ file, line }) => file !== '' && file === fault.file && line === fault.line);

/** Returns the faults of launch nodes, which do not concern the program. */
export const launchNodeFaults = ({ faults, launchNodes }: Pick<SessionData, 'faults' | 'launchNodes'>) =>
  faults.filter((fault) => isOfLaunchNode(fault, launchNodes));

type Lines = Pick<SessionData, 'logs' | 'nextLogId'>;

/** Separates the output of a run from the output before it. */
function beginRun(state: SessionData): Partial<SessionData> {
  const run = state.runs + 1;
  return { runs: run, ...(state.logs.length === 0 ? {} : withDivider(state, run, state.simTime)) };
}

function withDivider({ logs, nextLogId }: Lines, run: number, time: number): Lines {
  const divider = { source: 'manager', level: 'error', text: '', node_id: '', node_path: '' } as const;
  return {
    logs: [...logs, { ...divider, time, launch_node: '', id: nextLogId, run }],
    nextLogId: nextLogId + 1,
  };
}

/** Returns the lines that the executor has stored, with a divider before each run. */
function keptLogs(state: Lines, { logs, run_starts, mismatches }: Snapshot, time: number): Lines {
  let [lines, from] = [state, 0];
  for (const [at, run] of run_starts) {
    lines = withDivider(appendLogs(lines, logs.slice(from, at)), run, logs[at]?.time ?? time);
    from = at;
  }
  const rest = logs.slice(from);
  return appendLogs(lines, [...rest, ...mismatches.map((mismatch) => mismatchLog(mismatch, time))]);
}

/** Returns a fault as console text: its traceback, with lines that can be clicked. */
function logOf(fault: Fault, time: number): Log {
  const source = fault.node_id || fault.kind === 'exception' ? 'action' : 'manager';
  const text = fault.traceback || fault.message;
  const { node_id, node_path } = fault;
  return { source, level: 'error', text, node_id, node_path, time, launch_node: '' };
}

/** Returns a console line about a topic whose publishers and subscribers do not match. */
function mismatchLog({ topic, message, hint }: TopicMismatch, time: number): Log {
  const text = `${topic}: ${message} ${hint}`;
  return { source: 'world', level: 'warning', text, node_id: '', node_path: '', time, launch_node: '' };
}

/** Adds console lines: one numbered row for each line of text. */
export function appendLogs(state: Lines, added: readonly Log[]): Lines {
  let id = state.nextLogId;
  const lines: LogLine[] = [];
  for (const log of added) {
    for (const text of log.text.replace(/\n$/, '').split('\n')) lines.push({ ...log, text, id: id++ });
  }
  const logs = [...state.logs, ...lines];
  return { logs: logs.length > MAX_LOG_LINES ? logs.slice(-MAX_LOG_LINES) : logs, nextLogId: id };
}
