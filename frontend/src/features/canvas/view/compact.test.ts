import { expect, it, vi } from 'vitest';
import { toggleCompact, useCompact } from './compact';

it('is kept between visits', async () => {
  localStorage.clear();
  expect(useCompact.getState().isCompact).toBe(false);
  toggleCompact();
  expect(useCompact.getState().isCompact).toBe(true);
  vi.resetModules();
  expect((await import('./compact')).useCompact.getState().isCompact).toBe(true);
  toggleCompact();
  vi.resetModules();
  expect((await import('./compact')).useCompact.getState().isCompact).toBe(false);
});
