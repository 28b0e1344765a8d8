import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { RunIndex } from './runIndex';
import { SegmentReader, type Read } from './segmentReader';
import { STATUSES, type Moment } from './types';

function sample(name = 'v1'): {
  index: RunIndex;
  raw: { topic: string; t: number; fields: Record<string, unknown> }[];
} {
  const index = new RunIndex('r');
  const segment = index.segment(0, 0);
  const raw: { topic: string; t: number; fields: Record<string, unknown> }[] = [];
  const take = (read: Read) => {
    segment.add(read);
    raw.push({ topic: read.topic, t: read.t, fields: read.decode() });
  };
  const reader = new SegmentReader('sample', take, (name, data) => segment.attach(name, data));
  reader.append(new Uint8Array(readFileSync(`../tests/executor/recorder/samples/${name}.mcap`)));
  return { index, raw };
}

const at = (index: RunIndex, t: number): Moment => index.momentAt(t)!;

it('shows at each tick what the ticks until then have told', () => {
  const { index, raw } = sample();
  const statuses = new Map<number, string>();
  for (const { topic, t, fields } of raw) {
    if (topic !== '/bt/tick') continue;
    const codes = fields['changed_status'] as ArrayLike<number>;
    Array.from(fields['changed_uid'] as ArrayLike<number>).forEach((uid, place) => {
      const status = STATUSES[codes[place]!]!;
      if (status === 'IDLE') statuses.delete(uid);
      else statuses.set(uid, status);
    });
    const moment = at(index, t);
    expect(Object.fromEntries(moment.statuses)).toEqual(Object.fromEntries(statuses));
    expect(moment.tick).toBe(fields['number']);
    expect(moment.tickT).toBe(t);
  }
});

it.each(['v2', 'v3'])('shows the world of %s, whose meshes and textures are attached', (name) => {
  const { scene } = at(sample(name).index, 0.5);
  const meshes = scene!.objects.flatMap(({ shapes }) => shapes.flatMap(({ mesh }) => mesh || []));
  expect(Object.keys(scene!.meshes).length + Object.keys(scene!.textures ?? {}).length).toBeGreaterThan(0);
  expect(meshes.filter((mesh) => !(mesh in scene!.meshes))).toEqual([]);
});

it('puts a world together again when the present one, whose parts stand in, comes', () => {
  const { index } = sample('v3');
  const { sceneId, scene } = at(index, 0.5);
  index.takePresent({ name: scene!.name, meshes: {} });
  const next = index.momentAt(0.5, -1, null, sceneId)!;
  expect(next.sceneId).not.toBe(sceneId);
  expect(next.scene).toEqual(scene);
});

it('shows the world, and sends it only to who has another one', () => {
  const { index } = sample();
  const { scene, sceneId } = at(index, 0.5);
  expect(scene).toMatchObject({ type: 'scene', sensors: [{ kind: 'lidar' }, { kind: 'camera' }] });
  expect(scene!.objects.length).toBeGreaterThan(100);
  expect(index.momentAt(1, -1, null, sceneId)).toMatchObject({ scene: null, sceneId });
});

it('shows each value with its writer and the time of its last write', () => {
  const { index, raw } = sample();
  const written = new Map<string, { t: number; value: unknown; writer: number }>();
  for (const { topic, t, fields } of raw) {
    if (topic === '/bt/blackboard')
      (fields['key'] as string[]).forEach((key, place) => {
        const value: unknown = JSON.parse((fields['value_json'] as string[])[place]!);
        written.set(key, { t, value, writer: (fields['writer_uid'] as number[])[place]! });
      });
    if (topic !== '/bt/tick') continue;
    const shown = at(index, t).entries.map(({ key, value, since, writer }) => [
      key,
      { t: since, value, writer },
    ]);
    expect(Object.fromEntries(shown)).toEqual(Object.fromEntries(written));
  }
  expect(written.size).toBeGreaterThan(0);
});

it('goes tick by tick, and to the changes of a node', () => {
  const { index, raw } = sample();
  const ticks = raw.filter(({ topic }) => topic === '/bt/tick').map(({ t }) => t);
  expect(index.tickFrom(ticks[3]!, 1)!.t).toBe(ticks[4]);
  expect(index.tickFrom(ticks[3]!, -1)!.t).toBe(ticks[2]);
  expect(index.tickFrom(ticks[3]! + 0.001, -1)!.t).toBe(ticks[2]);
  expect(index.tickFrom(ticks[3]!, -3)!.t).toBe(ticks[0]);
  expect(index.tickFrom(ticks.at(-1)!, 1)).toBeNull();
  const first = at(index, ticks[0]!).statuses[0]![0];
  expect(index.changeFrom(first, ticks.at(-1)!, -1)!.t).toBeLessThan(ticks.at(-1)!);
  expect(index.changeFrom(first, -1, 1)!.t).toBe(ticks[0]);
});

it('has poses, the scan and the picture of a moment', () => {
  const { index } = sample();
  const { poses, scan, pictures } = at(index, 0.75);
  expect(poses!.poses.length).toBe(poses!.ids.length * 8);
  expect(scan!.t).toBeLessThanOrEqual(0.75);
  expect(scan!.ranges.length).toBeGreaterThan(10);
  expect(pictures[0]!.jpeg.subarray(0, 2)).toEqual(new Uint8Array([0xff, 0xd8]));
});

it('sends a tree once', () => {
  const { index } = sample();
  const { tree, generation } = at(index, 0.5);
  expect(tree!.length).toBeGreaterThan(3);
  expect(index.momentAt(0.6, generation)!.tree).toBeNull();
});

it('tells the changes between two moments', () => {
  const { index } = sample();
  expect(index.changes(0.5, 0.5)).toEqual({ statuses: [], entries: [], poses: [] });
  expect(index.changes(0.05, 0.9)!.entries.length).toBeGreaterThan(0);
});

it('tells several ticks of one time apart', () => {
  const index = new RunIndex('r');
  const segment = index.segment(0, 0);
  const add = (topic: string, t: number, fields: Record<string, unknown>) =>
    segment.add({ topic, type: '', t, data: new Uint8Array(), decode: () => fields });
  add('/bt/tree', 0, { generation: 1, uid: [1], parent: [0] });
  [1, 3, 2].forEach((code, at) =>
    add('/bt/tick', 1, { number: at + 1, changed_uid: [1], changed_status: [code] }),
  );
  expect(index.momentAt(1)!.statuses).toEqual([[1, 'SUCCESS']]);
  expect(index.tickFrom(1, -1)).toEqual({ t: 1, tick: 2 });
  expect(index.momentAt(1, -1, 2)!.statuses).toEqual([[1, 'FAILURE']]);
  expect(index.tickFrom(1, -1, 2)).toEqual({ t: 1, tick: 1 });
  expect(index.tickFrom(1, 1, 1)).toEqual({ t: 1, tick: 2 });
});

it('knows since when a value is there, also where the tree was written again', () => {
  const index = new RunIndex('r');
  const segment = index.segment(0, 0);
  const add = (topic: string, t: number, fields: Record<string, unknown>) =>
    segment.add({ topic, type: '', t, data: new Uint8Array(), decode: () => fields });
  const tree = { generation: 1, uid: [1], parent: [0] };
  add('/bt/tree', 0, tree);
  const entry = { scope: [''], key: ['k'], type: ['int'], value_json: ['3'] };
  add('/bt/blackboard', 1, { ...entry, removed: [0], writer_uid: [1] });
  add('/bt/tick', 1, { number: 1 });
  // Files that are joined from segments repeat tree and keyframe.
  add('/bt/tree', 20, tree);
  add('/bt/keyframe', 20, { tick: 1, status: [1], blackboard_json: '[["","k","int",3]]' });
  expect(index.momentAt(20)!.entries).toMatchObject([{ key: 'k', value: 3, since: 1, writer: 1 }]);
});

it('has the flags that were not removed, and the gaps, as marks', () => {
  const { marks } = sample('v3').index.overview();
  expect(marks.map(({ kind, t, text, user }) => [kind, t, text, user])).toEqual([
    ['stopped', 1, 'was killed by SIGKILL', undefined],
    ['flag', 0.5, 'The line bends here', 'ada'],
  ]);
});

it('puts the mark of a hold at the moment of its tick, once that has ended', () => {
  const index = new RunIndex('r');
  const segment = index.segment(0, 0);
  const add = (topic: string, t: number, fields: Record<string, unknown>) =>
    segment.add({ topic, type: '', t, data: new Uint8Array(), decode: () => fields });
  const hold = { command: 'hold', hook: 0, data_json: '{"uid":1,"path":"/","why":"breakpoint before"}' };
  add('/bt/tree', 0, { generation: 1, uid: [1], parent: [0] });
  add('/bt/input', 1, { ...hold, tick: 4 });
  const times = () => index.overview().marks.map(({ kind, t }) => [kind, t]);
  expect(times()).toEqual([['held', 1]]);
  add('/bt/tick', 1.05, { number: 4 });
  expect(times()).toEqual([['held', 1.05]]);
});

it('adds the times of nodes in a part that was read', () => {
  const { index } = sample();
  const tree = index.momentAt(1)!.tree!;
  const row = (t: number, self: number) => ({
    topic: '/bt/profile',
    type: 'bt_studio_msgs/msg/Profile',
    t,
    data: new Uint8Array(),
    decode: () => ({
      generation: index.momentAt(1)!.generation,
      ticks: 10,
      uid: [1],
      calls: [10],
      total_ms: [self],
      self_ms: [self],
    }),
  });
  const segment = index.segment(0, 0);
  const end = segment.until;
  segment.add(row(end + 0.5, 2));
  segment.add(row(end + 1, 3));
  segment.to = end + 1;
  expect(index.profile(end, end + 1)).toMatchObject({ ticks: 20, tick_ms: 5, tree });
  expect(index.profile(end, end + 0.5)).toMatchObject({ ticks: 10, tick_ms: 2 });
  expect(index.profile(0, 0.5)).toMatchObject({ ticks: 0, nodes: [] });
  expect(index.profile(0, end + 99)).toBeNull();
});
