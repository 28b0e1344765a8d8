import { expect, it } from 'vitest';
import { panelIcon } from './panelIcons';

it('has an icon for each panel, and for nothing else', () => {
  expect(panelIcon('history')).toBeDefined();
  expect(panelIcon('toString')).toBeUndefined();
});
