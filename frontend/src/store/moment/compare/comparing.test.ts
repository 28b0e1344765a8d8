import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import type { FromEngine, ToEngine } from '@/store/recording/engine';
import { liveSource } from '@/store/recording/liveSource';
import type { Overview } from '@/store/recording/types';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { useShownPaths } from '@/store/session/trace/shownPaths';
import { treeNode } from '../../../../harness/running';
import { segmentOf } from '../../../../harness/runs';
import { followPresent, lookAt, lookNow, openRun, setEngineLink } from '../looking';
import { useMoment } from '../store';
import {
  canCompare,
  comparableRuns,
  compareSomething,
  compareWith,
  endComparing,
  leaveMoment,
  useComparing,
} from './comparing';

/** What the second block does, by run. */
const DOES: Record<string, NodeStatus> = { a: 'RUNNING', b: 'FAILURE', c: 'RUNNING' };
const overviewOf = (run: string): Overview => ({
  ...{ run, read: [[0, 9]], root: [], marks: [], lines: [], faults: [] },
});

let haltedRun = '';
let ticksFrom = 0;

/** An engine of which only the answers are known. */
function fakeLink() {
  let run = '';
  const answers = {
    ready: () => null,
    moment: (t: number) => ({
      ...{ t, tick: 1, tickT: t < ticksFrom ? null : t, durationMs: 1, generation: 1, files: {} },
      halted: run === haltedRun ? {} : null,
      tree: [treeNode(1, 0, 'root'), treeNode(2, 1, 'drive')].map((node) => ({ ...node, ports: {} })),
      statuses: [
        [1, 'RUNNING'],
        [2, DOES[run]],
      ],
      ...{
        flashes: [],
        was: [],
        entries: [],
        scene: null,
        sceneId: -1,
        poses: null,
        scan: null,
        pictures: [],
      },
    }),
    trails: () => ({ robot: Float32Array.of(0, 0, 2, 1, 1, 0, 4, 0, run === 'b' ? 5 : 2, 0, 6, 0) }),
  };
  const link = {
    onMessage: (_: FromEngine): void => {},
    post: (message: ToEngine) => {
      if (message.kind === 'begin') run = message.run;
      if (message.kind === 'part')
        queueMicrotask(() => link.onMessage({ kind: 'overview', overview: overviewOf(run) }));
      if (message.kind !== 'ask') return;
      const { id, ask } = message;
      const answer =
        ask.what === 'moment' ? answers.moment(ask.t) : ask.what === 'trails' ? answers.trails() : null;
      queueMicrotask(() => link.onMessage({ kind: 'answer', id, answer: answer as never }));
    },
  };
  return link;
}

const segments = [
  segmentOf({ run: 'a', to_t: 9, run_number: 1 }),
  segmentOf({ run: 'alone', to_t: 9, run_number: 2 }),
  segmentOf({ run: 'b', from_t: 3, to_t: 7, run_number: 3 }),
  segmentOf({ run: 'c', from_t: 5, to_t: 8, run_number: 4 }),
];
const branchOf = (run: string, from_t: number, name = '') => ({
  ...{ run, parent: 'a', from_t, name, is_gone: false },
});
let stop = () => {};

beforeEach(() => {
  vi.spyOn(liveSource, 'read').mockImplementation((_, __, length) => Promise.resolve(new Uint8Array(length)));
  setEngineLink(fakeLink);
  useSessionStore.setState({ segments, branches: [branchOf('b', 3, 'wider'), branchOf('c', 5)] });
  stop = followPresent();
});
afterEach(() => {
  haltedRun = '';
  ticksFrom = 0;
  endComparing();
  lookNow();
  stop();
  useSessionStore.setState(initialSession, true);
});
const shows = (state: string) => vi.waitFor(() => expect(useComparing.getState().state).toBe(state));

it('compares runs that have a past in common, at the last moment of both', async () => {
  expect(canCompare()).toBe(true);
  expect(comparableRuns()).toEqual(['b', 'a']);
  compareWith('alone');
  expect(useComparing.getState().other).toBeNull();
  compareWith('b');
  expect(useMoment.getState().t).toBeCloseTo(6.9);
  await shows('shown');
  expect(useComparing.getState()).toMatchObject({ other: 'b', partedAt: 3, otherEnd: 7 });
  expect(useComparing.getState().rows).toMatchObject([{ node: 'n2', here: 'RUNNING', there: 'FAILURE' }]);
  expect([...useComparing.getState().blocks]).toEqual([['Main/n2', 'FAILURE']]);
});

it('draws both paths from where they part, also those of the run before', async () => {
  compareWith('b');
  await vi.waitFor(() => expect(useShownPaths.getState().paths[1]?.lines).toHaveLength(1));
  const { owner, paths } = useShownPaths.getState();
  expect(owner).toBe('compare');
  expect(paths.map(({ label, name, isDashed }) => [label, name, isDashed])).toEqual([
    ['1', 'Last run, from 5.0 s of run 1', false],
    ['2', 'wider, from 3.0 s of run 1', true],
  ]);
  expect(paths.map(({ lines }) => lines.map((points) => [...points]))).toEqual([
    [[1, 0, 4, 1, 2, 0, 6, 0]],
    [[1, 0, 4, 1, 5, 0, 6, 0]],
  ]);
});

it('says where both are one run, and where the other has ended', async () => {
  openRun('a', 2);
  compareWith('b');
  await shows('one');
  expect(useComparing.getState().rows).toEqual([]);
  lookAt(8);
  await shows('beyond');
  lookAt(6);
  await shows('shown');
});

it.each([
  ['c', 'over'],
  ['b', 'beyond'],
])('shows no differences to a run that was halted: %s', async (run, state) => {
  haltedRun = run;
  compareWith('b');
  await shows(state);
  expect(useComparing.getState().rows).toEqual([]);
});

it('is of one run until both have ticked after they part', async () => {
  ticksFrom = 6.95;
  compareWith('b');
  await shows('one');
  lookAt(6.96);
  await shows('shown');
});

it('begins with the run that the shown one continues', async () => {
  compareSomething();
  expect(useComparing.getState().other).toBe('a');
  await shows('shown');
  expect(useComparing.getState().rows).toEqual([]);
});

it('ends by Escape before the past does, with the present, and when the other run is thrown away', () => {
  compareWith('b');
  leaveMoment();
  expect(useComparing.getState().other).toBeNull();
  expect(useShownPaths.getState().owner).toBeNull();
  expect(useMoment.getState().t).not.toBeNull();
  compareWith('b');
  lookNow();
  expect(useComparing.getState().other).toBeNull();
  compareWith('b');
  useSessionStore.setState({ segments: segments.filter(({ run }) => run !== 'b') });
  expect(useComparing.getState().other).toBeNull();
  leaveMoment();
  expect(useMoment.getState().t).toBeNull();
});
