import { expect, it, onTestFinished } from 'vitest';
import type { Segment } from '@/generated/messages';
import { ofSession, useSource } from '@/store/moment/source';
import { earlierSource } from '@/store/recording/liveSource';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { runToKeep } from './runToKeep';

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
