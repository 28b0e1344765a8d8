import { expect, it } from 'vitest';
import { MARK_ICONS } from './markIcons';

it('has another symbol for each kind of mark', () => {
  expect(new Set(Object.values(MARK_ICONS)).size).toBe(Object.keys(MARK_ICONS).length);
});
