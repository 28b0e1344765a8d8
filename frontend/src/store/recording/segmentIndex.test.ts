import { encode } from '@msgpack/msgpack';
import { expect, it } from 'vitest';
import type { Fields } from './cdr';
import { entryId, isCollision, SegmentIndex } from './segmentIndex';
import type { Read } from './segmentReader';
import { STATUSES } from './types';

const read = (topic: string, t: number, fields: Fields, type = ''): Read => ({
  topic,
  type,
  t,
  data: new Uint8Array(),
  decode: () => fields,
});

const tree = { generation: 1, uid: [1, 2], parent: [0, 1], type: [], kind: [], name: [], path: ['/', '/a'] };

it('begins from a keyframe, and a new tree begins idle and empty', () => {
  const index = new SegmentIndex(0, 0);
  index.add(read('/bt/tree', 0, tree));
  index.add(read('/bt/keyframe', 0, { tick: 7, status: [1, 2], blackboard_json: '[["","k","int",3]]' }));
  expect([...index.stateAt(0).statuses]).toEqual([
    [1, 'RUNNING'],
    [2, 'SUCCESS'],
  ]);
  expect(index.stateAt(0).entries.size).toBe(1);
  expect(index.stateAt(0).number).toBe(7);
  index.add(read('/bt/tree', 2, { ...tree, generation: 2 }));
  expect(index.stateAt(1.9).generation).toBe(1);
  expect(index.stateAt(2).generation).toBe(2);
  expect(index.stateAt(2).entries.size).toBe(0);
});

it('gives each tree the diagrams that were attached before it, and no other files', () => {
  const index = new SegmentIndex(0, 0);
  const attach = (name: string, text: string) => index.attach(name, new TextEncoder().encode(text));
  attach('project/trees/Main.json', 'first');
  attach('project/actions/Go.py', 'code');
  index.add(read('/bt/tree', 0, tree));
  attach('project/trees/Main.json', 'second');
  attach('project/trees/Leg.json', 'leg');
  index.add(read('/bt/tree', 2, { ...tree, generation: 2 }));
  expect(index.stateAt(1).files).toEqual({ 'project/trees/Main.json': 'first' });
  expect(index.stateAt(2).files).toEqual({
    'project/trees/Main.json': 'second',
    'project/trees/Leg.json': 'leg',
  });
});

it('marks faults, collisions, ends and flags, and names the node of a line', () => {
  const index = new SegmentIndex(0, 0);
  index.add(read('/bt/tree', 0, tree));
  const line = (source: string, text: string, uid = 0) => ({ source, level: 'info', text, uid });
  index.add(read('/bt/log', 1, line('action', 'hello', 2)));
  index.add(read('/bt/log', 1, line('world', 'robot bumped into crate')));
  index.add(read('/bt/log', 2, line('flag', 'here')));
  index.add(read('/bt/fault', 3, { kind: 'exception', uid: 2, message: 'no', line: 1 }));
  index.add(read('/bt/log', 4, line('session', 'The tree ended with FAILURE.')));
  expect(index.marks.map(({ kind, t }) => [kind, t])).toEqual([
    ['collision', 1],
    ['flag', 2],
    ['fault', 3],
    ['finished', 4],
  ]);
  expect(index.lines[0]!.path).toBe('/a');
  expect(isCollision({ source: 'action', text: 'I bumped into it' })).toBe(false);
});

it('shows a line and a fault that were written late at the time when they happened', () => {
  const index = new SegmentIndex(0, 0);
  const stamp = { sec: 1, nanosec: 345_833_333 };
  const line = { source: 'world', level: 'warning', text: 'robot bumped into crate', uid: 0 };
  index.add(read('/bt/log', 1.6, { ...line, stamp }));
  index.add(read('/bt/fault', 1.7, { kind: 'exception', uid: 2, message: 'no', line: 1, stamp }));
  index.add(read('/bt/log', 1.8, { ...line, stamp: { sec: 9, nanosec: 0 } })); // of a damaged file
  index.add(read('/bt/log', 1.9, { ...line, stamp: 'no time' }));
  const then = 1_345_833_333 / 1e9;
  expect(index.marks.map(({ t }) => t)).toEqual([then, then, 1.8, 1.9]);
  expect(index.lines.map(({ t }) => t)).toEqual([then, 1.8, 1.9]);
  expect(index.faults.map(({ t }) => t)).toEqual([then]);
});

it('keeps a flag at its own moment, which is before it was set, and marks a gap', () => {
  const index = new SegmentIndex(0, 0);
  const moment = { sec: 1, nanosec: 500_000_000 };
  index.add(read('/bt/flag', 4, { moment, id: 'f1', text: 'here', user: 'ada' }));
  index.add(read('/bt/gap', 5, { reason: 'recorder_died', text: 'It was killed.' }));
  expect(index.flags).toEqual([{ t: 1.5, kind: 'flag', id: 'f1', text: 'here', user: 'ada' }]);
  expect(index.marks).toEqual([{ t: 5, kind: 'stopped', text: 'It was killed.' }]);
});

it('refuses times that run backwards', () => {
  const index = new SegmentIndex(0, 0);
  index.add(read('/scan', 2, {}));
  expect(() => index.add(read('/scan', 1, {}))).toThrow('time runs backwards');
});

it('knows the last write of a key up to a step', () => {
  const index = new SegmentIndex(0, 0);
  const write = (key: string, removed = false) => ({
    scope: [''],
    key: [key],
    type: ['int'],
    value_json: ['1'],
    removed: [removed ? 1 : 0],
    writer_uid: [4],
  });
  index.add(read('/bt/blackboard', 1, write('k')));
  index.add(read('/bt/blackboard', 2, write('other')));
  index.add(read('/bt/blackboard', 3, write('k', true)));
  const id = entryId({ scope: '', key: 'k' });
  expect(index.lastWrite(id, 0)).toEqual({ t: 1, writer: 4, isRemoved: false, at: 0 });
  expect(index.lastWrite(id, 1)).toEqual({ t: 1, writer: 4, isRemoved: false, at: 0 });
  expect(index.lastWrite(id)).toEqual({ t: 3, writer: 4, isRemoved: true, at: 2 });
  expect(index.lastWrite('other')).toBeNull();
});

/** A run of two nodes with keyframes, halts and several ticks of one time, and what an observer saw of it. */
function randomRun(seed: number) {
  let state = seed;
  const chance = (below: number) => {
    state = (state * 1103515245 + 12345) & 0x7fffffff;
    return Math.floor((state / 0x7fffffff) * below);
  };
  const index = new SegmentIndex(0, 0);
  const statuses = new Map<number, number>();
  const values = new Map<string, number>();
  const seen: { t: number; tick: number; shown: unknown }[] = [];
  let [t, number] = [0, 0];
  const keyframe = () =>
    index.add(
      read('/bt/keyframe', t, {
        tick: number,
        status: [1, 2].map((uid) => statuses.get(uid) ?? 0),
        blackboard_json: JSON.stringify([...values].map(([key, value]) => ['', key, 'int', value])),
      }),
    );
  index.add(read('/bt/tree', 0, tree));
  keyframe();
  for (let round = 0; round < 60; round += 1) {
    t += chance(3) * 0.5;
    if (chance(4) === 0) keyframe();
    const isHalt = number > 0 && chance(5) === 0;
    if (!isHalt) number += 1;
    if (chance(2) === 0) {
      const key = 'ab'[chance(2)]!;
      values.set(key, round);
      const write = { scope: [''], key: [key], type: ['int'], value_json: [String(round)] };
      index.add(read('/bt/blackboard', t, { ...write, removed: [0], writer_uid: [2] }));
    }
    const uid = 1 + chance(2);
    const was = STATUSES[statuses.get(uid) ?? 0];
    const code = isHalt ? 0 : chance(4);
    statuses.set(uid, code);
    index.add(read('/bt/tick', t, { number, changed_uid: [uid], changed_status: [code] }));
    const names = [...statuses].map(([each, status]) => [each, STATUSES[status]]);
    const shown = {
      number,
      isHalted: isHalt,
      was: [[uid, was]],
      statuses: new Map(names.filter(([, name]) => name !== 'IDLE') as [number, string][]),
      values: new Map(values),
    };
    // A halt has the number of its tick, so only their times distinguish the two.
    if (seen.at(-1)?.t === t) seen.pop();
    seen.push({ t, tick: number, shown });
  }
  return { index, seen };
}

it.each([1, 2, 3, 4, 5, 6, 7, 8])('shows the same from a keyframe as from the begin (run %i)', (seed) => {
  const { index, seen } = randomRun(seed);
  for (const { t, shown } of seen) {
    const { number, halted, was, statuses, entries } = index.stateAt(t);
    const values = new Map([...entries.values()].map(({ key, value }) => [key, value]));
    expect({ number, isHalted: halted !== null, was, statuses, values }).toEqual(shown);
  }
});

it('takes poses from the last frame that has all of them', () => {
  const index = new SegmentIndex(0, 0);
  const frame = (t: number, ids: number[]) =>
    index.add(
      read('/world/poses', t, {
        data: encode({
          ids: new Uint8Array(Uint16Array.from(ids).buffer),
          poses: Uint8Array.from({ length: ids.length * 16 }, () => Math.round(t)),
        }),
      }),
    );
  frame(0, [3, 5]);
  frame(10, [5]);
  frame(20, [3, 5]);
  frame(30, [3]);
  const firstBytes = (t: number) => {
    const { ids, poses } = index.posesAt(t)!;
    const list = Array.from(new Uint16Array(ids.slice().buffer));
    return Object.fromEntries(list.map((id, at) => [id, poses[at * 16]]));
  };
  expect(firstBytes(15)).toEqual({ 3: 0, 5: 10 });
  expect(firstBytes(25)).toEqual({ 3: 20, 5: 20 });
  expect(firstBytes(35)).toEqual({ 3: 30, 5: 20 });
});

it('marks where the tree was held, and not the steps from there, nor other inputs', () => {
  const index = new SegmentIndex(0, 0);
  const hold = (t: number, tick: number, hook: number, data: unknown) =>
    index.add(read('/bt/input', t, { command: 'hold', tick, hook, data_json: JSON.stringify(data) }));
  hold(1, 7, 0, { uid: 2, path: '/a', event: 'before', why: 'breakpoint before its tick' });
  hold(1, 7, 1, { uid: 2, path: '/a', event: 'after', why: 'step over' });
  hold(1.05, 8, 0, { uid: 1, path: '/', event: 'before', why: 'one tick' });
  index.add(read('/bt/input', 2, { command: 'force', tick: 8, hook: 0, data_json: '{"uid":1}' }));
  index.add(read('/bt/input', 3, { command: 'hold', tick: 9, hook: 0, data_json: '{' }));
  expect(index.marks).toEqual([
    { t: 1, kind: 'held', text: '/a: breakpoint before its tick', uid: 2, tick: 7 },
    { t: 3, kind: 'held', text: '', tick: 9 },
  ]);
});

it('marks the tick from which on a result was forced, and the ticks tell what was forced', () => {
  const index = new SegmentIndex(0, 0);
  const fields = { type: ['Sequence', 'Turn'], path: ['/s', '/s/turn'], uid: [1, 2], parent: [0, 1] };
  index.add(read('/bt/tree', 0, { generation: 1, ...fields }));
  const tick = (number: number, uid: readonly number[]) => {
    if (uid.length > 0) index.add(read('/bt/forced', number, { tick: number, uid }));
    index.add(read('/bt/tick', number, { number, changed_uid: [], flashed_uid: [] }));
  };
  [[], [2], [2], [], [2]].forEach((uid, at) => tick(at + 1, uid));
  const mark = { kind: 'forced', text: '/s/turn', uid: 2 };
  expect(index.marks).toEqual([
    { ...mark, t: 2, tick: 2 },
    { ...mark, t: 5, tick: 5 },
  ]);
  expect([2, 3, 4, 5].map((t) => index.stateAt(t).tick?.forced)).toEqual([[2], [2], undefined, [2]]);
});

it('keeps what the last tick left behind over the halt of the tree, also behind a keyframe', () => {
  const index = new SegmentIndex(0, 0);
  const tick = (t: number, number: number, uid: number[], status: number[], flash: number[] = []) =>
    index.add(
      read('/bt/tick', t, {
        ...{ number, changed_uid: uid, changed_status: status },
        ...{ flashed_uid: flash, flashed_status: flash.map(() => 3) },
      }),
    );
  index.add(read('/bt/tree', 0, { generation: 1, uid: [1, 2, 3], parent: [0, 1, 1] }));
  tick(1, 7, [1, 2], [1, 1]);
  tick(2, 8, [2, 3], [2, 1], [3]);
  index.add(read('/bt/keyframe', 2, { tick: 8, status: [1, 2, 1], blackboard_json: '[]' }));
  tick(2, 8, [1, 2, 3], [0, 0, 0]);
  const { statuses, halted } = index.stateAt(2);
  expect(statuses.size).toBe(0);
  expect(halted).toEqual({
    statuses: [
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
      [3, 'RUNNING'],
    ],
    was: [
      [2, 'RUNNING'],
      [3, 'IDLE'],
    ],
    flashes: [[3, 'FAILURE']],
    forced: [],
  });
  expect(index.stateAt(1).halted).toBeNull();
});
