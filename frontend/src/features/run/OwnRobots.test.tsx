import { act, screen, waitFor } from '@testing-library/react';
import { expect, it, onTestFinished } from 'vitest';
import { closeOwnRobots, openOwnRobots } from '@/store/dialogs/ownRobots';
import { refusal, noContent } from '../../../harness/requests';
import { fakeServer, openProject, openSession, show, user } from '../../../harness/testing';
import { OwnRobots } from './OwnRobots';

const row = (id: string, project_id: string | null, state: string, name: string) => ({
  id,
  project_id,
  state,
  project_name: name,
  target: 'robot:1667',
});
const ROWS = [
  row('s1', 'p1', 'ready', 'Patrol'),
  row('s2', 'p2', 'starting', 'Docking'),
  row('s3', null, 'queued', ''),
];

function open(answers: Readonly<Record<string, unknown>>) {
  const { requests } = fakeServer({ 'GET /sessions': ROWS, ...answers });
  onTestFinished(closeOwnRobots);
  show(<OwnRobots />);
  act(openOwnRobots);
  return () =>
    requests.map(({ method, path }) => `${method} ${path}`).filter((each) => !each.startsWith('GET'));
}
const endOf = (name: string) => screen.findByRole('button', { name: `End the robot of “${name}”` });

it('lists the robots of all projects with their states, and ends one', async () => {
  openProject({});
  const asked = open({ 'DELETE /sessions/s2': noContent() });
  await endOf('Docking');
  const shown = screen.getAllByRole('listitem').map(({ textContent }) => textContent);
  expect(shown).toEqual(['Patrol (this project)runsEnd', 'DockingstartsEnd', 'robot:1667waitsEnd']);
  await user.click(await endOf('Docking'));
  await waitFor(() => expect(asked()).toEqual(['DELETE /sessions/s2']));
});

it('ends the robot of this page as its own button does', async () => {
  openProject({});
  await openSession();
  const asked = open({ 'DELETE /sessions/s1': noContent() });
  await user.click(await endOf('Patrol'));
  await waitFor(() => expect(asked()).toEqual(['DELETE /sessions/s1']));
});

it('says that there are none', async () => {
  open({ 'GET /sessions': [] });
  expect(await screen.findByText('No robot of yours runs or waits.')).toBeInTheDocument();
});

it('shows why a robot was not ended, and why there is no list', async () => {
  open({ 'DELETE /sessions/s2': refusal('It is stuck.') });
  await user.click(await endOf('Docking'));
  expect(await screen.findByRole('alert')).toHaveTextContent('It is stuck.');
});
