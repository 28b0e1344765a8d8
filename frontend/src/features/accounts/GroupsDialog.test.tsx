import { screen, within } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { account, noContent, refusal } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import type { UserGroup } from './api';
import { GroupsDialog } from './GroupsDialog';

const group = (more: Partial<UserGroup> = {}): UserGroup => ({
  id: 'g1',
  name: 'Robotics',
  owner: 'ada',
  mine: true,
  members: [],
  invitations: [],
  ...more,
});

async function open(
  groups: readonly UserGroup[],
  role: 'user' | 'teacher' | 'administrator' = 'teacher',
  more: Readonly<Record<string, unknown>> = {},
) {
  const answers: Record<string, unknown> = { 'GET /groups': { items: groups }, ...more };
  const { requests } = fakeServer(answers);
  show(<GroupsDialog me={account({ role })} isOpen onClose={() => undefined} />);
  if (groups[0]) await screen.findByRole('region', { name: groups[0].name });
  const changes = () =>
    requests.filter(({ method }) => method !== 'GET').map(({ method, path }) => `${method} ${path}`);
  return { answers, requests, changes };
}

const click = (name: string | RegExp) => user.click(screen.getByRole('button', { name }));

describe('GroupsDialog', () => {
  it('reports that there are no groups', async () => {
    await open([]);
    expect(await screen.findByText('You are in no group yet.')).toBeInTheDocument();
  });

  it.each([
    ['user', false],
    ['teacher', true],
    ['administrator', true],
  ] as const)('lets a %s make groups: %s', async (role, isAllowed) => {
    await open([group()], role);
    expect(screen.queryByText('You are in no group yet.')).toBeNull();
    expect(screen.queryByRole('button', { name: 'Make' }) !== null).toBe(isAllowed);
  });

  it('makes a group of the name that was typed', async () => {
    const { answers, requests, changes } = await open([], 'teacher', { 'POST /groups': group() });
    const name = screen.getByLabelText('New group');
    await user.type(name, '  ');
    expect(screen.getByRole('button', { name: 'Make' })).toBeDisabled();
    await user.type(name, '{Enter}');
    expect(changes()).toEqual([]);
    await user.type(name, 'Robotics ');
    answers['GET /groups'] = { items: [group()] };
    await user.type(name, '{Enter}');
    expect(await screen.findByRole('region', { name: 'Robotics' })).toBeInTheDocument();
    expect(requests.find(({ method }) => method === 'POST')?.body).toEqual({ name: 'Robotics' });
    expect(name).toHaveValue('');
  });

  it('shows the members by name, and removes one', async () => {
    const members = [
      { username: 'bob', name: 'Bob Ross' },
      { username: 'cy', name: '' },
    ];
    const removal = 'DELETE /groups/g1/members/bob';
    const { changes } = await open([group({ members })], 'teacher', { [removal]: noContent() });
    expect(screen.getByText('Bob Ross')).toBeInTheDocument();
    expect(screen.getByText('cy')).toBeInTheDocument();
    expect(screen.queryByText(/Nobody has joined/)).toBeNull();
    expect(screen.getByRole('button', { name: 'Remove bob' })).toHaveAttribute('tabindex', '0');
    await click('Remove bob');
    await expect.poll(changes).toEqual([removal]);
  });

  it('makes an invitation link, and revokes it', async () => {
    const invitation = {
      id: 'i1',
      url: 'https://studio/join/1',
      expires_at: '2030-02-01T12:00:00Z',
      uses: 3,
      max_uses: 40,
    };
    const { answers, changes } = await open([group()], 'teacher', {
      'POST /groups/g1/invitations': invitation,
      'DELETE /invitations/i1': noContent(),
    });
    expect(screen.getByText('Nobody has joined yet: make a link and send it.')).toBeInTheDocument();
    answers['GET /groups'] = { items: [group({ invitations: [invitation] })] };
    await click('Make an invitation link');
    const link = await screen.findByLabelText('Invitation link');
    expect(link).toHaveValue('https://studio/join/1');
    expect(link).toHaveAccessibleDescription('Used 3 of 40 times, works until 2/1/2030');
    await click('Revoke the link');
    await expect.poll(changes).toEqual(['POST /groups/g1/invitations', 'DELETE /invitations/i1']);
  });

  it('deletes a group only after a second press', async () => {
    const { answers, changes } = await open([group()], 'teacher', { 'DELETE /groups/g1': noContent() });
    await click('Delete');
    expect(screen.getByRole('button', { name: 'Really delete?' })).toBeInTheDocument();
    await user.click(screen.getByLabelText('New group'));
    await click('Delete');
    expect(changes()).toEqual([]);
    answers['GET /groups'] = { items: [] };
    await click('Really delete?');
    expect(await screen.findByText('You are in no group yet.')).toBeInTheDocument();
    expect(changes()).toEqual(['DELETE /groups/g1']);
  });

  it('lets a member leave a group, and shows no other member', async () => {
    const other = group({ mine: false, owner: 'grace', members: [{ username: 'bob', name: '' }] });
    const leave = 'DELETE /groups/g1/members/ada';
    const { changes } = await open([other], 'user', { [leave]: noContent() });
    const card = within(screen.getByRole('region', { name: 'Robotics' }));
    expect(card.getByText('Managed by grace')).toBeInTheDocument();
    expect(card.queryByText('bob')).toBeNull();
    expect(card.queryByRole('button', { name: 'Delete' })).toBeNull();
    await click('Leave');
    await expect.poll(changes).toEqual([leave]);
  });

  it('reports why a request was refused', async () => {
    await open([group()], 'teacher', { 'POST /groups/g1/invitations': refusal('Too many links.') });
    await click('Make an invitation link');
    expect(await screen.findByRole('alert')).toHaveTextContent('Too many links.');
  });

  it('reports why the groups cannot be listed', async () => {
    await open([], 'user', { 'GET /groups': refusal('Not now.', { status: 503 }) });
    expect(await screen.findByRole('alert')).toHaveTextContent('Not now.');
    expect(screen.queryByText('You are in no group yet.')).toBeNull();
  });

  it('requests nothing while it is closed', () => {
    const { requests } = fakeServer({});
    show(<GroupsDialog me={account()} isOpen={false} onClose={() => undefined} />);
    expect(screen.queryByRole('dialog')).toBeNull();
    expect(requests).toEqual([]);
  });
});
