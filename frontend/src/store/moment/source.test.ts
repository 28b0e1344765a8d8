import { expect, it } from 'vitest';
import { liveSource } from '@/store/recording/liveSource';
import { isPresentRun, useSource } from './source';

it('is the run of the session at first', () => {
  expect(useSource.getState()).toEqual({ source: liveSource, kept: null });
});

it('knows the present run from another one', () => {
  expect(isPresentRun({ source: liveSource, kept: null })).toBe(true);
  expect(isPresentRun({ source: { ...liveSource }, kept: null })).toBe(false);
});
