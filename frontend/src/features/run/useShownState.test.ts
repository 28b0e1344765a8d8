import { expect, it } from 'vitest';
import { initialSession } from '@/store/session/reduce';
import type { SessionData } from '@/store/session/types';
import { shownState } from './useShownState';

const shown = (change: Partial<SessionData>) => shownState({ ...initialSession, ...change });
const end = { status: 'FAILURE', message: '', node_id: '', tree_id: '', node_path: '' } as const;

it('is a fault only if the end was not requested, and until the next run', () => {
  const died = { ...end, reason: 'process_died' } as const;
  expect(shown({ executor: 'visualization_ready', finished: died })).toBe('fault');
  expect(shown({ executor: 'connected', finished: died })).toBe('fault');
  expect(shown({ executor: 'application_running', finished: died })).toBe('application_running');
  expect(shown({ executor: 'visualization_ready', finished: { ...end, reason: 'terminated' } })).toBe(
    'visualization_ready',
  );
});

it('is silent while a tick hangs, which a lost connection hides', () => {
  expect(shown({ executor: 'application_running', hungSince: 5 })).toBe('silent');
  expect(shown({ hungSince: 5, connection: 'lost' })).toBe('lost');
});
