import { expect, it } from 'vitest';
import { noContent } from '../../../harness/requests';
import { fakeServer } from '../../../harness/testing';
import { accounts } from './api';

it.each([
  ['shares', () => accounts.shares('p 1'), 'GET /projects/p%201/shares', undefined],
  [
    'a share with a person',
    () => accounts.shareWithPerson('p', 'bob', 'editor'),
    'POST /projects/p/shares',
    { name: 'bob', role: 'editor' },
  ],
  [
    'its end',
    () => accounts.unshareWithPerson('p', 'b/b'),
    'DELETE /projects/p/shares/people/b%2Fb',
    undefined,
  ],
  ['a new owner', () => accounts.makeOwner('p', 'bob'), 'POST /projects/p/transfer', { name: 'bob' }],
  [
    'a share with a group',
    () => accounts.shareWithGroup('p', 'g', 'viewer'),
    'PUT /projects/p/shares/groups/g',
    { role: 'viewer' },
  ],
  ['its end', () => accounts.unshareWithGroup('p', 'g'), 'DELETE /projects/p/shares/groups/g', undefined],
  ['a link', () => accounts.makeLink('p'), 'POST /projects/p/shares/links', {}],
  ['its end', () => accounts.revokeLink('p', 'l'), 'DELETE /projects/p/shares/links/l', undefined],
  ['a group', () => accounts.createGroup('Robots'), 'POST /groups', { name: 'Robots' }],
  ['its end', () => accounts.deleteGroup('g'), 'DELETE /groups/g', undefined],
  [
    'the end of a membership',
    () => accounts.removeMember('g', 'b b'),
    'DELETE /groups/g/members/b%20b',
    undefined,
  ],
  ['an invitation', () => accounts.invite('g'), 'POST /groups/g/invitations', { days: 14, max_uses: 40 }],
  ['its end', () => accounts.revokeInvitation('i'), 'DELETE /invitations/i', undefined],
  ['the use of the disk', () => accounts.usage(), 'GET /me/usage', undefined],
  ['the end of the account', () => accounts.deleteMe('ada'), 'DELETE /me/data', { username: 'ada' }],
])('requests %s', async (_, ask, request, body) => {
  const { requests } = fakeServer({ [request]: noContent() });
  await ask();
  expect(requests.map(({ method, path }) => `${method} ${path}`)).toEqual([request]);
  expect(requests[0]?.body).toEqual(body);
});

it('lists the groups of a user', async () => {
  fakeServer({ 'GET /groups': { items: [{ id: 'g' }] } });
  expect(await accounts.groups()).toEqual([{ id: 'g' }]);
});

it('has the address for the download of all data', () => {
  expect(accounts.dataUrl).toBe('/api/v1/me/data');
});
