import { readFileSync } from 'node:fs';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { useLiveStore, usePastLive } from '@/store/project/live';
import { useProjectStore } from '@/store/project';
import { Engine } from '@/store/recording/engine';
import { liveSource } from '@/store/recording/liveSource';
import type { EngineLink } from '@/store/recording/recordedRun';
import type { WriteAt } from '@/store/recording/types';
import { shownFrames } from '@/store/session/frames';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import {
  extent,
  followPresent,
  followTimeline,
  followWrites,
  goSeconds,
  goTicks,
  goToChange,
  goToFault,
  lookAt,
  lookAtPresentRun,
  lookNow,
  openKept,
  openRun,
  setEngineLink,
  setPlaying,
  storyUntilNow,
} from './looking';
import { noRange, useRange } from './range';
import { usePastSession } from './session';
import { useSource } from './source';
import { isLookingBack, useMoment } from './store';

const file = new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap'));
const segment = (run = 'a') => segmentOf({ run, to_t: 1, bytes: file.length });

let stop = () => {};

beforeEach(() => {
  vi.spyOn(liveSource, 'read').mockImplementation((_, offset, length) =>
    Promise.resolve(file.slice(offset, offset + length)),
  );
  setEngineLink(() => {
    const link: EngineLink = { post: (message) => engine.receive(message), onMessage: () => {} };
    const engine = new Engine((message) => queueMicrotask(() => link.onMessage(message)));
    return link;
  });
  useSessionStore.setState({ segments: [segment()], simTime: 1 });
  stop = followPresent();
});

afterEach(() => {
  stop();
  useSessionStore.setState(initialSession, true);
});

const shown = (t: number) => vi.waitFor(() => expect(useMoment.getState().shown?.t).toBe(t));

it('takes times of the session, which are not in whole ns, for those of the recording', async () => {
  lookAt(1 / 3);
  await shown(333_333_333 / 1e9);
  lookAt(2 / 3);
  await shown(666_666_667 / 1e9);
});

it('shows a moment in all stores, and leaves those of the present alone', async () => {
  const before = useLiveStore.getState();
  lookAt(0.5);
  await shown(0.5);
  expect(usePastSession.getState()).toMatchObject({ simTime: 0.5, tick: useMoment.getState().shown!.tick });
  expect(Object.values(usePastSession.getState().blackboard).map(({ key }) => key)).toContain('offset');
  expect([...usePastLive.getState().statuses.values()]).toContain('RUNNING');
  expect(useLiveStore.getState()).toBe(before);
  expect(useSessionStore.getState().simTime).toBe(1);
});

it('stays within the run', async () => {
  expect(extent()).toEqual({ run: 'a', from: 0, to: 1 });
  lookAt(7);
  await shown(1);
  goSeconds(-3);
  await shown(0);
});

it('goes a tick at a time, from the present too', async () => {
  await goTicks(-1);
  await vi.waitFor(() => expect(useMoment.getState().shown?.t).toBeLessThan(1));
  const { t, tick } = useMoment.getState().shown!;
  await goTicks(-1);
  await vi.waitFor(() => expect(useMoment.getState().shown?.tick).toBe(tick - 1));
  await goTicks(1);
  await shown(t);
});

it('goes to the next and the previous change of a node', async () => {
  lookAt(0.5);
  await shown(0.5);
  const { uid } = useMoment.getState().tree.find(({ type }) => type === 'SeesLine')!;
  const times: number[] = [];
  while (await goToChange(uid, 1)) times.push(useMoment.getState().t!);
  const last = times.at(-1)!;
  expect(times).toEqual([...times].sort((a, b) => a - b));
  expect(times[0]).toBeGreaterThan(0.5);
  await goToChange(uid, -1);
  expect(useMoment.getState().t).toBeLessThan(last);
});

describe('playing', () => {
  let draw: FrameRequestCallback[] = [];
  /** Draws the next picture of the page, at a time in ms. */
  const drawAt = (ms: number) => draw.splice(0).forEach((paint) => paint(ms));

  beforeEach(() => {
    draw = [];
    vi.stubGlobal('requestAnimationFrame', (paint: FrameRequestCallback) => draw.push(paint));
  });
  afterEach(() => {
    setPlaying(false);
    useRange.setState(noRange);
    vi.unstubAllGlobals();
  });
  const begin = (t: number, speed: number) => {
    lookAt(t);
    useMoment.setState({ speed });
    setPlaying(true);
    drawAt(1000);
  };
  const t = () => useMoment.getState().t;

  it.each([
    [0.1, 0.21],
    [1, 0.3],
    [5, 0.7],
  ])('passes %s seconds in one', (speed, expected) => {
    begin(0.2, speed);
    drawAt(1100);
    expect(t()).toBeCloseTo(expected);
  });

  it('ends with the run, and begins again at its start', () => {
    begin(0.9, 10);
    drawAt(1100);
    expect([t(), useMoment.getState().isPlaying]).toEqual([1, false]);
    begin(1, 1);
    drawAt(1100);
    expect(t()).toBeCloseTo(0.1);
  });

  it('repeats the marked range while it loops', () => {
    useRange.setState({ a: 0.6, b: 0.4, isLooping: true });
    begin(0.55, 1);
    drawAt(1100);
    expect([t(), useMoment.getState().isPlaying]).toEqual([0.4, true]);
    drawAt(1150);
    expect(t()).toBeCloseTo(0.45);
  });
});

it('returns to the present by itself when the run is gone, or the user edits', () => {
  lookAt(0.5);
  useSessionStore.setState({ segments: [segment(), segment('b')] });
  expect(isLookingBack()).toBe(false);
  lookAt(0.5);
  expect(isLookingBack()).toBe(true);
  useProjectStore.setState(({ changeCounter }) => ({ changeCounter: changeCounter + 1 }));
  expect(isLookingBack()).toBe(false);
});

it('shows nothing without a recording', () => {
  useSessionStore.setState({ segments: [] });
  lookAt(1);
  lookNow();
  expect(isLookingBack()).toBe(false);
});

it('opens an earlier run of the session, and returns from it to the last one', async () => {
  useSessionStore.setState({ segments: [segment('a'), { ...segment('b'), to_t: 0.8 }] });
  openRun('a', 0.5);
  await shown(0.5);
  expect(extent()).toMatchObject({ run: 'a', to: 1 });
  expect(shownFrames.scene()?.type).toBe('scene');
  openRun('b');
  await shown(0);
  expect(extent()).toMatchObject({ run: 'b', to: 0.8 });
  expect(shownFrames.scene()).toBeNull();
  openRun('gone');
  expect(extent()?.run).toBe('b');
  openRun('a');
  useSessionStore.setState({ segments: [segment('b')] });
  expect(isLookingBack()).toBe(false);
  expect(extent()?.run).toBe('b');
});

it('tells what the tree did until now, or until the shown moment', async () => {
  const all = (await storyUntilNow())!;
  expect(useMoment.getState().t).toBeNull();
  expect(all.ticks.length).toBeGreaterThan(10);
  lookAt(0.5);
  await shown(0.5);
  const until = (await storyUntilNow())!;
  expect(until.ticks).toEqual(all.ticks.filter(({ t }) => t <= 0.5));
  expect(useMoment.getState().t).toBe(0.5);
  lookNow();
});

it('tells nothing without a recording', async () => {
  useSessionStore.setState({ segments: [] });
  expect(await storyUntilNow()).toBeNull();
});

it('opens a kept run without a session, and closes it in the present', async () => {
  useSessionStore.setState(initialSession, true);
  const kept = { ...segment('kept'), from_t: 0, to_t: 1 };
  const read = (_: unknown, offset: number, length: number) =>
    Promise.resolve(file.slice(offset, offset + length));
  openKept({ segments: () => [kept], subscribe: () => () => undefined, read }, { id: 'r1', name: 'First' });
  expect(extent()).toEqual({ run: 'kept', from: 0, to: 1 });
  expect(useSource.getState().kept?.name).toBe('First');
  lookAt(0.5);
  await shown(0.5);
  expect(Object.values(usePastSession.getState().blackboard).map(({ key }) => key)).toContain('offset');
  expect(useMoment.getState().trees['MainTree']?.isAttached).toBe(true);
  expect(useMoment.getState().scene?.type).toBe('scene');
  expect(shownFrames.scene()).toBe(useMoment.getState().scene);
  lookNow();
  expect(shownFrames.scene()).toBeNull();
  expect(useSource.getState()).toEqual({ source: liveSource, kept: null });
  expect(extent()).toBeNull();
});

it('leaves an earlier run for a moment of the last one', async () => {
  useSessionStore.setState({ segments: [segment('a'), { ...segment('b'), to_t: 0.8 }] });
  openRun('a', 0.5);
  await shown(0.5);
  lookAtPresentRun(0.3);
  await shown(0.3);
  expect(extent()).toMatchObject({ run: 'b' });
});

it('tells the timeline of a run that is open, until another one is', async () => {
  useSessionStore.setState({ segments: [segment('a'), { ...segment('b'), to_t: 0.8 }] });
  const told: [number | null, boolean][] = [];
  const end = followTimeline((timeline, isPresent) => told.push([timeline?.nodes.length ?? null, isPresent]));
  expect(told).toEqual([[null, true]]);
  openRun('a', 0.5);
  await shown(0.5);
  await vi.waitFor(() => expect(told.at(-1)?.[0]).toBeGreaterThan(2));
  expect(told.slice(0, 2)).toEqual([
    [null, true],
    [null, false],
  ]);
  lookNow();
  expect(told.at(-1)).toEqual([null, true]);
  end();
  const count = told.length;
  openRun('a', 0.5);
  await shown(0.5);
  expect(told).toHaveLength(count);
});

it('tells the writes of a key, the last one first, at the present too', async () => {
  const told: (readonly WriteAt[])[] = [];
  const end = followWrites({ scope: '', key: 'offset' }, (writes) => told.push(writes));
  await vi.waitFor(() => expect(told.at(-1)?.length).toBeGreaterThan(1));
  const writes = told.at(-1)!;
  expect(writes.map(({ t }) => t)).toEqual([...writes.map(({ t }) => t)].sort((a, b) => b - a));
  lookAt(writes[1]!.t);
  await shown(writes[1]!.t);
  const row = Object.values(usePastSession.getState().blackboard).find(({ key }) => key === 'offset')!;
  expect({ value: row.value, t: row.written?.t, by: row.written?.by }).toEqual({
    value: writes[1]!.value,
    t: writes[1]!.t,
    by: writes[1]!.by,
  });
  end();
  const count = told.length;
  lookAt(0.1);
  await shown(0.1);
  expect(told).toHaveLength(count);
});

it('says that a fault is not recorded, and stays at the present', async () => {
  expect(await goToFault('Something else')).toBe(false);
  expect(isLookingBack()).toBe(false);
});

it('keeps lists that are as before, so that their views are not drawn again', async () => {
  lookAt(0.5);
  await shown(0.5);
  const { tree, logs } = usePastSession.getState();
  const { faults } = usePastLive.getState();
  lookAt(0.52);
  await shown(0.52);
  expect(tree.length).toBeGreaterThan(0);
  expect(usePastSession.getState().tree).toBe(tree);
  expect(usePastSession.getState().logs).toBe(logs);
  expect(usePastLive.getState().faults).toBe(faults);
});
