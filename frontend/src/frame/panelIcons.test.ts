import { expect, it } from 'vitest';
import { panelIcon } from './panelIcons';

it('knows the icon of each panel, and of nothing else', () => {
  expect(panelIcon('history')).toBeDefined();
  expect(panelIcon('toString')).toBeUndefined();
});
