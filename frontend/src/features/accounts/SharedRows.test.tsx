import { screen, within } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { noContent } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import type { Shares } from './api';
import { label, SharedRows } from './SharedRows';

const shares: Shares = {
  owner: { username: 'ada', name: '' },
  people: [
    { username: 'bob', name: 'Bob Ross', role: 'viewer' },
    { username: 'cy', name: '', role: 'editor' },
  ],
  groups: [{ id: 'g1', name: 'Robotics', role: 'viewer' }],
  links: [],
};

async function open() {
  const { requests } = fakeServer({
    'POST /projects/p/shares': shares,
    'PUT /projects/p/shares/groups/g1': shares,
    'DELETE /projects/p/shares/people/bob': noContent(),
    'DELETE /projects/p/shares/groups/g1': noContent(),
  });
  const onMakeOwner = vi.fn();
  show(
    <ul>
      <SharedRows shares={shares} projectId="p" run={(step) => void step()} onMakeOwner={onMakeOwner} />
    </ul>,
  );
  return { requests, onMakeOwner };
}

const click = (name: string) => user.click(screen.getByRole('button', { name }));

async function choose(who: string, role: string) {
  const field = screen.getByRole('combobox', { name: `What ${who} may do` });
  await user.click(field);
  const list = document.getElementById(field.getAttribute('aria-controls') ?? '') as HTMLElement;
  await user.click(within(list).getByRole('option', { name: role }));
}

it('names people by name and account', () => {
  expect(label({ username: 'bob', name: 'Bob Ross' })).toBe('Bob Ross (bob)');
  expect(label({ username: 'cy', name: '' })).toBe('cy');
});

describe('SharedRows', () => {
  it('shows the role of each person and group', async () => {
    await open();
    expect(screen.getAllByRole('listitem').map((row) => row.querySelector('p')?.title)).toEqual([
      'Bob Ross (bob)',
      'cy',
      'Robotics',
    ]);
    const roles = ['bob', 'cy', 'Robotics'].map(
      (who) => (screen.getByRole('combobox', { name: `What ${who} may do` }) as HTMLInputElement).value,
    );
    expect(roles).toEqual(['Can view', 'Can edit', 'Can view']);
  });

  it('gives a person or a group another role', async () => {
    const { requests } = await open();
    await choose('bob', 'Can edit');
    await choose('Robotics', 'Can edit');
    expect(requests).toEqual([
      { method: 'POST', path: '/projects/p/shares', body: { name: 'bob', role: 'editor' } },
      { method: 'PUT', path: '/projects/p/shares/groups/g1', body: { role: 'editor' } },
    ]);
  });

  it('removes a person or a group', async () => {
    const { requests } = await open();
    await click('Remove bob');
    await click('Remove Robotics');
    expect(requests.map(({ method, path }) => `${method} ${path}`)).toEqual([
      'DELETE /projects/p/shares/people/bob',
      'DELETE /projects/p/shares/groups/g1',
    ]);
  });

  it('offers the project to editors only', async () => {
    const { onMakeOwner } = await open();
    expect(screen.queryByRole('button', { name: 'Make bob the owner' })).toBeNull();
    await click('Make cy the owner');
    expect(onMakeOwner).toHaveBeenCalledWith('cy');
  });
});
