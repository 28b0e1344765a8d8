import { readFileSync } from 'node:fs';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { Engine } from '@/store/recording/engine';
import { liveSource } from '@/store/recording/liveSource';
import type { EngineLink } from '@/store/recording/recordedRun';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { seriesKey, seriesOf, useTopicsStore } from '@/store/session/topics';
import { segmentOf } from '../../../harness/runs';
import { followPresent, lookAt, lookNow, openKept, setEngineLink } from './looking';
import {
  allPastSamples,
  followPastTopics,
  pastRange,
  pastSamples,
  usePastTopics,
  wantRange,
} from './pastTopics';
import { noRange, useRange } from './range';

const file = new Uint8Array(readFileSync('../tests/executor/recorder/samples/v3.mcap'));
const segment = segmentOf({ run: 'a', to_t: 1, bytes: file.length });
const speed = { topic: '/cmd_vel', path: 'linear.x' };
const place = { topic: '/odom', path: 'pose.pose.position.x' };

let stops: (() => void)[] = [];

beforeEach(() => {
  vi.spyOn(liveSource, 'read').mockImplementation((_, offset, length) =>
    Promise.resolve(file.slice(offset, offset + length)),
  );
  setEngineLink(() => {
    const link: EngineLink = { post: (message) => engine.receive(message), onMessage: () => {} };
    const engine = new Engine((message) => queueMicrotask(() => link.onMessage(message)));
    return link;
  });
  useSessionStore.setState({ segments: [segment], simTime: 1 });
  stops = [followPresent(), followPastTopics()];
});

afterEach(() => {
  for (const stop of stops.toReversed()) stop();
  useSessionStore.setState(initialSession, true);
  useTopicsStore.setState(useTopicsStore.getInitialState(), true);
  useRange.setState(noRange);
});

const plot = (...plotted: (typeof speed)[]) => useTopicsStore.setState({ plotted });
const drawn = ({ topic, path }: typeof speed) => pastSamples(topic, path);
const past = () => usePastTopics.getState();

it('has nothing of the past while the page shows the present', () => {
  plot(speed);
  expect(past()).toMatchObject({ isKnown: false, topics: [] });
  expect(past().series.size).toBe(0);
});

it('lists the recorded topics, without those of the tree and pictures', async () => {
  lookAt(0.5);
  await vi.waitFor(() => expect(past().isKnown).toBe(true));
  await vi.waitFor(() => expect(past().topics.map(({ name }) => name)).toContain('/odom'), 3000);
  const names = past().topics.map(({ name }) => name);
  expect(names.filter((name) => /^\/(bt|world|camera)/.test(name))).toEqual([]);
  expect(past().topics.find(({ name }) => name === '/odom')?.hz).toBeCloseTo(30);
});

it('shows the message of the moment, and no later one', async () => {
  useTopicsStore.setState({ echoes: { '/odom': { topic: '/odom', last: null, count: 0 } } });
  for (const t of [0.5, 0.2]) {
    lookAt(t);
    await vi.waitFor(() => expect(past().messages['/odom']?.t).toBeCloseTo(t, 1));
    expect(past().messages['/odom']?.t).toBeLessThanOrEqual(t);
  }
  lookNow();
  expect(past().messages).toEqual({});
});

it('draws the fields of the whole run, also of a kept one without a session', async () => {
  useSessionStore.setState({ segments: [] });
  const source = { ...liveSource, segments: () => [segment], subscribe: () => () => {}, isOneFile: true };
  openKept(source, { id: 'k', name: 'Kept' }, 0.9);
  plot(speed, place);
  await vi.waitFor(() => expect(drawn(speed).times).toHaveLength(20), 3000);
  expect(drawn(place).times).toHaveLength(31);
  expect(drawn(place).times.at(-1)).toBeCloseTo(1);
  expect(drawn(place).values.every((value) => typeof value === 'number')).toBe(true);
  await vi.waitFor(() => expect(past().isReading).toBe(false));
  expect((await allPastSamples([speed])).get(seriesKey(speed.topic, speed.path))).toMatchObject(drawn(speed));
});

it('draws what the page heard of a topic that is not in the recording of the present run', async () => {
  const own = { topic: '/own', path: 'data' };
  Object.assign(seriesOf('/own', 'data'), { times: [1], values: [7] });
  plot(own);
  lookAt(0.5);
  await vi.waitFor(() => expect(past().series.get(seriesKey('/own', 'data'))?.lack).toBe('topic'), 3000);
  expect(drawn(own)).toMatchObject({ times: [1], values: [7] });
});

it('shows the part of the run that the time axis shows', () => {
  expect(pastRange()).toEqual({ min: 0, max: 1 });
  useRange.setState({ view: { from: 0.25, to: 0.5 } });
  expect(pastRange()).toEqual({ min: 0.25, max: 0.5 });
  useRange.setState({ view: null });
  useSessionStore.setState({ segments: [] });
  expect(pastRange()).toBeNull();
});

it('reads a shorter range again only if samples were left out', async () => {
  const asked = vi.spyOn(Engine.prototype, 'receive');
  const times = () =>
    asked.mock.calls.filter(([message]) => message.kind === 'ask' && message.ask.what === 'series').length;
  plot(speed);
  lookAt(0.5);
  await vi.waitFor(() => expect(drawn(speed).times).toHaveLength(20), 3000);
  const before = times();
  wantRange({ min: 0.2, max: 0.4 });
  expect(times()).toBe(before);
  const many = Array.from({ length: 20_000 }, (_, at) => at);
  usePastTopics.setState({ series: new Map([['x', { times: many, values: many, lack: null }]]) });
  wantRange({ min: 0.2, max: 0.4 });
  await vi.waitFor(() => expect(drawn(speed).times.length).toBeLessThan(10), 3000);
  wantRange(null);
  await vi.waitFor(() => expect(drawn(speed).times).toHaveLength(20), 3000);
});
