import { screen, waitFor } from '@testing-library/react';
import { describe, expect, it, onTestFinished } from 'vitest';
import { openSession, show, user } from '../../../harness/testing';
import { registerRunCommands } from './commands';
import { ViewerNotice } from './ViewerNotice';

describe('ViewerNotice', () => {
  it('is not shown to the page that drives', async () => {
    await openSession({ role: 'driver' });
    show(<ViewerNotice />);
    expect(screen.queryByRole('status')).toBeNull();
  });

  it('lets a viewer take over', async () => {
    onTestFinished(registerRunCommands());
    const executor = await openSession({ role: 'viewer' });
    show(<ViewerNotice />);
    expect(screen.getByRole('status')).toHaveTextContent(
      'You are viewing; another window controls this session.',
    );
    await user.click(screen.getByRole('button', { name: 'Take over' }));
    expect(executor.sentAs('take_over')).toEqual([{}]);
    executor.introduce({ role: 'driver' });
    expect(screen.queryByRole('status')).toBeNull();
  });

  it('says that another window took over, once', async () => {
    const executor = await openSession({ role: 'driver' });
    show(<ViewerNotice />);
    executor.introduce({ role: 'viewer' });
    expect(screen.getByRole('status')).toHaveTextContent('Another window has taken over this session');
    expect(screen.getByRole('button', { name: 'Take it back' })).toBeEnabled();
    await user.click(screen.getByRole('button', { name: 'Dismiss' }));
    await waitFor(() => {
      expect(screen.queryByRole('status')).toBeNull();
    });
  });
});
