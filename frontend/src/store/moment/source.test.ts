import { expect, it } from 'vitest';
import { liveSource } from '@/store/recording/liveSource';
import { useSource } from './source';

it('is the run of the session at first', () => {
  expect(useSource.getState()).toEqual({ source: liveSource, kept: null });
});
