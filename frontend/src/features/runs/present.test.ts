import { expect, it, onTestFinished } from 'vitest';
import type { Segment } from '@/generated/messages';
import { ofSession, useSource } from '@/store/moment/source';
import { earlierSource } from '@/store/recording/liveSource';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { minutes, pathOf, runToKeep, RESULT_COLORS } from './present';

it('keeps the run of the session that is shown, else the last one', () => {
  const segments = ['a', 'b', 'b'].map((run) => ({ run, from_t: 0, to_t: 1 }) as Segment);
  useSessionStore.setState({ segments });
  onTestFinished(() => {
    useSessionStore.setState(initialSession, true);
    useSource.setState(ofSession);
  });
  expect(runToKeep(['a', 'b'])).toBe('b');
  expect(runToKeep([])).toBeUndefined();
  useSource.setState({ source: earlierSource('a'), kept: null });
  expect(runToKeep(['a', 'b'])).toBe('a');
  useSource.setState({ source: earlierSource('a'), kept: { id: 'k', name: 'kept' } });
  expect(runToKeep(['a', 'b'])).toBe('b');
});

it.each([
  [0, '0:00'],
  [59.99, '0:59'],
  [60, '1:00'],
  [754.2, '12:34'],
])('%d s are %s', (seconds, text) => {
  expect(minutes(seconds)).toBe(text);
});

it('names the page of a run, and has a colour for each result', () => {
  const id = '00000001-0000-0000-0000-000000000000';
  expect(pathOf({ project: 'p 1', id })).toBe(`/projects/p%201?run=${id}`);
  expect(RESULT_COLORS.failure).toBe('red');
});
