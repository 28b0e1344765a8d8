import { readFileSync } from 'node:fs';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
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
  followWrites,
  goSeconds,
  goTicks,
  goToChangeOfPresentRun,
  goToFault,
  lookAt,
  lookAtPresentRun,
  lookNow,
  openKept,
  openRun,
  setEngineLink,
  storyUntilNow,
} from './looking';
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
  openRun('a', 0.5);
  await shown(0.5);
  await goToChangeOfPresentRun(1, -1);
  expect(extent()).toMatchObject({ run: 'b' });
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
