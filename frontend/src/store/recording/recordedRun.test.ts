import { readFileSync } from 'node:fs';
import { expect, it, vi } from 'vitest';
import type { Segment } from '@/generated/messages';
import { longRecording } from '../../../harness/recordings';
import { Engine } from './engine';
import { RecordedRun, type EngineLink } from './recordedRun';
import type { Overview } from './types';

const file = new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap'));

function segment(number: number, more: Partial<Segment> = {}): Segment {
  const times = { from_t: number * 20, to_t: number * 20 + 20 };
  return {
    run: 'a',
    branch: 0,
    number,
    version: 0,
    ...times,
    bytes: file.length,
    complete: true,
    run_number: 1,
    result: null,
    ...more,
  };
}

function setUp(first: Segment[], fails = false) {
  let segments = first;
  let changed = () => {};
  const asked: [number, number][] = [];
  const link: EngineLink = { post: (message) => engine.receive(message), onMessage: () => {} };
  const engine = new Engine((message) => link.onMessage(message));
  const overviews: Overview[] = [];
  const failures: string[] = [];
  const run = new RecordedRun(
    {
      segments: () => segments,
      subscribe: (callback) => {
        changed = callback;
        return () => {};
      },
      read: ({ number, bytes }, offset, length) => {
        asked.push([number, offset]);
        if (fails) return Promise.reject(new Error('gone'));
        return Promise.resolve(file.slice(offset, Math.min(offset + length, bytes)));
      },
    },
    link,
    (overview) => overviews.push(overview),
    (failure) => failures.push(failure),
    1,
  );
  const set = (next: Segment[]) => {
    segments = next;
    changed();
  };
  return { run, asked, overviews, failures, set };
}

it('reads nothing for a page that shows the present', () => {
  const { asked, set } = setUp([segment(0)]);
  set([segment(0), segment(1)]);
  expect(asked).toEqual([]);
});

it('reads the part that is wanted first, then those before it, then the others', async () => {
  const { run, asked } = setUp([segment(0), segment(1), segment(2), segment(3)]);
  run.want(45);
  await vi.waitFor(() => expect(asked.map(([number]) => number)).toEqual([2, 1, 0, 3]));
});

it('continues a segment that grows', async () => {
  const half = segment(0, { bytes: 100_000, complete: false, run_number: 1, to_t: 0.5 });
  const { run, asked, overviews, set } = setUp([half]);
  run.want(0.2);
  await vi.waitFor(() => expect(overviews).toHaveLength(1));
  set([segment(0, { to_t: 1 })]);
  await vi.waitFor(() =>
    expect(asked).toEqual([
      [0, 0],
      [0, 100_000],
    ]),
  );
  expect((await run.ask({ what: 'moment', t: 0.9, tick: null, known: -1 }))!.tick).toBeGreaterThan(10);
});

it('keeps what it read of a segment that was thinned, and drops one that is gone', async () => {
  const { run, asked, set } = setUp([segment(0)]);
  run.want(0.5);
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  await vi.waitFor(async () =>
    expect(await run.ask({ what: 'moment', t: 0.5, tick: null, known: -1 })).not.toBeNull(),
  );
  set([segment(0, { version: 1, bytes: 1000 })]);
  expect(asked).toHaveLength(1);
  set([segment(1, { from_t: 20 })]);
  await vi.waitFor(async () =>
    expect(await run.ask({ what: 'moment', t: 0.5, tick: null, known: -1 })).toBeNull(),
  );
});

it('asks again for a part that was refused, and then says why', async () => {
  const { run, asked, failures, set } = setUp([segment(0)], true);
  run.want(1);
  await vi.waitFor(() => expect(failures).toEqual(['gone']));
  set([segment(0)]);
  run.want(2);
  expect(asked).toHaveLength(12);
});

it('begins again with another run', async () => {
  const { run, asked, set } = setUp([segment(0)]);
  run.want(1);
  await vi.waitFor(() => expect(asked).toHaveLength(1));
  set([segment(0, { run: 'b' })]);
  await vi.waitFor(() => expect(asked).toHaveLength(2));
});

it('reads a small part of a long file first, then as large ones as its source allows', async () => {
  const bytes = 12 << 20;
  const lengths: number[] = [];
  const link: EngineLink = {
    post: (message) =>
      message.kind === 'ask' && link.onMessage({ kind: 'answer', id: message.id, answer: null }),
    onMessage: () => {},
  };
  const run = new RecordedRun(
    {
      segments: () => [segment(0, { bytes })],
      subscribe: () => () => {},
      partBytes: 4 << 20,
      read: (...[, , length]) => {
        lengths.push(length);
        return Promise.resolve(new Uint8Array(length));
      },
    },
    link,
    () => {},
    () => {},
  );
  run.want(5);
  await vi.waitFor(() => expect(lengths.reduce((sum, each) => sum + each, 0)).toBe(bytes));
  expect(lengths).toEqual([1 << 20, 4 << 20, 4 << 20, 3 << 20]);
});

it('shows a moment of a long file before the parts up to it are read', async () => {
  const long = await longRecording(12);
  const read: [number, number][] = [];
  const link: EngineLink = { post: (message) => engine.receive(message), onMessage: () => {} };
  const engine = new Engine((message) => link.onMessage(message));
  const parts = new EventTarget();
  const run = new RecordedRun(
    {
      segments: () => [segment(0, { bytes: long.length, to_t: 12 })],
      subscribe: () => () => {},
      isOneFile: true,
      read: async (_, offset, length) => {
        read.push([offset, length]);
        // The parts in their order do not come.
        if (offset === 0) await new Promise((resolve) => parts.addEventListener('come', resolve));
        return long.slice(offset, offset + length);
      },
    },
    link,
    () => {},
    () => {},
    1,
  );
  const tickAt = async (t: number) =>
    (await run.ask({ what: 'moment', t, tick: null, known: -1 }))?.tick ?? null;
  run.want(8.5);
  await vi.waitFor(async () => expect(await tickAt(8.5)).toBeGreaterThan(5));
  expect(await tickAt(3.5)).toBeNull();
  const asked = read.length;
  run.want(8.45);
  run.want(8.5);
  expect(read.length).toBe(asked);
  run.want(3.5);
  await vi.waitFor(async () => expect(await tickAt(3.5)).toBeGreaterThan(5));
  parts.dispatchEvent(new Event('come'));
  await vi.waitFor(() => expect(run.hasUntil(12)).toBe(true));
  expect(await tickAt(11.5)).toBeGreaterThan(5);
});

it('reads the other parts of a long file after the wanted moment is there, also if it has no index', async () => {
  const long = await longRecording(12);
  const read: number[] = [];
  const link: EngineLink = { post: (message) => engine.receive(message), onMessage: () => {} };
  const engine = new Engine((message) => link.onMessage(message));
  const seeking = new EventTarget();
  let hasIndex = true;
  const open = () =>
    new RecordedRun(
      {
        segments: () => [segment(0, { bytes: long.length, to_t: 12 })],
        subscribe: () => () => {},
        isOneFile: true,
        read: async (_, offset, length) => {
          read.push(offset);
          if (offset !== 0 && !hasIndex) throw new Error('no index');
          if (offset !== 0) await new Promise((resolve) => seeking.addEventListener('come', resolve));
          return long.slice(offset, offset + length);
        },
      },
      link,
      () => {},
      () => {},
      1,
    );
  const run = open();
  run.want(8.5);
  await new Promise((resolve) => setTimeout(resolve, 60));
  expect(read).toHaveLength(1);
  expect(read[0]).toBeGreaterThan(0);
  const answer = setInterval(() => seeking.dispatchEvent(new Event('come')), 5);
  await vi.waitFor(() => expect(run.hasUntil(12)).toBe(true));
  clearInterval(answer);
  run.end();
  hasIndex = false;
  const other = open();
  other.want(8.5);
  await vi.waitFor(() => expect(other.hasUntil(12)).toBe(true));
});
