import { afterEach, expect, it } from 'vitest';
import { cssOf, hidePaths, hueOf, showPaths, useShownPaths, type ShownPath } from './shownPaths';

const path: ShownPath = { label: '1', name: 'wider', hue: 215, isDashed: false, labelAt: 'end', lines: [] };

afterEach(() => useShownPaths.setState({ owner: null, paths: [] }));

it('gives each path a colour of its own', () => {
  expect(new Set(Array.from({ length: 51 }, (_, index) => cssOf(hueOf(index)))).size).toBe(51);
});

it('shows the paths of one owner, who alone hides them', () => {
  showPaths('compare', [path]);
  showPaths('tries', [path, path]);
  hidePaths('compare');
  expect(useShownPaths.getState()).toEqual({ owner: 'tries', paths: [path, path] });
  hidePaths('tries');
  expect(useShownPaths.getState()).toEqual({ owner: null, paths: [] });
});
