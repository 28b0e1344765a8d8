import { act, screen } from '@testing-library/react';
import { afterEach, expect, it } from 'vitest';
import { showPaths, useShownPaths, type ShownPath } from '@/store/session/trace/shownPaths';
import { show, user } from '../../../../harness/testing';
import { PathsLegend } from './PathsLegend';

const path = (label: string, name: string): ShownPath => ({
  ...{ label, name, hue: 215, isDashed: label === '2', labelAt: 'moment', lines: [] },
});

afterEach(() => useShownPaths.setState({ owner: null, paths: [] }));

it('names the paths, and hides them', async () => {
  show(<PathsLegend />);
  expect(screen.queryByTestId('paths-legend')).toBeNull();
  act(() => showPaths('tries', [path('1', 'Last run'), path('2', 'wider turns')]));
  expect(screen.getAllByRole('listitem').map(({ textContent }) => textContent)).toEqual([
    '1 Last run',
    '2 wider turns',
  ]);
  await user.click(screen.getByRole('button', { name: 'Hide the paths' }));
  expect(useShownPaths.getState().paths).toEqual([]);
});

it('ends the comparison whose paths it names', async () => {
  show(<PathsLegend />);
  act(() => showPaths('compare', [path('1', 'Last run'), path('2', 'wider turns')]));
  await user.click(screen.getByRole('button', { name: 'End the comparison' }));
  expect(screen.queryByTestId('paths-legend')).toBeNull();
});
