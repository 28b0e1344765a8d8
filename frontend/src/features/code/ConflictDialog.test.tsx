import { EditorView } from '@codemirror/view';
import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Conflict } from '@/api/types';
import { useProjectStore } from '@/store/project';
import { useSavingStore } from '@/store/saving/store';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { ConflictDialog } from './ConflictDialog';

const SAVE = 'POST /projects/p1/changes';
const conflict = (path: string, more: Partial<Conflict> = {}): Conflict => ({
  path,
  base_revision: 1,
  theirs: { revision: 5, content: 'theirs' },
  mine: { content: 'mine' },
  ...more,
});

let answers: Record<string, unknown>;
let requests: ReturnType<typeof fakeServer>['requests'];
const saved = () =>
  requests.filter(({ method }) => method === 'POST').map(({ body }) => (body as { files: unknown[] }).files);
const button = (name: string) => user.click(screen.getByRole('button', { name }));
const text = (path: string) => useProjectStore.getState().currentText(path);

beforeEach(() => {
  answers = {};
  ({ requests } = fakeServer(answers));
  openProject({ texts: { 'a.md': 'mine', 'b.md': 'mine' } });
  onTestFinished(() => useSavingStore.setState(useSavingStore.getInitialState(), true));
});

async function open(...conflicts: Conflict[]) {
  show(<ConflictDialog />);
  act(() => useSavingStore.setState({ state: { kind: 'conflict', conflicts } }));
  await screen.findByRole('textbox', { name: 'Yours' });
}

const edit = (words: string) => {
  const view = EditorView.findFromDOM(screen.getByRole('textbox', { name: 'Yours' }));
  act(() => view?.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: words } }));
};

describe('ConflictDialog', () => {
  it('is absent without a conflict', () => {
    show(<ConflictDialog />);
    expect(screen.queryByRole('dialog')).toBeNull();
  });

  it('shows both versions, and cannot be closed without a choice', async () => {
    await open(conflict('a.md'));
    expect(screen.getByRole('dialog', { name: 'Two versions of a.md' })).toBeInTheDocument();
    expect(screen.getByRole('textbox', { name: 'On the server' })).toHaveTextContent('theirs');
    expect(screen.getByRole('textbox', { name: 'Yours' })).toHaveTextContent('mine');
    expect(screen.queryByText(/more file/)).toBeNull();
    await user.keyboard('{Escape}');
    expect(screen.getByRole('dialog')).toBeInTheDocument();
    expect(screen.queryByRole('button', { name: 'Close' })).toBeNull();
  });

  it('loads a large version of the server, and never deletes the file in its place', async () => {
    vi.stubGlobal('fetch', async () => new Response('the whole text', { headers: { 'x-revision': '6' } }));
    onTestFinished(() => void vi.unstubAllGlobals());
    await open(conflict('a.md', { theirs: { revision: 5, content: null } }));
    expect(screen.getByRole('textbox', { name: 'On the server' })).toHaveTextContent('the whole text');
    await button("Take the server's");
    expect(text('a.md')).toBe('the whole text');
  });

  it('leaves a way out if the large version cannot be loaded: to keep the own text', async () => {
    show(<ConflictDialog />);
    const conflicts = [conflict('a.md', { theirs: { revision: 5, content: null } })];
    act(() => useSavingStore.setState({ state: { kind: 'conflict', conflicts } }));
    expect(await screen.findByRole('alert')).toHaveTextContent('a.md could not be loaded');
    answers[SAVE] = { revision: 6, files: [], actions: [], diagnostics: [] };
    await button('Keep mine');
    await waitFor(() => expect(screen.queryByRole('dialog')).toBeNull());
    expect(text('a.md')).toBe('mine');
  });

  it('sends an own text that is empty in place of a large version, or of a deletion', async () => {
    answers[SAVE] = { revision: 6, files: [], actions: [], diagnostics: [] };
    openProject({ texts: { 'a.md': '', 'b.md': '' } });
    show(<ConflictDialog />);
    const mine = { content: '' };
    const conflicts = [
      conflict('a.md', { theirs: { revision: 5, content: null }, mine }),
      conflict('b.md', { theirs: null, mine }),
    ];
    act(() => useSavingStore.setState({ state: { kind: 'conflict', conflicts } }));
    await screen.findByRole('alert');
    await button('Keep mine');
    await screen.findByRole('dialog', { name: 'Two versions of b.md' });
    await button('Keep mine');
    await waitFor(() => expect(screen.queryByRole('dialog')).toBeNull());
    await waitFor(() =>
      expect(saved().flat()).toEqual([
        { path: 'a.md', base_revision: 5, content: '' },
        { path: 'b.md', base_revision: 0, content: '' },
      ]),
    );
  });

  it('does not offer the version of the server if that is binary: it would delete the file', async () => {
    vi.stubGlobal('fetch', async () => new Response(new Uint8Array([0, 255]), { headers: {} }));
    await open(conflict('a.md', { theirs: { revision: 5, content: null } }));
    expect(screen.queryByRole('button', { name: "Take the server's" })).toBeNull();
    expect(screen.getByRole('button', { name: 'Keep mine' })).toBeInTheDocument();
  });

  it('loads a version once for each project', async () => {
    const fetched = vi.fn(async () => new Response('whole', { headers: { 'x-revision': '5' } }));
    vi.stubGlobal('fetch', fetched);
    const large = conflict('a.md', { theirs: { revision: 5, content: null } });
    await open(large);
    act(() => useProjectStore.setState({ projectId: 'another' }));
    await waitFor(() => expect(fetched).toHaveBeenCalledTimes(2));
  });

  it.each([
    ["Take the server's", 'theirs', []],
    ['Keep mine', 'mine', ['mine']],
    ['Save the right side', 'both', ['both']],
  ])('%s keeps “%s”', async (choice, kept, contents) => {
    answers[SAVE] = { revision: 6, files: [], actions: [], diagnostics: [] };
    await open(conflict('a.md'));
    if (kept === 'both') edit('both');
    await button(choice);
    expect(text('a.md')).toBe(kept);
    await waitFor(() => expect(screen.queryByRole('dialog')).toBeNull());
    await waitFor(() =>
      expect(saved().flat()).toEqual(
        contents.map((content) => ({ path: 'a.md', base_revision: 5, content })),
      ),
    );
  });

  it('accepts the deletion on the server', async () => {
    await open(conflict('a.md', { theirs: null }));
    expect(screen.getByRole('textbox', { name: 'On the server' })).toHaveTextContent('');
    await button("Take the server's");
    expect(text('a.md')).toBeNull();
  });

  it('asks about one file after the other', async () => {
    await open(conflict('a.md'), conflict('b.md'), conflict('c.md'));
    expect(screen.getByText(/2 more files follow\./)).toBeInTheDocument();
    await button('Keep mine');
    expect(await screen.findByRole('dialog', { name: 'Two versions of b.md' })).toBeInTheDocument();
    expect(screen.getByText(/One more file follows\./)).toBeInTheDocument();
    expect(requests).toEqual([]);
  });

  it('reports why a choice could not be saved', async () => {
    answers[SAVE] = refusal('The disk is full.');
    await open(conflict('a.md'));
    await button('Keep mine');
    expect(await screen.findByText('The choice could not be saved')).toBeInTheDocument();
    expect(screen.getByText('The disk is full.')).toBeInTheDocument();
    expect(text('a.md')).toBe('mine');
  });
});
