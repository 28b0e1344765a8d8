import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { projectDetail } from '@/store/testing';
import { noContent, refusal, summary } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { useProjectCommands, useProjects } from './useProjects';

const list = (offset: number) =>
  `GET /projects?search=bump&sort=name&shelf=archived&offset=${offset}&limit=48`;

function Page() {
  const found = useProjects('bump', 'name', 'archived');
  const { create, restore, unarchive, rename } = useProjectCommands();
  return (
    <>
      <p>{found.data?.pages.flatMap(({ items }) => items.map(({ id }) => id)).join(' ')}</p>
      <p>{rename.error?.message}</p>
      <button onClick={() => void found.fetchNextPage()}>more</button>
      <button onClick={() => create.mutate('empty')}>create</button>
      <button onClick={() => restore.mutate(summary('a'))}>restore</button>
      <button onClick={() => unarchive.mutate(summary('a'))}>unarchive</button>
      <button onClick={() => rename.mutate({ project: summary('a'), name: 'New' })}>rename</button>
    </>
  );
}

const click = (name: string) => user.click(screen.getByText(name));
let answers: Record<string, unknown>;
let requests: ReturnType<typeof fakeServer>['requests'];
const asked = () => requests.map(({ method, path }) => `${method} ${path}`);

beforeEach(async () => {
  window.history.pushState(null, '', '/');
  answers = {
    [list(0)]: { items: [summary('a')], total: 2, next_offset: 1 },
    [list(1)]: { items: [summary('b')], total: 2, next_offset: null },
  };
  ({ requests } = fakeServer(answers));
  show(<Page />);
  await screen.findByText('a');
});

describe('useProjects', () => {
  it('asks for a page, and for the next', async () => {
    await click('more');
    expect(await screen.findByText('a b')).toBeInTheDocument();
    expect(asked()).toEqual([list(0), list(1)]);
    await click('more');
    expect(asked()).toHaveLength(2);
  });
});

describe('useProjectCommands', () => {
  it('makes a project, and opens it', async () => {
    answers['POST /projects'] = projectDetail(1, []);
    await click('create');
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(requests.at(-1)?.body).toEqual({ template: 'empty' });
  });

  it.each([
    ['restore', 'POST /projects/a/restore'],
    ['unarchive', 'POST /projects/a/unarchive'],
    ['rename', 'PATCH /projects/a'],
  ])('lists again after %s', async (command, request) => {
    answers[request] = noContent();
    answers[list(0)] = { items: [summary('z')], total: 1, next_offset: null };
    await click(command);
    expect(await screen.findByText('z')).toBeInTheDocument();
    expect(asked()).toEqual([list(0), request, list(0)]);
  });

  it('renames a project based on its known revision', async () => {
    answers['PATCH /projects/a'] = noContent();
    await click('rename');
    await expect.poll(() => requests[1]?.body).toEqual({ name: 'New', base_revision: 3 });
  });

  it.each([
    ['create', 'POST /projects'],
    ['restore', 'POST /projects/a/restore'],
    ['unarchive', 'POST /projects/a/unarchive'],
  ])('reports why %s was refused', async (command, request) => {
    answers[request] = refusal('No room.', { hint: 'Delete one.' });
    await click(command);
    expect(await screen.findByText('No room. Delete one.')).toBeInTheDocument();
    expect(screen.getByText('That did not work')).toBeInTheDocument();
    expect(window.location.pathname).toBe('/');
  });

  it('leaves the report of a refused name to the card', async () => {
    answers['PATCH /projects/a'] = refusal('The name is taken.');
    await click('rename');
    expect(await screen.findByText('The name is taken.')).toBeInTheDocument();
    expect(screen.queryByText('That did not work')).toBeNull();
  });
});
