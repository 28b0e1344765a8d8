import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { account, noContent, refusal, watchLocation } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { DataDialog } from './DataDialog';

const MIB = 1024 * 1024;
const usage = (bytes: number) => ({
  projects: 3,
  max_projects: 10,
  bytes: bytes * MIB,
  max_bytes: 200 * MIB,
  runs: 4,
  run_bytes: 30 * MIB,
  max_run_bytes: 500 * MIB,
});

function open(answers: Readonly<Record<string, unknown>>) {
  const { requests } = fakeServer(answers);
  const assign = watchLocation();
  const onClose = vi.fn();
  show(<DataDialog me={account()} isOpen onClose={onClose} />);
  return { requests, assign, onClose };
}

it('shows the room that kept runs take', async () => {
  open({ 'GET /me/usage': usage(1) });
  expect(await screen.findByText('30 MiB of 500 MiB in 4 kept runs')).toBeInTheDocument();
});

const room = () => screen.findByRole('progressbar', { name: 'Storage for projects' });
const color = (bar: HTMLElement) => bar.getAttribute('style') ?? '';

it('shows the disk use of the projects', async () => {
  open({ 'GET /me/usage': usage(50.55) });
  const bar = await room();
  expect(bar).toHaveAttribute('aria-valuenow', '25.275');
  expect(screen.getByText('50.6 MiB of 200 MiB in 3 projects')).toBeInTheDocument();
  expect(color(bar)).toContain('indigo');
});

it.each([
  [180, 'indigo'],
  [181, 'red'],
])('warns when little disk space is left (%s MiB of 200: %s)', async (used, expected) => {
  open({ 'GET /me/usage': usage(used) });
  expect(color(await room())).toContain(expected);
});

it('offers all data for download', () => {
  open({});
  const link = screen.getByRole('link', { name: 'Download everything' });
  expect(link).toHaveAttribute('href', '/api/v1/me/data');
  expect(link).toHaveAttribute('download');
  expect(screen.queryByRole('progressbar')).toBeNull();
});

it('deletes the account once its name was typed, and leaves', async () => {
  const { requests, assign } = open({ 'DELETE /me/data': noContent() });
  expect(screen.getByText(/Deleting the account ada/)).toBeInTheDocument();
  const remove = screen.getByRole('button', { name: 'Delete the account permanently' });
  const name = screen.getByLabelText('Type your user name to delete the account');
  expect(remove).toBeDisabled();
  await user.type(name, 'ad');
  expect(remove).toBeDisabled();
  await user.type(name, 'a');
  await user.click(remove);
  await vi.waitFor(() => expect(assign).toHaveBeenCalledWith('/accounts/login/'));
  expect(requests.at(-1)).toMatchObject({ method: 'DELETE', body: { username: 'ada' } });
});

it('reports why an account cannot be deleted', async () => {
  const { assign } = open({ 'DELETE /me/data': refusal('You own a shared project.') });
  await user.type(screen.getByLabelText(/Type your user name/), 'ada');
  await user.click(screen.getByRole('button', { name: /Delete the account/ }));
  expect(await screen.findByRole('alert')).toHaveTextContent('You own a shared project.');
  expect(assign).not.toHaveBeenCalled();
});

it('requests nothing while it is closed', () => {
  const { requests } = fakeServer({ 'GET /me/usage': usage(1) });
  show(<DataDialog me={account()} isOpen={false} onClose={() => undefined} />);
  expect(screen.queryByRole('dialog')).toBeNull();
  expect(requests).toEqual([]);
});
