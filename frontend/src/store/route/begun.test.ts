import { expect, it } from 'vitest';
import type { SessionInfo } from '@/api/types';
import { navigate, useRoute } from '.';
import { openBegun, takeBegun } from './begun';

const session = { id: 's1', state: 'starting', target: 'robot:1667' } as SessionInfo;

it('hands a session that has begun to its page, once', () => {
  openBegun(session);
  expect(useRoute.getState().route).toEqual({ page: 'attached', sessionId: 's1' });
  expect(takeBegun('s1')).toBe(session);
  expect(takeBegun('s1')).toBeNull();
  navigate('/');
});

it('hands it to no other page', () => {
  openBegun(session);
  expect(takeBegun('s2')).toBeNull();
  expect(takeBegun('s1')).toBeNull();
  navigate('/');
});
