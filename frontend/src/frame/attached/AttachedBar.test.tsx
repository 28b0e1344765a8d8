import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { attached } from '../../../harness/attached';
import { fakeServer, openSession, show, user } from '../../../harness/testing';
import { AttachedBar } from './AttachedBar';

it('gives control only to the driver of a program that is followed', async () => {
  const executor = await openSession({ state: 'visualization_ready' });
  fakeServer({});
  show(<AttachedBar />);
  expect(screen.getByTestId('attached-control')).toBeDisabled();
  executor.emit('state-changed', { state: 'application_running', reason: '' });
  executor.emit('attached', attached());
  await user.click(screen.getByTestId('attached-control'));
  await expect.poll(() => executor.sentAs('control')).toEqual([{ on: true }]);
  expect(screen.getByTestId('attached-control')).not.toBeChecked();
  executor.emit('attached', attached({ controls: true }));
  expect(screen.getByTestId('attached-control')).toBeChecked();
});
