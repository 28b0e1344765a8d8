import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { openProject, openSession, show, user } from '../../../harness/testing';
import { Groot2Switch } from './Groot2Switch';

async function open() {
  openProject({});
  const executor = await openSession();
  executor.introduce({ ros_environment: { ROS_DOMAIN_ID: '7' } });
  show(<Groot2Switch />);
  return executor;
}

it('lets Groot2 look at a port that the user chooses, and no longer', async () => {
  const executor = await open();
  const port = screen.getByTestId('groot2-port');
  expect(port).toHaveValue('1667');
  await user.clear(port);
  await user.type(port, '1700');
  await user.click(screen.getByTestId('groot2-switch'));
  await expect.poll(() => executor.sentAs('serve_groot2')).toEqual([{ port: 1700 }]);
  executor.emit('groot2', { port: 1700 });
  expect(await screen.findByText(/localhost and the port 1700/)).toBeInTheDocument();
  expect(port).toBeDisabled();
  await user.click(screen.getByTestId('groot2-switch'));
  await expect.poll(() => executor.sentAs('serve_groot2').at(-1)).toEqual({ port: 0 });
});

it('says what is wrong with a port, and why it is refused', async () => {
  const executor = await open();
  const [port, toggle] = [screen.getByTestId('groot2-port'), screen.getByTestId('groot2-switch')];
  await user.clear(port);
  expect(screen.getByText(/from 1 to 65534/)).toBeInTheDocument();
  expect(toggle).toBeDisabled();
  await user.type(port, '1667');
  executor.refuse('serve_groot2', 'Groot2 needs the ports 1667 and 1668.', 'Choose another port.');
  await user.click(toggle);
  expect(await screen.findByText(/needs the ports 1667.*Choose another port/)).toBeInTheDocument();
  expect(toggle).not.toBeChecked();
});

it('is for who controls the session', async () => {
  const executor = await open();
  executor.introduce({ role: 'viewer', ros_environment: { ROS_DOMAIN_ID: '7' } });
  await expect.poll(() => screen.getByTestId('groot2-switch')).toBeDisabled();
  expect(screen.getByTestId('groot2-port')).toBeDisabled();
});
