import { act, screen } from '@testing-library/react';
import userEvent from '@testing-library/user-event';
import { expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import * as run from '@/store/run/run';
import { useSessionStore } from '@/store/session/store';
import { openProject, openSession, show } from '../../../harness/testing';
import { ConnectDialog, openConnect } from './ConnectDialog';

it('shows the variables for a terminal, quoted for a shell', async () => {
  openProject({});
  const executor = await openSession();
  openConnect();
  show(<ConnectDialog />);
  expect(screen.getByText(/isolated from other programs/)).toBeInTheDocument();
  executor.introduce({ ros_environment: { ROS_DOMAIN_ID: '7', PROFILE: "it's here" } });
  expect(screen.getByTestId('ros-environment').textContent).toBe(
    "export ROS_DOMAIN_ID=7\nexport PROFILE='it'\\''s here'",
  );
  expect(screen.getByRole('button', { name: 'Copy' })).toBeInTheDocument();
  expect(screen.queryByText(/Runs of this project are exact/)).toBeNull();
  act(() => useProjectStore.getState().setSettings({ time: 'exact' }));
  expect(screen.getByText(/Runs of this project are exact/)).toBeInTheDocument();
});

it('makes runs live where tools would see nothing of them, and runs again what runs', async () => {
  const runAgain = vi.spyOn(run, 'runProject').mockResolvedValue(undefined as never);
  openProject({});
  const executor = await openSession();
  executor.introduce({ ros_environment: { ROS_DOMAIN_ID: '7' } });
  const exact = () => act(() => useProjectStore.getState().setSettings({ time: 'exact' }));
  exact();
  act(() => useSessionStore.setState({ executor: 'idle' }));
  openConnect();
  show(<ConnectDialog />);
  await userEvent.click(screen.getByRole('button', { name: 'Make runs live' }));
  expect(useProjectStore.getState().settings?.time).toBe('live');
  expect(screen.queryByTestId('connect-live')).toBeNull();
  expect(runAgain).not.toHaveBeenCalled();
  exact();
  act(() => useSessionStore.setState({ executor: 'application_running' }));
  await userEvent.click(screen.getByRole('button', { name: 'Run again, live' }));
  expect(useProjectStore.getState().settings?.time).toBe('live');
  expect(runAgain).toHaveBeenCalledOnce();
});
