import { act, screen } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { useMoment } from '@/store/moment/store';
import { leave } from '@/store/session/connection';
import { openSession, show, user } from '../../../harness/testing';
import { useFollowing } from './following';
import { FollowingChip } from './FollowingChip';

it('is there while the view follows, and ends that', async () => {
  onTestFinished(() => useFollowing.setState({ isOn: false }));
  await openSession();
  show(<FollowingChip />);
  expect(screen.queryByTestId('following')).toBeNull();
  act(() => useFollowing.setState({ isOn: true }));
  await user.click(screen.getByRole('button', { name: 'Following the running block: press to end' }));
  expect(useFollowing.getState().isOn).toBe(false);
  expect(screen.queryByTestId('following')).toBeNull();
});

it('is away where there is nothing to follow: without a program, a session, or in the past', async () => {
  onTestFinished(() => useFollowing.setState({ isOn: false }));
  const executor = await openSession();
  show(<FollowingChip />);
  act(() => useFollowing.setState({ isOn: true }));
  const chip = () => screen.queryByTestId('following');
  expect(chip()).toBeInTheDocument();
  act(() => useMoment.setState({ t: 1 }));
  expect(chip()).toBeNull();
  act(() => useMoment.setState({ t: null }));
  executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
  expect(chip()).toBeNull();
  executor.emit('state-changed', { state: 'paused', reason: '' });
  expect(chip()).toBeInTheDocument();
  act(leave);
  expect(chip()).toBeNull();
});
