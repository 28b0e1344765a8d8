import { describe, expect, it } from 'vitest';
import type {
  BlackboardEntry,
  Events,
  Fault,
  Introspection,
  Held,
  Log,
  ServerMessage,
  Snapshot,
  PortSet,
  TopicMismatch,
} from '@/generated/messages';
import { appendLogs, blackboardId, initialSession, MAX_LOG_LINES, reduce, reduceAll } from './reduce';
import type { SessionData } from './types';

let seq = 0;

function message<K extends keyof Events>(command: K, data: Events[K], t = 1): ServerMessage {
  seq += 1;
  return { id: `s${seq}`, command, data, seq, t };
}

const entry = (key: string, value: unknown, more: Partial<BlackboardEntry> = {}): BlackboardEntry => ({
  scope: '',
  key,
  type: 'float',
  value,
  preview: false,
  removed: false,
  ...more,
});

const log = (text: string, more: Partial<Log> = {}): Log => ({
  source: 'action',
  level: 'info',
  text,
  node_id: '',
  node_path: '',
  time: 0,
  launch_node: '',
  ...more,
});

const snapshot = (more: Partial<Snapshot> = {}): Snapshot => ({
  runs: 0,
  run_starts: [],
  hanging_s: 0,
  segments: [],
  flags: [],
  stops: [],
  branches: [],
  repeatable_runs: [],
  live_runs: [],
  runs_by_hand: {},
  held: null,
  held_in_python: null,
  forced: null,
  attached: null,
  attached_tree: null,
  profile: null,
  groot2: null,
  waiting: { text: '', node_id: '', node_path: '' },
  state: 'application_running',
  tree: null,
  statuses: [],
  blackboard: [],
  logs: [],
  faults: [],
  tick_hz: 20,
  speed: 1,
  universe: 'walled_room',
  launch_nodes: [],
  mismatches: [],
  past: [],
  finished: null,
  ports: [],
  ...more,
});

const INTRODUCED: Introspection = {
  protocol: 'bt-studio.v1',
  client_id: 'c',
  role: 'driver',
  state: 'application_running',
  version: 'test',
  ros_distro: 'humble',
  ros_domain_id: 0,
  renderer: 'egl',
  tf: true,
  ros_environment: {},
};

describe('reduce', () => {
  it('follows the ladder and keeps the reason', () => {
    const state = reduce(initialSession, message('state-changed', { state: 'paused', reason: 'asked' }));
    expect(state).toMatchObject({ executor: 'paused', executorReason: 'asked' });
  });

  const mismatch: TopicMismatch = {
    topic: '/scan',
    publisher: '/world',
    subscriber: '/bt_application',
    reason: 'qos',
    message: 'Nothing arrives: they differ.',
    hint: 'Do this.',
    code: 'qos',
    values: { problem: 'deadline' },
    resolved: false,
  };

  it('knows topics whose ends do not match, and has a line about each, also for those who come later', () => {
    const told = reduce(initialSession, message('topic_mismatch', mismatch));
    const late = reduce(initialSession, message('snapshot', snapshot({ mismatches: [mismatch] })));
    for (const state of [told, late]) {
      expect(state.mismatches).toEqual([mismatch]);
      expect(state.logs).toMatchObject([
        { level: 'warning', source: 'world', text: '/scan: Nothing arrives: they differ. Do this.' },
      ]);
    }
  });

  it('forgets a mismatch that is resolved, or whose world has ended', () => {
    const told = reduce(initialSession, message('topic_mismatch', mismatch));
    const resolved = reduce(told, message('topic_mismatch', { ...mismatch, resolved: true }));
    expect(resolved.mismatches).toEqual([]);
    expect(resolved.logs).toEqual(told.logs);
    const stopped = reduce(told, message('state-changed', { state: 'visualization_ready', reason: '' }));
    expect(stopped.mismatches).toEqual([mismatch]);
    const ended = reduce(told, message('state-changed', { state: 'connected', reason: '' }));
    expect(ended.mismatches).toEqual([]);
  });

  it('knows the ports that were changed since the program was started', () => {
    const set: PortSet = {
      node_id: 'n1',
      tree_id: 'Main',
      path: 'Go',
      port: 'speed',
      value: '0.5',
      saved: '0.3',
      effect: 'next_tick',
    };
    const again = { ...set, value: '0.7' };
    const state = reduce(reduce(initialSession, message('port_set', set)), message('port_set', again));
    expect(Object.values(state.ports)).toEqual([again]);
    const late = reduce(initialSession, message('snapshot', snapshot({ ports: [again] })));
    expect(late.ports).toEqual(state.ports);
    expect(reduce(state, message('tree', { nodes: [] })).ports).toEqual({});
  });

  it('remembers that another page took over, until this one controls again', () => {
    const told = (state: SessionData, role: Introspection['role']) =>
      reduce(state, message('introspection', { ...INTRODUCED, role }));
    const lookingOn = told(initialSession, 'viewer');
    expect(lookingOn.wasTakenOver).toBe(false);
    const driving = told(lookingOn, 'driver');
    expect(driving.wasTakenOver).toBe(false);
    const displaced = told(driving, 'viewer');
    expect(displaced).toMatchObject({ wasTakenOver: true, introspection: { role: 'viewer' } });
    expect(told(displaced, 'viewer').wasTakenOver).toBe(true);
    expect(told(displaced, 'driver').wasTakenOver).toBe(false);
  });

  it('keeps simulated time and sequence of every message', () => {
    const state = reduce(initialSession, { ...message('tick', tick(7)), t: 3.5 });
    expect(state).toMatchObject({ tick: 7, simTime: 3.5, lastSeq: seq });
  });

  it('keeps the speed that was chosen before there is a world', () => {
    const chosen = { ...initialSession, speed: 2 };
    expect(reduce(chosen, message('snapshot', snapshot({ state: 'connected', speed: 1 }))).speed).toBe(2);
    expect(reduce(chosen, message('snapshot', snapshot({ state: 'paused', speed: 1 }))).speed).toBe(1);
  });

  it('gives with deltas after a snapshot what a new snapshot gives', () => {
    const first = snapshot({ blackboard: [entry('a', 1), entry('b', 2)], logs: [log('one')] });
    const deltas = [
      message('blackboard', { entries: [entry('a', 5), entry('b', 2, { removed: true }), entry('c', 3)] }),
      message('log', log('two')),
      message('state-changed', { state: 'paused', reason: '' }),
    ];
    const followed = reduceAll(reduce(initialSession, message('snapshot', first)), deltas);
    const fresh = reduce(
      initialSession,
      message('snapshot', {
        ...first,
        state: 'paused',
        blackboard: [entry('a', 5), entry('c', 3)],
        logs: [log('one'), log('two')],
      }),
    );
    const shape = (state: typeof followed) => ({
      executor: state.executor,
      logs: state.logs.map(({ text }) => text),
      blackboard: Object.fromEntries(Object.values(state.blackboard).map((row) => [row.key, row.value])),
    });
    expect(shape(followed)).toEqual(shape(fresh));
  });

  it('forgets the faults and the blackboard of the last run when a new tree comes', () => {
    const before = {
      ...initialSession,
      faults: [
        {
          kind: 'exception' as const,
          message: 'boom',
          hint: '',
          node_id: 'n1',
          tree_id: 'MainTree',
          node_path: '',
          file: '',
          line: 0,
          traceback: '',
        },
      ],
      blackboard: { x: { ...entry('x', 1), changedAt: 1 } },
    };
    const state = reduce(before, message('tree', { nodes: [] }));
    expect(state.faults).toEqual([]);
    expect(state.blackboard).toEqual({});
  });

  it('shows the traceback of a fault in the console', () => {
    const fault = {
      kind: 'exception' as const,
      message: 'boom',
      hint: '',
      node_id: 'n1',
      tree_id: 'MainTree',
      node_path: 'go',
      file: 'actions/Go.py',
      line: 3,
      traceback: 'Traceback:\n  File "actions/Go.py", line 3\nboom',
    };
    const state = reduce(initialSession, message('fault', fault));
    expect(state.faults).toEqual([fault]);
    expect(state.logs.map(({ text, level }) => [level, text])).toContainEqual([
      'error',
      '  File "actions/Go.py", line 3',
    ]);
  });

  it('separates two scopes of one key', () => {
    const state = reduce(
      initialSession,
      message('blackboard', { entries: [entry('k', 1), entry('k', 2, { scope: 'sub' })] }),
    );
    expect(Object.keys(state.blackboard)).toHaveLength(2);
    expect(blackboardId({ scope: 'a', key: 'b' })).not.toBe(blackboardId({ scope: '', key: 'ab' }));
  });

  it('changes nothing for an unknown message', () => {
    const unknown = { id: 'x', command: 'later', data: {}, seq: 99, t: 0 };
    expect(reduce(initialSession, unknown)).toBe(initialSession);
  });
});

describe('a run', () => {
  const loading = message('progress', { rung: 'run_application', fraction: 0, message: '' });

  it('is separated in the console from the previous one', () => {
    const first = reduceAll(initialSession, [loading, message('log', log('a'))]);
    expect(first.logs.map(({ run }) => run)).toEqual([undefined]);
    const second = reduce(first, loading);
    expect(second.logs.map(({ run }) => run)).toEqual([undefined, 2]);
  });

  it('is divided from the one before for those who come later too, and hangs as long as it does', () => {
    const logs = [log('a'), log('b'), log('c', { time: 2 })];
    const late = reduce(
      initialSession,
      message(
        'snapshot',
        snapshot({
          logs,
          runs: 3,
          run_starts: [
            [0, 1],
            [2, 2],
            [3, 3],
          ],
          hanging_s: 7.5,
        }),
      ),
      10_000,
    );
    expect(late.logs.map(({ run, text }) => run ?? text)).toEqual([1, 'a', 'b', 2, 'c', 3]);
    expect(late).toMatchObject({ runs: 3, hungSince: 2500 });
    expect(reduce(late, loading).logs.at(-1)?.run).toBe(4);
    expect(reduce(late, message('snapshot', snapshot())).hungSince).toBeNull();
  });

  it('hangs from the report until the next tick', () => {
    const running = { ...initialSession, executor: 'application_running' } as const;
    const fault = {
      kind: 'timeout',
      message: '',
      hint: '',
      node_id: '',
      tree_id: '',
      node_path: '',
    } as const;
    const told = (kind: Fault['kind']) =>
      message('fault', { ...fault, kind, file: '', line: 0, traceback: '' });
    const hanging = reduce(running, told('timeout'), 9000);
    expect(hanging.hungSince).toBe(7000);
    expect(reduce(hanging, told('timeout'), 12_000).hungSince).toBe(7000);
    expect(reduce(hanging, told('process')).hungSince).toBe(7000);
    expect(reduce(hanging, told('exception')).hungSince).toBeNull();
    expect(reduce(hanging, message('tick', tick(3))).hungSince).toBeNull();
  });

  it('has no fault of a launch node that runs again', () => {
    const node = { id: 'x', name: 'x', package: '', executable: '', file: 'launch/a.yaml', line: 2 } as const;
    const end = { ...node, restarts: 0, end: '' };
    const fault = {
      kind: 'process',
      message: '',
      hint: '',
      node_id: '',
      tree_id: '',
      node_path: '',
    } as const;
    const failed = reduceAll(initialSession, [
      message('launch_nodes', { nodes: [{ ...end, state: 'failed' }] }),
      message('fault', { ...fault, file: 'launch/a.yaml', line: 2, traceback: '' }),
    ]);
    expect(failed.faults).toHaveLength(1);
    const again = reduce(failed, message('launch_nodes', { nodes: [{ ...end, state: 'running' }] }));
    expect(again.faults).toEqual([]);
  });
});

describe('appendLogs', () => {
  it('makes a numbered row of each line of text', () => {
    const { logs, nextLogId } = appendLogs({ logs: [], nextLogId: 1 }, [log('a\nb\n'), log('c')]);
    expect(logs.map(({ id, text }) => [id, text])).toEqual([
      [1, 'a'],
      [2, 'b'],
      [3, 'c'],
    ]);
    expect(nextLogId).toBe(4);
  });

  it('drops the oldest lines above the limit', () => {
    const many = Array.from({ length: MAX_LOG_LINES + 10 }, (_, index) => log(String(index)));
    const { logs } = appendLogs({ logs: [], nextLogId: 1 }, many);
    expect(logs).toHaveLength(MAX_LOG_LINES);
    expect(logs[0]?.text).toBe('10');
  });
});

function tick(n: number): Events['tick'] {
  return { n, changed: [], flashed: [], duration_ms: 0.1, past: [], forced: [] };
}

it('knows each segment in its last state, and forgets those that are gone', () => {
  const segment = {
    run: 'a',
    branch: 0,
    number: 0,
    version: 0,
    from_t: 0,
    to_t: 1,
    bytes: 10,
    complete: false,
    run_number: 1,
    result: null,
  };
  const told = (...data: (typeof segment)[]) =>
    reduceAll(
      initialSession,
      data.map(
        (each) => ({ id: '', seq: 1, t: 0, tick: 0, command: 'segment', data: each }) as ServerMessage,
      ),
    ).segments;
  expect(told(segment, { ...segment, number: 1 }, { ...segment, bytes: 20 })).toEqual([
    { ...segment, bytes: 20 },
    { ...segment, number: 1 },
  ]);
  expect(told(segment, { ...segment, bytes: 0 })).toEqual([]);
});

it('knows the flags of the present run, and where a recording stopped until a later run is recorded', () => {
  const flag = (id: string, text: string, run = 'a') => message('flag', { run, id, t: 1, text, user: '' });
  const set = [flag('1', 'one'), flag('2', 'two'), flag('1', 'first')].reduce(reduce, initialSession);
  expect(set.flags.map(({ text }) => text)).toEqual(['two', 'first']);
  expect(reduce(set, flag('2', '')).flags.map(({ id }) => id)).toEqual(['1']);
  expect(reduce(set, flag('3', 'other', 'b')).flags.map(({ run }) => run)).toEqual(['b']);
  const stop = { run: 'a', t: 2, reason: 'disk_full', detail: 'No space left', goes_on: false } as const;
  const stopped = reduce(set, message('recording_stopped', stop));
  expect(stopped.stops).toEqual([stop]);
  const segment = {
    branch: 0,
    number: 0,
    version: 0,
    from_t: 0,
    to_t: 1,
    bytes: 1,
    complete: false,
    run_number: 1,
    result: null,
  };
  expect(reduce(stopped, message('segment', { ...segment, run: 'a' })).stops).toEqual([stop]);
  expect(reduce(stopped, message('segment', { ...segment, run: 'b' })).stops).toEqual([]);
  const joined = reduce(initialSession, message('snapshot', snapshot({ flags: set.flags, stops: [stop] })));
  expect(joined).toMatchObject({ flags: set.flags, stops: [stop] });
});

it('keeps the times of the nodes after a run, and forgets them with the next tree', () => {
  const message = (command: string, data: unknown) => ({ id: '', command, data, seq: 1, t: 0 });
  const profile = { on: true, ticks: 3, tick_ms: 1, nodes: [], sample: null, samples: 0, stacks: [] };
  const measured = reduceAll(initialSession, [message('profile', profile)]);
  expect(measured.profile).toEqual(profile);
  const over = { state: 'visualization_ready', reason: '' };
  const ended = reduce(measured, message('state-changed', over));
  expect(ended.profile).toEqual({ ...profile, on: false });
  expect(reduce(ended, message('tree', { nodes: [] })).profile).toBeNull();
  expect(reduce(initialSession, message('state-changed', over)).profile).toBeNull();
  expect(reduce(initialSession, message('snapshot', snapshot({ profile }))).profile).toEqual(profile);
});

it('knows the port for Groot2 until the session has none', () => {
  const message = (command: string, data: unknown) => ({ id: '', command, data, seq: 1, t: 0 });
  const served = reduce(initialSession, message('groot2', { port: 1667 }));
  expect(served.groot2).toBe(1667);
  expect(reduce(served, message('groot2', { port: 0 })).groot2).toBe(0);
  const joined = reduce(initialSession, message('snapshot', snapshot({ groot2: { port: 1700 } })));
  expect(joined.groot2).toBe(1700);
  expect(reduce(joined, message('snapshot', snapshot({}))).groot2).toBe(0);
});

describe('a held tree', () => {
  const held: Held = {
    uid: 2,
    path: [1, 2],
    why: 'step',
    ahead: [2],
    cause: 'step',
    event: 'before',
    tick: 3,
    status: null,
    decided: '',
    statuses: [[1, 'RUNNING']],
    hook: 0,
    outside: false,
  };
  const message = (command: string, data: unknown) => ({ id: '', command, data, seq: 1, t: 0 });
  const states = (...messages: ReturnType<typeof message>[]) => reduceAll(initialSession, messages);

  it('is known until it is released, or the run is over', () => {
    const began = [message('held', held), message('state-changed', { state: 'held', reason: '' })];
    expect(states(...began).held).toEqual(held);
    expect(states(...began, message('released', { off: false })).held).toBeNull();
    expect(states(...began, message('released', { off: true })).areBreakpointsOff).toBe(true);
    const over = message('state-changed', { state: 'visualization_ready', reason: '' });
    expect(states(...began, over)).toMatchObject({ held: null, forced: null });
    expect(states(message('snapshot', snapshot({ state: 'held', held }))).held).toEqual(held);
  });

  it('has forced results while any are', () => {
    const forced = { nodes: [], alone: 2 };
    expect(states(message('forced', forced)).forced).toEqual(forced);
    expect(states(message('forced', forced), message('forced', { nodes: [], alone: 0 })).forced).toBeNull();
  });
});

it('shows the action in which a tick takes long until it returns, or the run stops', () => {
  const act = { text: "Act 'Act' (actions/Act.py:3)", node_id: 'n1', node_path: 'Act' };
  const none = { text: '', node_id: '', node_path: '' };
  const long = reduce(initialSession, message('waiting', act));
  expect(long.waiting).toEqual(act);
  expect(reduce(long, message('waiting', none)).waiting).toEqual(none);
  expect(reduce(long, message('state-changed', { state: 'paused', reason: '' })).waiting).toEqual(none);
  expect(reduce(initialSession, message('snapshot', snapshot({ waiting: act }))).waiting).toEqual(act);
});
