import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { RunIndex } from './runIndex';
import { SegmentIndex } from './segmentIndex';
import { SegmentReader } from './segmentReader';
import type { Step } from './steps';
import { storyUntil } from './story';
import type { StatusOf } from './types';

const node = (uid: number) => ({
  ...{ uid, parent: uid - 1, type: 'Sequence', kind: 'Control', name: `n${uid}`, path: `n${uid}` },
  ...{ node_id: `n${uid}`, tree_id: 'Main', ports: {} },
});
const tree = (t: number, generation = 1): Step => ({
  kind: 'tree',
  t,
  generation,
  nodes: [node(1), node(2)],
  files: {},
});
const tick = (number: number, changed: readonly StatusOf[] = [], t = number): Step => ({
  ...{ kind: 'tick', t, number, durationMs: 1, changed, flashed: [] },
});
const keyframe = (t: number, at: number, status: readonly number[], value: unknown = 1): Step => ({
  ...{ kind: 'keyframe', t, tick: at, status },
  entries: [{ scope: '', key: 'k', type: 'int', value, isPreview: false }],
});
const write = (t: number, value: number): Step => ({
  kind: 'writes',
  t,
  writes: [{ scope: '', key: 'k', type: 'int', value, isPreview: false, isRemoved: false, writer: 2 }],
});

function segment(number: number, ...steps: Step[]): SegmentIndex {
  const made = new SegmentIndex(number, steps[0]?.t ?? 0);
  made.steps.push(...steps);
  return made;
}
const numbers = (...args: Parameters<typeof storyUntil>) =>
  storyUntil(...args)?.ticks.map((each) => each.number);

describe('storyUntil', () => {
  it('tells the ticks until a moment with their writes, from the first one on', () => {
    const one = segment(0, tree(0), write(1, 5), tick(1, [[1, 'RUNNING']]), tick(2), tick(3));
    const story = storyUntil([one], 2, null)!;
    expect(story).toMatchObject({ isWhole: true, statuses: [], entries: [] });
    expect(story.ticks.map(({ number, writes }) => [number, writes.map(({ value }) => value)])).toEqual([
      [1, [5]],
      [2, []],
    ]);
    expect(storyUntil([one], 0.5, null)).toBeNull();
  });

  it('ends with the wanted one of several ticks of one time', () => {
    const one = segment(0, tree(0), tick(1, [], 1), tick(2, [], 1), tick(3, [], 1));
    expect(numbers([one], 1, 2)).toEqual([1, 2]);
    expect(numbers([one], 1, null)).toEqual([1, 2, 3]);
  });

  it('continues over segments that follow each other', () => {
    const first = segment(0, tree(0), tick(1), tick(2, [[1, 'RUNNING']]));
    const second = segment(1, tree(3), keyframe(3, 2, [1, 0]), tick(3), tick(4));
    expect(storyUntil([first, second], 9, null)).toMatchObject({ isWhole: true });
    expect(numbers([first, second], 9, null)).toEqual([1, 2, 3, 4]);
  });

  it('begins after a gap, with the state that was there', () => {
    const first = segment(0, tree(0), tick(1), tick(2));
    const third = segment(2, tree(7), keyframe(7, 6, [1, 2], 8), tick(7), tick(8));
    const story = storyUntil([first, third], 9, null)!;
    expect(story.ticks.map(({ number }) => number)).toEqual([7, 8]);
    expect(story.isWhole).toBe(false);
    expect(story.statuses).toEqual([
      [1, 'RUNNING'],
      [2, 'SUCCESS'],
    ]);
    expect(story.entries.map(({ value }) => value)).toEqual([8]);
    const lost = segment(0, tree(0), tick(1, [[2, 'FAILURE']]), tick(2), tick(5), tick(6));
    expect(storyUntil([lost], 9, null)).toMatchObject({ isWhole: false, statuses: [[2, 'FAILURE']] });
    expect(numbers([lost], 9, null)).toEqual([5, 6]);
  });

  it('begins with the tree that ran at the moment', () => {
    const one = segment(0, tree(0), tick(1, [[1, 'RUNNING']]), tree(2, 2), tick(1, [], 3), tick(2, [], 4));
    const story = storyUntil([one], 9, null)!;
    expect(story.ticks.map(({ t }) => t)).toEqual([3, 4]);
    expect(story).toMatchObject({ isWhole: true, statuses: [] });
  });

  it('leaves out the halt after the last tick', () => {
    const one = segment(0, tree(0), tick(1), tick(2), tick(2, [[1, 'IDLE']], 3));
    expect(numbers([one], 9, null)).toEqual([1, 2]);
  });
});

it('tells each tick of a real recording as its moments show it', () => {
  const index = new RunIndex('r');
  const first = index.segment(0, 0);
  new SegmentReader('sample', (read) => first.add(read)).append(
    new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap')),
  );
  const end = first.until;
  const story = index.storyUntil(end)!;
  expect(story.isWhole).toBe(true);
  expect(story.ticks.length).toBeGreaterThan(10);
  const statuses = new Map(story.statuses);
  for (const { t, number, changed } of story.ticks) {
    changed.forEach(([uid, status]) => statuses.set(uid, status));
    const shown = index.momentAt(t, -1, number)!;
    const active = [...statuses].filter(([, status]) => status !== 'IDLE');
    expect(Object.fromEntries(active)).toEqual(Object.fromEntries(shown.statuses));
  }
});
