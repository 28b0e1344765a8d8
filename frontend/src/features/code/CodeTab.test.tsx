import { undo } from '@codemirror/commands';
import { EditorView } from '@codemirror/view';
import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { setLanguage } from '@/i18n';
import { useProjectStore } from '@/store/project';
import { initialSession } from '@/store/session/reduce';
import { clearTextFindings, setTextFindings } from '@/store/problems/texts';
import { useSessionStore } from '@/store/session/store';
import { useLanguageStore } from '@/store/language';
import { aimAt, useTabs } from '@/workspace/tabs';
import { fakeServer, openProject, show } from '../../../harness/testing';
import { CodeTab } from './CodeTab';

const PATH = 'notes.md';
const TEXT = 'one\n  two\nthree';
const store = () => useProjectStore.getState();
const kept = () => store().currentText(PATH);

const editor = () => {
  const view = EditorView.findFromDOM(screen.getByTestId('code-editor'));
  if (!view) throw new Error('There is no editor.');
  return view;
};
const shown = () => editor().state.doc.toString();
const type = (from: number, insert: string) => act(() => editor().dispatch({ changes: { from, insert } }));
const marks = () =>
  [...editor().dom.querySelectorAll('[class*="cm-lintRange-"]')].map(({ textContent }) => textContent);

beforeEach(() => {
  fakeServer({});
  openProject({ texts: { [PATH]: TEXT, 'a.json': '{"a": }', 'other.md': 'other' } });
  onTestFinished(() => {
    useTabs.setState(useTabs.getInitialState(), true);
    useSessionStore.setState(initialSession, true);
    useLanguageStore.setState(useLanguageStore.getInitialState(), true);
    clearTextFindings();
    localStorage.clear();
  });
});

describe('CodeTab', () => {
  it('edits a file of the project', () => {
    show(<CodeTab path={PATH} />);
    expect(screen.getByRole('textbox', { name: 'Source of notes.md' })).toBeInTheDocument();
    expect(shown()).toBe(TEXT);
    expect(store().pendingChanges()).toEqual([]);
    type(3, '!');
    expect(kept()).toBe('one!\n  two\nthree');
    expect(screen.queryByTestId('language-state')).toBeNull();
  });

  it('shows that a file was deleted', () => {
    show(<CodeTab path={PATH} />);
    act(() => store().deleteFile(PATH));
    expect(screen.getByText('notes.md is not in this project any more.')).toBeInTheDocument();
    expect(screen.queryByTestId('code-editor')).toBeNull();
  });

  it('follows changes from elsewhere, and keeps the cursor in place', () => {
    show(<CodeTab path={PATH} />);
    act(() => editor().dispatch({ selection: { anchor: 15 } }));
    act(() => store().setFileText(PATH, `zero ${TEXT}`));
    expect(shown()).toBe(`zero ${TEXT}`);
    expect(editor().state.selection.main.head).toBe(20);
    expect(kept()).toBe(`zero ${TEXT}`);
    act(() => void undo(editor()));
    expect(kept()).toBe(TEXT);
  });

  it('keeps the line ends of a file until it is edited', () => {
    act(() => store().setFileText(PATH, 'one\r\ntwo'));
    show(<CodeTab path={PATH} />);
    expect(shown()).toBe('one\ntwo');
    expect(kept()).toBe('one\r\ntwo');
  });

  it('keeps the undo steps when the language of the page changes', () => {
    onTestFinished(() => setLanguage('en'));
    show(<CodeTab path={PATH} />);
    type(0, 'x');
    act(() => editor().focus());
    act(() => setLanguage('es'));
    expect(screen.queryByRole('textbox', { name: 'Source of notes.md' })).toBeNull();
    expect(shown()).toBe(`x${TEXT}`);
    expect(editor().hasFocus).toBe(true);
    act(() => void undo(editor()));
    expect(kept()).toBe(TEXT);
  });

  it('cannot be edited by a viewer', () => {
    useProjectStore.setState({ role: 'viewer' });
    show(<CodeTab path={PATH} />);
    expect(editor().state.readOnly).toBe(true);
  });
});

describe('the cursor', () => {
  const line = () => editor().state.doc.lineAt(editor().state.selection.main.head).number;

  it('goes to a requested line, behind its indentation', () => {
    act(() => aimAt(PATH, 2));
    show(<CodeTab path={PATH} />);
    expect(editor().state.selection.main.head).toBe(6);
    expect(editor().hasFocus).toBe(true);
  });

  it('goes there once for each request', () => {
    show(<CodeTab path={PATH} />);
    expect(line()).toBe(1);
    act(() => aimAt(PATH, 2));
    expect(line()).toBe(2);
    act(() => editor().dispatch({ selection: { anchor: 0 } }));
    type(0, 'x');
    expect(line()).toBe(1);
    act(() => aimAt(PATH, 2));
    expect(line()).toBe(2);
  });

  it('goes to the last line if there are fewer, and ignores requests for another file', () => {
    show(<CodeTab path={PATH} />);
    act(() => aimAt('other.md', 2));
    expect(line()).toBe(1);
    act(() => aimAt(PATH, 99));
    expect(line()).toBe(3);
  });
});

describe('marks', () => {
  it('show the findings of the checks, and move with the text', () => {
    show(<CodeTab path={PATH} />);
    act(() =>
      store().setChecked({
        actions: [],
        diagnostics: [{ code: 'X1', severity: 'error', message: 'bad', file: PATH, line: 2 }],
      }),
    );
    expect(marks()).toEqual(['two']);
    type(5, 't');
    expect(marks()).toEqual(['t two']);
  });

  it('leave out what a newer check of the text reports', () => {
    show(<CodeTab path={PATH} />);
    act(() => setTextFindings('errors', PATH, { text: TEXT, errors: [] }));
    act(() =>
      store().setChecked({
        actions: [],
        diagnostics: [{ code: 'BT0001', severity: 'error', message: 'bad', file: PATH, line: 2 }],
      }),
    );
    expect(marks()).toEqual([]);
  });

  it('show the findings of the language server, and the exceptions of a run', () => {
    show(<CodeTab path={PATH} />);
    const place = (character: number) => ({ line: 0, character });
    const finding = { from: place(0), to: place(3), severity: 'error', message: 'm', source: 's' } as const;
    act(() => useLanguageStore.setState({ findings: { [PATH]: [finding] } }));
    expect(marks()).toEqual(['one']);
    const fault = {
      kind: 'exception',
      message: 'boom',
      hint: '',
      node_id: '',
      tree_id: '',
      node_path: '',
      file: PATH,
      line: 3,
      traceback: '',
    } as const;
    act(() => useSessionStore.setState({ faults: [fault] }));
    expect(editor().dom.querySelector('.cm-faultLine')?.textContent).toBe('three');
  });

  it('show where a text is not JSON, shortly after it was typed', async () => {
    show(<CodeTab path="a.json" />);
    await waitFor(() => expect(marks()).toEqual(['}']));
  });
});
