import { screen } from '@testing-library/react';
import { expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { openSession, show, user } from '../../harness/testing';
import { PausedWorld } from './PausedWorld';

it('offers to let the world run while its time is paused', async () => {
  const run = vi.fn();
  onTestFinished(registerCommands([{ id: 'run.world', group: 'run', labelKey: 'run:command.world', run }]));
  const executor = await openSession({ state: 'application_running' });
  show(<PausedWorld text="Nothing moves." />);
  expect(screen.queryByTestId('paused-world')).toBeNull();
  executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
  expect(screen.getByTestId('paused-world')).toHaveTextContent('The world is paused. Nothing moves.');
  await user.click(screen.getByRole('button', { name: 'Let the world run' }));
  expect(run).toHaveBeenCalledOnce();
});
