import { screen, within } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { noContent, refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import type { Shares } from './api';
import { ShareDialog } from './ShareDialog';

const sharesOf = (more: Partial<Shares> = {}): Shares => ({
  owner: { username: 'ada', name: 'Ada Lovelace' },
  people: [],
  groups: [],
  links: [],
  ...more,
});

const groupOf = (id: string, name: string) => ({
  id,
  name,
  owner: 'ada',
  mine: true,
  members: [],
  invitations: [],
});

const SHARES = '/projects/p/shares';

async function open(shares: Shares, more: Readonly<Record<string, unknown>> = {}) {
  const answers: Record<string, unknown> = {
    [`GET ${SHARES}`]: shares,
    'GET /groups': { items: [groupOf('g1', 'Robotics'), groupOf('g2', 'Painting')] },
    ...more,
  };
  const { requests } = fakeServer(answers);
  const onClose = vi.fn();
  openProject({});
  show(<ShareDialog projectId="p" name="Bump" isOpen onClose={onClose} />);
  await screen.findByRole('list', { name: 'Who has access' });
  const changes = () => requests.filter(({ method }) => method !== 'GET');
  return { answers, changes, onClose };
}

const click = (name: string) => user.click(screen.getByRole('button', { name }));
const who = () => screen.getByLabelText('Share with');
const choose = async (field: string, option: string) => {
  await user.click(screen.getByRole('combobox', { name: field }));
  await user.click(screen.getByRole('option', { name: option }));
};

describe('ShareDialog', () => {
  it('names the project and its owner', async () => {
    await open(sharesOf());
    expect(screen.getByRole('dialog', { name: 'Share “Bump”' })).toBeInTheDocument();
    const [owner, ...others] = within(screen.getByRole('list')).getAllByRole('listitem');
    expect(owner).toHaveTextContent('Ada Lovelace (ada)Owner');
    expect(others).toEqual([]);
  });

  it('shares with a person, to view by default', async () => {
    const { answers, changes } = await open(sharesOf(), { [`POST ${SHARES}`]: sharesOf() });
    await user.type(who(), ' ');
    expect(screen.getByRole('button', { name: 'Share' })).toBeDisabled();
    await user.type(who(), '{Enter}');
    expect(changes()).toEqual([]);
    await user.type(who(), 'bob ');
    answers[`GET ${SHARES}`] = sharesOf({ people: [{ username: 'bob', name: '', role: 'viewer' }] });
    await click('Share');
    expect(await screen.findByRole('combobox', { name: 'What bob may do' })).toHaveValue('Can view');
    expect(changes().map(({ body }) => body)).toEqual([{ name: 'bob', role: 'viewer' }]);
    expect(who()).toHaveValue('');
  });

  it('shares with a person who may edit', async () => {
    const { changes } = await open(sharesOf(), { [`POST ${SHARES}`]: sharesOf() });
    await choose('What they may do', 'Can edit');
    await user.type(who(), 'bob{Enter}');
    await expect.poll(() => changes().map(({ body }) => body)).toEqual([{ name: 'bob', role: 'editor' }]);
  });

  it('reports why a person cannot be added', async () => {
    await open(sharesOf(), { [`POST ${SHARES}`]: refusal('Nobody has this name.') });
    await user.type(who(), 'nobody{Enter}');
    expect(await screen.findByRole('alert')).toHaveTextContent('Nobody has this name.');
  });

  it('shares with a group that has no share yet', async () => {
    const { changes } = await open(sharesOf({ groups: [{ id: 'g1', name: 'Robotics', role: 'viewer' }] }), {
      [`PUT ${SHARES}/groups/g2`]: sharesOf(),
    });
    await user.click(await screen.findByRole('combobox', { name: 'Share with a group…' }));
    expect(screen.queryByRole('option', { name: 'Robotics' })).toBeNull();
    await user.click(screen.getByRole('option', { name: 'Painting' }));
    await expect
      .poll(changes)
      .toEqual([{ method: 'PUT', path: `${SHARES}/groups/g2`, body: { role: 'viewer' } }]);
  });

  it('offers no group if all have a share', async () => {
    await open(sharesOf(), { 'GET /groups': { items: [] } });
    expect(screen.queryByRole('combobox', { name: 'Share with a group…' })).toBeNull();
  });

  it('makes read-only links, and revokes them', async () => {
    const link = {
      id: 'l1',
      url: 'https://studio/l/1',
      expires_at: null,
      created_at: '2030-02-01T12:00:00Z',
    };
    const { answers, changes } = await open(sharesOf(), {
      [`POST ${SHARES}/links`]: sharesOf(),
      [`DELETE ${SHARES}/links/l1`]: noContent(),
    });
    expect(screen.queryByLabelText('Read-only link')).toBeNull();
    answers[`GET ${SHARES}`] = sharesOf({ links: [link] });
    await click('Make a link');
    const field = await screen.findByLabelText('Read-only link');
    expect(field).toHaveValue('https://studio/l/1');
    expect(field).toHaveAccessibleDescription('Made on 2/1/2030');
    await click('Revoke the link');
    await expect
      .poll(() => changes().map(({ method, path }) => `${method} ${path}`))
      .toEqual([`POST ${SHARES}/links`, `DELETE ${SHARES}/links/l1`]);
  });

  it('gives the project to an editor, once confirmed, and closes', async () => {
    const people = [{ username: 'bob', name: '', role: 'editor' as const }];
    const { changes, onClose } = await open(sharesOf({ people }), {
      'POST /projects/p/transfer': sharesOf(),
    });
    await click('Make bob the owner');
    await click('Keep it');
    expect(screen.queryByRole('alert')).toBeNull();
    expect(changes()).toEqual([]);
    await click('Make bob the owner');
    await user.click(within(screen.getByRole('alert')).getByRole('button', { name: 'Make bob the owner' }));
    await expect.poll(() => onClose.mock.calls.length).toBe(1);
    expect(changes().map(({ body }) => body)).toEqual([{ name: 'bob' }]);
    expect(useProjectStore.getState().role).toBe('editor');
  });

  it('does not move the project if the transfer is refused', async () => {
    const people = [{ username: 'bob', name: '', role: 'editor' as const }];
    const { onClose } = await open(sharesOf({ people }), {
      'POST /projects/p/transfer': refusal('bob has no room.'),
    });
    await click('Make bob the owner');
    await user.click(within(screen.getByRole('alert')).getByRole('button', { name: 'Make bob the owner' }));
    expect(await screen.findByText('bob has no room.')).toBeInTheDocument();
    expect(onClose).not.toHaveBeenCalled();
    expect(useProjectStore.getState().role).toBe('owner');
  });
});

it('reports why the shares cannot be read', async () => {
  fakeServer({ [`GET ${SHARES}`]: refusal('Only the owner sees this.', { status: 403 }) });
  show(<ShareDialog projectId="p" name="Bump" isOpen onClose={() => undefined} />);
  expect(await screen.findByText('Only the owner sees this.')).toBeInTheDocument();
  expect(screen.queryByLabelText('Share with')).toBeNull();
});

it('requests nothing while it is closed', () => {
  const { requests } = fakeServer({});
  show(<ShareDialog projectId="p" name="Bump" isOpen={false} onClose={() => undefined} />);
  expect(requests).toEqual([]);
});
