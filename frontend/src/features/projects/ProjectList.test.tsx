import { act, cleanup, screen, waitFor } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { fetchAgain, queries } from '@/api/queries';
import type { ProjectSummary } from '@/api/types';
import { projectDetail } from '@/store/testing';
import { refusal, summary } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { ProjectList } from './ProjectList';
import { useProjectCommands } from './useProjects';

const page = (items: readonly ProjectSummary[], total = items.length, next: number | null = null) => ({
  items,
  total,
  next_offset: next,
});
const named = (...names: string[]) => page(names.map((name) => summary(name, { name })));

const list = (search = '', sort = '-updated_at', shelf = 'current', offset = 0) =>
  `GET /projects?search=${search}&sort=${sort}&shelf=${shelf}&offset=${offset}&limit=48`;

function List() {
  return <ProjectList actions={useProjectCommands()} searchField={{ current: null }} />;
}

function open(answers: Record<string, unknown>) {
  const { requests } = fakeServer(answers);
  show(<List />);
  return () => requests.map(({ method, path }) => `${method} ${path}`);
}

const cards = () =>
  screen.queryAllByTestId('project-card').map((card) => card.querySelector('a[title]')?.textContent);
const shelf = async (name: string) => {
  await user.click(screen.getByRole('combobox', { name: 'Which projects' }));
  await user.click(screen.getByRole('option', { name }));
};

describe('ProjectList', () => {
  it('shows the projects, the last changed first', async () => {
    const asked = open({ [list()]: named('Bump', 'Go') });
    expect(cards()).toEqual([]);
    expect(await screen.findByText('Bump')).toBeInTheDocument();
    expect(cards()).toEqual(['Bump', 'Go']);
    expect(screen.getByTestId('projects')).toHaveAttribute('data-total', '2');
    expect(asked()).toEqual([list()]);
    expect(screen.queryByText('No projects yet')).toBeNull();
    expect(screen.queryByTestId('more-projects')).toBeNull();
  });

  it('shows a project that was made after the list was cached', async () => {
    const answers: Record<string, unknown> = { [list()]: named() };
    open(answers);
    expect(await screen.findByText('No projects yet')).toBeInTheDocument();
    cleanup();
    answers[list()] = named('Bump and go');
    show(<List />);
    expect(screen.queryByText('No projects yet')).toBeNull();
    expect(await screen.findByText('Bump and go')).toBeInTheDocument();
  });

  it('orders by name on demand', async () => {
    open({ [list()]: named('Go', 'Bump'), [list('', 'name')]: named('Bump', 'Go') });
    await screen.findByText('Go');
    await user.click(screen.getByRole('radio', { name: 'Name' }));
    await waitFor(() => expect(cards()).toEqual(['Bump', 'Go']));
  });

  it('searches shortly after the last key', async () => {
    const asked = open({
      [list()]: named('Go', 'Bump'),
      [list('bump')]: named('Bump'),
      [list('bumper')]: named(),
    });
    await screen.findByText('Go');
    const search = screen.getByRole('searchbox', { name: 'Search projects' });
    await user.type(search, ' bump');
    await waitFor(() => expect(cards()).toEqual(['Bump']));
    await user.type(search, 'er');
    expect(await screen.findByText('No project has the name “bumper”.')).toBeInTheDocument();
    expect(screen.queryByText('No projects yet')).toBeNull();
    expect(asked()).toEqual([list(), list('bump'), list('bumper')]);
  });

  it('offers an example if there is none', async () => {
    const answers: Record<string, unknown> = { [list()]: named(), 'POST /projects': projectDetail(1, []) };
    const asked = open(answers);
    await user.click(await screen.findByRole('button', { name: 'Open the bump-and-go example' }));
    await waitFor(() => expect(asked()).toContain('POST /projects'));
  });

  it.each([
    ['Archive', 'archived', 'The archive is empty.'],
    ['Deleted', 'deleted', 'Nothing was deleted recently.'],
  ])('shows the shelf %s', async (name, value, words) => {
    open({ [list()]: named('Go'), [list('', '-updated_at', value)]: named() });
    await screen.findByText('Go');
    await shelf(name);
    expect(await screen.findByText(words)).toBeInTheDocument();
    expect(screen.queryByText('No projects yet')).toBeNull();
    expect(cards()).toEqual([]);
  });

  it('offers to restore deleted projects, and shows none of the previous shelf', async () => {
    open({ [list()]: named('Go'), [list('', '-updated_at', 'deleted')]: named('Old') });
    await screen.findByText('Go');
    await shelf('Deleted');
    expect(cards()).toEqual([]);
    expect(screen.queryByRole('button', { name: 'Restore' })).toBeNull();
    expect(await screen.findByRole('button', { name: 'Restore' })).toBeInTheDocument();
    expect(screen.getByTestId('project-card')).toHaveTextContent(/^Old/);
  });

  it('fetches the next page on demand, and shows how many are left', async () => {
    open({
      [list()]: page([summary('a'), summary('b')], 5, 2),
      [list('', '-updated_at', 'current', 2)]: page([summary('c'), summary('d'), summary('e')], 5),
    });
    await user.click(await screen.findByRole('button', { name: 'Show 3 more' }));
    await waitFor(() => expect(cards()).toHaveLength(5));
    expect(screen.queryByTestId('more-projects')).toBeNull();
  });

  it('shows more also where a project is archived while they are on their way', async () => {
    const next = list('', '-updated_at', 'current', 2);
    const answers: Record<string, unknown> = {
      [list()]: page([summary('a'), summary('b')], 3, 2),
      [next]: new Promise(() => undefined),
    };
    const asked = open(answers);
    await user.click(await screen.findByRole('button', { name: 'Show 1 more' }));
    await waitFor(() => expect(asked()).toContain(next));
    answers[next] = page([summary('c')], 3);
    await act(() => fetchAgain(queries, ['projects']));
    await waitFor(() => expect(cards()).toHaveLength(3));
  });

  it('reports why the list cannot be read, and tries again', async () => {
    const answers: Record<string, unknown> = { [list()]: refusal('Not now.', { status: 503 }) };
    open(answers);
    expect(await screen.findByRole('alert')).toHaveTextContent('Your projects could not be loadedNot now.');
    expect(screen.queryByText('No projects yet')).toBeNull();
    answers[list()] = named('Bump');
    await user.click(screen.getByRole('button', { name: 'Try again' }));
    expect(await screen.findByText('Bump')).toBeInTheDocument();
    expect(screen.queryByRole('alert')).toBeNull();
  });
});
