import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { perform, useCommandTable } from '@/commands/registry';
import { fakeServer, show } from '../../../harness/testing';
import { useStartCommands } from './useStartCommands';

const actions = { create: vi.fn(), chooseFile: vi.fn(), search: vi.fn(), attach: vi.fn() };

function Page() {
  useStartCommands(actions);
  return <p>start</p>;
}

it('has a command for each button of the page, while it is shown', async () => {
  fakeServer({ 'GET /catalog/templates': [{ id: 'mine', name: 'My own', description: '' }] });
  const { unmount } = show(<Page />);
  expect(screen.getByText('start')).toBeInTheDocument();
  const commands = () => useCommandTable.getState().commands;
  await expect.poll(() => commands()['start.new.mine']?.labelValues).toEqual({ template: 'My own' });
  expect(commands()['start.new.empty']).toMatchObject({ group: 'project', labelKey: 'projects:newFrom' });
  expect(commands()['start.import']).toMatchObject({ group: 'project', labelKey: 'projects:import' });
  expect(commands()['start.search']).toMatchObject({ group: 'go', labelKey: 'projects:search' });
  perform('start.new.mine');
  expect(actions.create).toHaveBeenCalledExactlyOnceWith('mine');
  perform('start.import');
  expect(actions.chooseFile).toHaveBeenCalledOnce();
  perform('start.search');
  expect(actions.search).toHaveBeenCalledOnce();
  unmount();
  expect(Object.keys(commands())).toEqual([]);
});
