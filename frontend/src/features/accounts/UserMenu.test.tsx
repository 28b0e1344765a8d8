import { act, screen, waitFor } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import type { Me } from '@/api/types';
import { perform, useCommandTable } from '@/commands/registry';
import { account, watchLocation } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { UserMenu } from './UserMenu';

async function open(me: Me) {
  const { requests } = fakeServer({ 'GET /me': me, 'GET /groups': { items: [] } });
  const view = show(<UserMenu />);
  await waitFor(() => expect(requests).not.toEqual([]));
  await act(() => Promise.resolve());
  return view;
}

const openMenu = async () => user.click(await screen.findByRole('button', { name: /Account of ada$/ }));
const items = () =>
  screen.getAllByRole('menuitem').map((item) => [item.textContent, item.getAttribute('href')]);
const commands = () => Object.keys(useCommandTable.getState().commands).sort();

describe('UserMenu', () => {
  it('has the groups, the data, the account and signing out', async () => {
    await open(account());
    await openMenu();
    expect(items()).toEqual([
      ['Groups', null],
      ['Storage and data', null],
      ['Password and second factor', '/accounts/password/change/'],
      ['Sign out', '/accounts/logout/'],
    ]);
    expect(screen.getByText('Ada Lovelace')).toBeInTheDocument();
    expect(screen.getByText('ada@example.org')).toBeInTheDocument();
  });

  it('names a user without a name or an address by account and role', async () => {
    await open(account({ name: '', email: '', role: 'teacher' }));
    await openMenu();
    expect(screen.getByText('ada')).toBeInTheDocument();
    expect(screen.getByText('Teacher')).toBeInTheDocument();
  });

  it('has the administration pages for administrators', async () => {
    await open(account({ role: 'administrator' }));
    await openMenu();
    expect(items()).toContainEqual(['Administration', '/admin/']);
  });

  it.each([
    ['Groups', 'Groups'],
    ['Storage and data', 'Storage and data'],
  ])('opens %s', async (item, title) => {
    await open(account());
    await openMenu();
    await user.click(screen.getByRole('menuitem', { name: item }));
    expect(screen.getByRole('dialog', { name: title })).toBeInTheDocument();
    await user.keyboard('{Escape}');
    expect(screen.queryByRole('dialog', { name: title })).toBeNull();
  });

  it('registers the same commands for the palette while it is shown', async () => {
    const { unmount } = await open(account());
    await screen.findByRole('button', { name: /Account of ada$/ });
    const rows = ['account.account', 'account.data.title', 'account.groups.title', 'account.signOut'];
    expect(commands()).toEqual(rows);
    act(() => perform('account.groups.title'));
    expect(screen.getByRole('dialog', { name: 'Groups' })).toBeInTheDocument();
    act(() => perform('account.data.title'));
    expect(screen.getByRole('dialog', { name: 'Storage and data' })).toBeInTheDocument();
    unmount();
    expect(commands()).toEqual([]);
  });

  it('opens the pages of the server', async () => {
    const assign = watchLocation();
    await open(account({ role: 'administrator' }));
    await screen.findByRole('button', { name: /Account of ada$/ });
    for (const id of ['account', 'administration', 'signOut']) perform(`account.${id}`);
    expect(assign.mock.calls.flat()).toEqual(['/accounts/password/change/', '/admin/', '/accounts/logout/']);
  });

  it('asks guests to sign in, and brings them back', async () => {
    window.history.pushState(null, '', '/projects/p1');
    await open(account({ role: 'guest' }));
    expect(await screen.findByRole('link', { name: 'Sign in' })).toHaveAttribute(
      'href',
      '/accounts/login/?next=%2Fprojects%2Fp1',
    );
    expect(screen.queryByRole('button')).toBeNull();
    expect(commands()).toEqual([]);
    window.history.pushState(null, '', '/');
  });

  it('is absent on localhost', async () => {
    await open(account({ mode: 'local' }));
    expect(screen.queryByRole('button')).toBeNull();
    expect(screen.queryByRole('link')).toBeNull();
    expect(commands()).toEqual([]);
  });
});
