import { expect, it } from 'vitest';
import type { Fields } from './cdr';
import { entryId, isCollision, SegmentIndex } from './segmentIndex';
import type { Read } from './segmentReader';

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

it('knows the last write of a key up to a time', () => {
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
  expect(index.lastWrite(id, 0.9)).toBeNull();
  expect(index.lastWrite(id, 2.5)).toEqual({ t: 1, writer: 4, isRemoved: false });
  expect(index.lastWrite(id, 3)).toEqual({ t: 3, writer: 4, isRemoved: true });
});
