import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { useStatusRate } from '@/store/session/statusRate';
import { openProject, show, user } from '../../../harness/testing';
import { useFollowing } from './following';
import { RunMenu } from './RunMenu';

const [step, restart, follow] = [vi.fn(), vi.fn(), vi.fn()];

beforeEach(() => {
  for (const each of [step, restart, follow]) each.mockClear();
  openProject({});
  onTestFinished(
    registerCommands([
      { id: 'run.step10', group: 'run', labelKey: 'run:command.step10', shortcut: '$mod+F10', run: step },
      {
        id: 'run.restart',
        group: 'run',
        labelKey: 'run:command.restart',
        enabled: () => false,
        run: restart,
      },
      { id: 'run.followRunning', group: 'run', labelKey: 'run:command.followRunning', run: follow },
    ]),
  );
  onTestFinished(() => {
    useFollowing.setState({ isOn: false });
    useStatusRate.setState({ hz: 0 });
    localStorage.clear();
  });
});

async function open(isDisabled = false) {
  show(<RunMenu isDisabled={isDisabled} />);
  await user.click(screen.getByRole('button', { name: 'More ways to run' }));
}

describe('RunMenu', () => {
  it('has the available commands, with their keys', async () => {
    await open();
    const item = screen.getByRole('menuitem', { name: /^Step ten ticks/ });
    expect(item).toHaveTextContent('Step ten ticksCtrl+F10');
    await user.click(item);
    expect(step).toHaveBeenCalledOnce();
    expect(screen.queryByRole('menuitem', { name: /Reset the world/ })).toBeNull();
  });

  it('disables unavailable commands', async () => {
    await open();
    expect(screen.getByRole('menuitem', { name: /^Restart/ })).toBeDisabled();
    expect(screen.getByRole('menuitem', { name: /^Step ten/ })).toBeEnabled();
  });

  it('disables everything for users who may not run, except for view options', async () => {
    await open(true);
    expect(screen.getByRole('menuitem', { name: /^Step ten/ })).toBeDisabled();
    await user.click(screen.getByRole('menuitemcheckbox', { name: 'Follow the running block' }));
    expect(follow).toHaveBeenCalledOnce();
  });

  it('checks whether the running block is followed', async () => {
    useFollowing.setState({ isOn: true });
    await open();
    expect(screen.getByRole('menuitemcheckbox')).toHaveAttribute('aria-checked', 'true');
  });

  it('sets the update rate of statuses', async () => {
    await open();
    const rates = [
      'As they change',
      '20 times a second',
      '10 times a second',
      '5 times a second',
      '2 times a second',
    ];
    expect(screen.getAllByRole('menuitemradio').map(({ textContent }) => textContent)).toEqual(rates);
    expect(screen.getByRole('menuitemradio', { name: 'As they change' })).toHaveAttribute(
      'aria-checked',
      'true',
    );
    await user.click(screen.getByRole('menuitemradio', { name: '10 times a second' }));
    expect(useStatusRate.getState().hz).toBe(10);
  });
});
