import { EditorView } from '@codemirror/view';
import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
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
const saved = () => requests.map(({ body }) => (body as { files: unknown[] }).files);
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
