import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { openSession, show } from '../../../harness/testing';
import { ConnectDialog, openConnect } from './ConnectDialog';

it('shows the variables for a terminal, quoted for a shell', async () => {
  const executor = await openSession();
  openConnect();
  show(<ConnectDialog />);
  expect(screen.getByText(/isolated from other programs/)).toBeInTheDocument();
  executor.introduce({ ros_environment: { ROS_DOMAIN_ID: '7', PROFILE: "it's here" } });
  expect(screen.getByTestId('ros-environment').textContent).toBe(
    "export ROS_DOMAIN_ID=7\nexport PROFILE='it'\\''s here'",
  );
  expect(screen.getByRole('button', { name: 'Copy' })).toBeInTheDocument();
});
