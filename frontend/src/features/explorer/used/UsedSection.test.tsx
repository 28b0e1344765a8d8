import { screen, within } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show } from '../../../../harness/testing';
import { UsedSection } from './UsedSection';

it('lists the universe and the robot', () => {
  fakeServer({});
  openProject({ texts: {} });
  useProjectStore.getState().setSettings({ universe: 'maze', robot: 'burger' });
  show(<UsedSection />);
  const rows = within(screen.getByRole('region', { name: 'Runs with' })).getAllByRole('listitem');
  expect(rows.map(({ textContent }) => textContent)).toEqual([
    expect.stringContaining('Maze'),
    expect.stringContaining('Burger'),
  ]);
});
