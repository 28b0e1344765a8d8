import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { FileDifference } from '@/api/revisions';
import { useProjectStore } from '@/store/project';
import { projectDetail } from '@/store/testing';
import { refusal, revision } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { CompareTab } from './CompareTab';
import { useComparison, type Comparison } from './compare';

const REVISIONS = '/projects/p1/revisions';
const file = (path: string, change: FileDifference['change']) => ({ path, change, diff: null });
const text = (words: string) => new Response(words);

const answers: Record<string, unknown> = {};
let paths: () => string[];

function open(more: Partial<Comparison> = {}, files: readonly FileDifference[] = [file('a.py', 'changed')]) {
  const list = { items: [revision(6), revision(5), revision(4, { label: 'Works' })], next_before: null };
  for (const key of Object.keys(answers)) delete answers[key];
  Object.assign(answers, {
    [`GET ${REVISIONS}?limit=100`]: list,
    [`GET ${REVISIONS}/5/diff?against=4`]: { files },
    [`GET ${REVISIONS}/6/diff?against=5`]: { files: [file('now.py', 'changed')] },
  });
  for (const number of [4, 5, 6])
    for (const path of ['a.py', 'b.py', 'c.py', 'now.py'])
      answers[`GET ${REVISIONS}/${number}/files/${path}`] = text(`${path} of ${number}`);
  const { requests } = fakeServer(answers);
  paths = () => requests.map(({ method, path }) => `${method} ${path}`);
  useComparison.setState({
    comparison: { revision: revision(5), before: 4, against: 'before', path: null, ...more },
  });
  show(<CompareTab />);
  return requests;
}

const editors = () => screen.getAllByRole('textbox').map(({ textContent }) => textContent);

beforeEach(() => {
  openProject({});
  useProjectStore.setState({ revision: 6 });
  onTestFinished(() => useComparison.setState({ comparison: null }));
});

describe('CompareTab', () => {
  it('asks for a revision to be chosen', () => {
    fakeServer({});
    show(<CompareTab />);
    expect(screen.getByText('Choose a revision to see what it changed.')).toBeInTheDocument();
  });

  it('shows what a revision changed', async () => {
    open();
    expect(await screen.findByTestId('text-difference')).toBeInTheDocument();
    expect(editors()).toEqual(['a.py of 4', 'a.py of 5']);
    expect(screen.getByRole('heading', { level: 2 })).toHaveTextContent('Edited MainTree #5');
    expect(screen.getByRole('heading', { level: 3 })).toHaveTextContent('a.py');
    expect(screen.getByRole('region', { name: 'Revision 5' })).toBeInTheDocument();
    const when = new Date(revision(5).created_at).toLocaleString('en');
    expect(screen.getByText(when)).toHaveAttribute('datetime', revision(5).created_at);
    expect(screen.queryByRole('list', { name: 'Files that differ' })).toBeNull();
    expect(screen.queryByText(/ada/)).toBeNull();
  });

  it('shows the newest name, and the author if there are several', async () => {
    open();
    await screen.findByTestId('text-difference');
    answers[`GET ${REVISIONS}?limit=100`] = {
      items: [revision(6, { author: 'bob' }), revision(5, { label: 'Drives' })],
      next_before: null,
    };
    act(() => useProjectStore.setState({ revision: 7 }));
    await waitFor(() => expect(screen.getByRole('heading', { level: 2 })).toHaveTextContent('Drives #5'));
    expect(screen.getByText(/ada ·/)).toBeInTheDocument();
  });

  it('shows that there is no difference', async () => {
    open({}, []);
    expect(await screen.findByTestId('no-difference')).toHaveTextContent('The two versions are equal.');
    expect(screen.queryByRole('heading', { level: 3 })).toBeNull();
  });

  it('reports why the differences cannot be read', async () => {
    fakeServer({ [`GET ${REVISIONS}/5/diff?against=4`]: refusal('Not now.', { status: 503 }) });
    useComparison.setState({
      comparison: { revision: revision(5), before: 4, against: 'before', path: null },
    });
    show(<CompareTab />);
    expect(await screen.findByRole('alert')).toHaveTextContent('The revisions cannot be read: Not now.');
    expect(screen.queryByTestId('no-difference')).toBeNull();
  });
});

describe('files', () => {
  const files = [file('a.py', 'added'), file('b.py', 'removed'), file('c.py', 'changed')];

  it('are listed with their kind of change, and can be chosen', async () => {
    open({}, files);
    const list = within(await screen.findByRole('list', { name: 'Files that differ' }));
    const rows = () =>
      list
        .getAllByRole('button')
        .map((row) => [row.textContent, row.title, row.getAttribute('aria-current')]);
    expect(rows()).toEqual([
      ['+a.py', 'a.py · added', 'true'],
      ['−b.py', 'b.py · removed', 'false'],
      ['≠c.py', 'c.py · changed', 'false'],
    ]);
    await user.click(list.getByTitle('c.py · changed'));
    await waitFor(() => expect(editors()).toEqual(['c.py of 4', 'c.py of 5']));
    expect(rows()[2]?.[2]).toBe('true');
  });

  it('start with the one that was in front', async () => {
    open({ path: 'b.py' }, files);
    expect(await screen.findByRole('heading', { level: 3 })).toHaveTextContent('b.py');
  });

  it('start with the first if the one in front does not differ', async () => {
    open({ path: 'other.py' }, files);
    expect(await screen.findByRole('heading', { level: 3 })).toHaveTextContent('a.py');
  });
});

describe('the other side', () => {
  const against = () => screen.getByTestId('against');

  it('is the current state, or another revision', async () => {
    open();
    await screen.findByTestId('text-difference');
    expect(against()).toHaveValue('the state before it');
    await user.click(against());
    expect(screen.getAllByRole('option').map(({ textContent }) => textContent)).toEqual([
      'the state before it',
      'now (#6)',
      '#6 Edited MainTree',
      '#4 Works',
    ]);
    await user.click(screen.getByRole('option', { name: 'now (#6)' }));
    await waitFor(() => expect(editors()).toEqual(['now.py of 5', 'now.py of 6']));
    expect(useComparison.getState().comparison?.against).toBe('now');
    await user.click(against());
    await user.click(screen.getByRole('option', { name: '#4 Works' }));
    expect(useComparison.getState().comparison?.against).toBe(4);
    expect(paths()).toContain(`GET ${REVISIONS}/6/diff?against=5`);
    await user.click(against());
    await user.click(screen.getByRole('option', { name: 'the state before it' }));
    expect(useComparison.getState().comparison?.against).toBe('before');
  });
});

describe('restoring', () => {
  const restored = () => projectDetail(7, []);

  it.each([
    ['a.py as it was', ['a.py']],
    ['The whole project as it was', []],
  ])('%s', async (item, files) => {
    const requests = open();
    answers[`POST ${REVISIONS}/5/restore`] = restored();
    await screen.findByTestId('text-difference');
    await user.click(screen.getByRole('button', { name: 'Restore' }));
    await user.click(screen.getByRole('menuitem', { name: item }));
    expect(await screen.findByText('Revision 5 was restored as a new revision.')).toBeInTheDocument();
    expect(requests.find(({ method }) => method === 'POST')?.body).toEqual({ paths: files });
  });

  it('offers no file if none differs', async () => {
    open({}, []);
    await screen.findByTestId('no-difference');
    await user.click(screen.getByRole('button', { name: 'Restore' }));
    expect(screen.getAllByRole('menuitem').map(({ textContent }) => textContent)).toEqual([
      'The whole project as it was',
    ]);
  });

  it('is only for editors', async () => {
    useProjectStore.setState({ role: 'viewer' });
    open();
    await screen.findByTestId('text-difference');
    expect(screen.queryByRole('button', { name: 'Restore' })).toBeNull();
    expect(screen.queryByRole('button', { name: 'Name revision 5' })).toBeNull();
  });
});
