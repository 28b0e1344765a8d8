import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { attached } from '../../../harness/attached';
import { openSession, show, user } from '../../../harness/testing';
import { AttachedStrip } from './AttachedStrip';

const strip = () => screen.getByTestId('attached-strip');

it('says whether the page looks or controls, and why there is no Stop', async () => {
  const executor = await openSession();
  executor.emit('attached', attached());
  show(<AttachedStrip address="robot:1667" />);
  expect(strip()).toHaveTextContent(/only looks.*There is no Stop/);
  executor.emit('attached', attached({ controls: true }));
  expect(strip()).toHaveTextContent(/You control robot:1667/);
  expect(strip()).toHaveAttribute('data-tone', 'calm');
});

it('says when the program is silent or gone, and follows it again', async () => {
  const executor = await openSession();
  executor.emit('attached', attached({ state: 'silent', problem: 'no answer in 1 s' }));
  show(<AttachedStrip address="robot:1667" />);
  expect(strip()).toHaveTextContent(/does not answer.*no answer in 1 s/);
  executor.emit('state-changed', { state: 'visualization_ready', reason: '' });
  expect(strip()).toHaveAttribute('data-tone', 'error');
  await user.click(screen.getByTestId('attached-again'));
  await expect.poll(() => executor.sentAs('restart_application')).toEqual([{}]);
});

it('gives its place to the banner of a held tree', async () => {
  await openSession({ state: 'held' });
  const { container } = show(<AttachedStrip address="robot:1667" />);
  expect(container.querySelector('[data-testid="attached-strip"]')).toBeNull();
});
