import { afterEach, beforeEach, expect, it } from 'vitest';
import { noRange, useRange } from '@/store/moment/range';
import { atPresent, useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { rangeCommands, zoom } from './rangeCommands';

const command = (id: string) => rangeCommands.find((each) => each.id === `time.${id}`)!;

beforeEach(() => useSessionStore.setState({ segments: [segmentOf()] }));
afterEach(() => {
  useSessionStore.setState(initialSession, true);
  useMoment.setState(atPresent, true);
  useRange.setState(noRange);
});

it('marks the shown moment, or the end of the run at the present', () => {
  useMoment.setState({ t: 20 });
  command('markA').run();
  useMoment.setState({ t: null });
  command('markB').run();
  expect(useRange.getState()).toMatchObject({ a: 20, b: 100 });
});

it('loops and compares only what is marked, and forgets it', () => {
  expect(['loop', 'whatChanged', 'clearRange'].map((id) => command(id).enabled?.())).toEqual(
    Array(3).fill(false),
  );
  useRange.setState({ a: 20, b: 30 });
  expect(['loop', 'whatChanged', 'clearRange'].map((id) => command(id).enabled?.())).toEqual(
    Array(3).fill(true),
  );
  command('loop').run();
  command('whatChanged').run();
  expect(useRange.getState()).toMatchObject({ isLooping: true, isComparing: true });
  command('clearRange').run();
  expect(useRange.getState()).toEqual(noRange);
});

it('zooms round the moment, or a given time, and back to all', () => {
  useMoment.setState({ t: 50 });
  command('zoomIn').run();
  const { view } = useRange.getState();
  expect(view?.from).toBeCloseTo(50 - 50 / 1.5);
  zoom(0.5, view?.from);
  expect(useRange.getState().view?.from).toBeCloseTo(view?.from ?? 0);
  command('fit').run();
  expect(useRange.getState().view).toBeNull();
  expect(command('zoomOut').enabled?.()).toBe(false);
});

it('clears a range of which only one end is marked', () => {
  for (const end of ['a', 'b'] as const) {
    useRange.setState({ ...noRange, [end]: 20 });
    expect(command('clearRange').enabled?.()).toBe(true);
    expect(command('loop').enabled?.()).toBe(false);
  }
  command('clearRange').run();
  expect(useRange.getState()).toMatchObject({ a: null, b: null });
});
