import { act, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { setScope } from '@/store/revisions/scope';
import type { DocumentTab } from '@/workspace/documents';
import { useTabs } from '@/workspace/tabs';
import { refusal, revision } from '../../../harness/requests';
import { watchTabs } from '../../../harness/tabs';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { useComparison } from './compare';
import { RevisionsPanel } from './RevisionsPanel';

const LIST = 'GET /projects/p1/revisions?limit=100';
const TREE = `${LIST}&path=trees%2FMain.json`;
const page = (...numbers: number[]) => ({
  items: numbers.map((number) => revision(number)),
  next_before: null,
});

function open(answers: Record<string, unknown>, front: DocumentTab | null = null) {
  const { requests } = fakeServer(answers);
  openProject({ trees: { Main: { r: { type: 'Sequence' } } } });
  useTabs.setState({ front });
  show(<RevisionsPanel />);
  return () => requests.map(({ method, path }) => `${method} ${path}`);
}

const rows = () =>
  within(screen.getByRole('list', { name: 'Revisions, the newest first' }))
    .queryAllByTestId(/^revision-/)
    .map((row) => row.dataset['testid']);
const comparison = () => useComparison.getState().comparison;

beforeEach(() => {
  onTestFinished(() => {
    useTabs.setState(useTabs.getInitialState(), true);
    useComparison.setState({ comparison: null });
    setScope('file');
  });
});

describe('scope', () => {
  it('is the whole project if no document is in front', async () => {
    const asked = open({ [LIST]: page(2) });
    expect(await screen.findByTestId('revision-2')).toBeInTheDocument();
    expect(asked()).toEqual([LIST]);
    expect(screen.getByRole('radio', { name: 'Whole project' })).toBeChecked();
    expect(screen.getByRole('radio', { name: 'This file' })).toBeDisabled();
  });

  it('is the tree in front, or the whole project', async () => {
    const asked = open({ [TREE]: page(2), [LIST]: page(3) }, { kind: 'tree', id: 'Main' });
    expect(await screen.findByTestId('revision-2')).toBeInTheDocument();
    expect(screen.getByRole('radio', { name: 'Main' })).toBeChecked();
    await user.click(screen.getByRole('radio', { name: 'Whole project' }));
    expect(await screen.findByTestId('revision-3')).toBeInTheDocument();
    expect(asked()).toEqual([TREE, LIST]);
    await user.click(screen.getByRole('radio', { name: 'Main' }));
    expect(await screen.findByTestId('revision-2')).toBeInTheDocument();
  });

  it('is the file in front', async () => {
    open({ [`${LIST}&path=actions%2FGo.py`]: page(4) }, { kind: 'file', path: 'actions/Go.py' });
    expect(await screen.findByTestId('revision-4')).toBeInTheDocument();
    expect(screen.getByRole('radio', { name: 'Go.py' })).toBeEnabled();
  });
});

describe('list', () => {
  it('shows that there are no revisions', async () => {
    open({ [LIST]: page() });
    expect(await screen.findByText(/Nothing has been saved here yet/)).toBeInTheDocument();
  });

  it('groups the saves of one sitting, and unfolds them', async () => {
    open({ [LIST]: page(4, 3, 2) });
    await screen.findByTestId('revision-4');
    expect(rows()).toEqual(['revision-4']);
    await user.click(screen.getByRole('button', { name: '3 saves' }));
    expect(rows()).toEqual(['revision-4', 'revision-3', 'revision-2']);
    expect(screen.getByTestId('revision-3')).toHaveTextContent(/[AP]M$/);
    expect(screen.getByTestId('revision-4')).toHaveTextContent(/ago$/);
    await user.click(screen.getByRole('button', { name: '3 saves' }));
    expect(rows()).toEqual(['revision-4']);
  });

  it('shows authors if there are several', async () => {
    const items = [revision(4), revision(3, { author: 'bob' })];
    open({ [LIST]: { items, next_before: null } });
    expect(await screen.findByTestId('revision-4')).toHaveTextContent(/ada$/);
    expect(screen.getByTestId('revision-3')).toHaveTextContent(/bob$/);
  });

  it('fetches older ones on demand', async () => {
    const items = [revision(4, { label: 'last' })];
    open({
      [LIST]: { items, next_before: 4 },
      [`${LIST}&before=4`]: { items: [revision(1, { label: 'first' })], next_before: null },
    });
    await user.click(await screen.findByRole('button', { name: 'Older ones' }));
    expect(await screen.findByTestId('revision-1')).toBeInTheDocument();
    expect(screen.queryByRole('button', { name: 'Older ones' })).toBeNull();
  });

  it('reports why it cannot be read, and tries again', async () => {
    const answers: Record<string, unknown> = { [LIST]: refusal('Not now.', { status: 503 }) };
    open(answers);
    const alert = await screen.findByRole('alert');
    expect(alert).toHaveTextContent('The revisions cannot be read: Not now.');
    expect(screen.queryByText(/Nothing has been saved/)).toBeNull();
    answers[LIST] = page(2);
    await user.click(screen.getByRole('button', { name: 'Try again' }));
    expect(await screen.findByTestId('revision-2')).toBeInTheDocument();
    expect(screen.queryByRole('alert')).toBeNull();
  });
});

describe('choice', () => {
  it('compares a group with the state before it, in a separate tab', async () => {
    open({ [LIST]: page(4, 3, 2) });
    const openTabs = watchTabs();
    await user.click(await screen.findByTestId('revision-4'));
    expect(comparison()).toEqual({ revision: revision(4), before: 1, against: 'before', path: null });
    expect(openTabs()).toEqual([{ kind: 'compare' }]);
    expect(screen.getByTestId('revision-4')).toHaveAttribute('aria-current', 'true');
    await user.click(screen.getByRole('button', { name: '3 saves' }));
    await user.click(screen.getByTestId('revision-3'));
    expect(comparison()).toMatchObject({ before: 2, revision: { number: 3 } });
    expect(screen.getByTestId('revision-4')).toHaveAttribute('aria-current', 'false');
    expect(screen.getByTestId('revision-3')).toHaveAttribute('aria-current', 'true');
  });

  it('shows the file in front, and keeps comparing with the current state', async () => {
    open({ [TREE]: page(2) }, { kind: 'tree', id: 'Main' });
    act(() => {
      useComparison.setState({
        comparison: { revision: revision(9), before: 8, against: 'now', path: null },
      });
    });
    await user.click(await screen.findByTestId('revision-2'));
    expect(comparison()).toMatchObject({ against: 'now', path: 'trees/Main.json' });
  });

  it('does not keep comparing with another revision', async () => {
    open({ [LIST]: page(2) });
    act(() => {
      useComparison.setState({ comparison: { revision: revision(9), before: 8, against: 5, path: null } });
    });
    await user.click(await screen.findByTestId('revision-2'));
    expect(comparison()?.against).toBe('before');
  });
});
