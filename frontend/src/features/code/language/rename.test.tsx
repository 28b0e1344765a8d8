import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { connectedClient, type FakeLanguageServer } from '../../../../harness/languageServer';
import { fakeServer, openProject, show } from '../../../../harness/testing';
import { renameKeymap, renameSymbol } from './rename';
import { uriOf } from './uris';
import { ProjectWorkspace } from './workspace';

const GO = 'actions/Go.py';
const USER = 'actions/User.py';
const edit = (line: number, start: number, end: number, newText: string) => ({
  range: { start: { line, character: start }, end: { line, character: end } },
  newText,
});

const answers: Record<string, unknown> = {};
let server: FakeLanguageServer;
let view: EditorView;
const text = (path: string) => useProjectStore.getState().currentText(path);

beforeEach(async () => {
  for (const key of Object.keys(answers)) delete answers[key];
  fakeServer({});
  openProject({
    trees: { Main: { a: { type: 'Go' } } },
    texts: { [GO]: 'class Go:\n    pass\n', [USER]: 'from Go import Go\n' },
  });
  const connected = await connectedClient(
    { workspace: (of) => new ProjectWorkspace(of, () => undefined) },
    answers,
  );
  ({ server } = connected);
  const parent = document.body.appendChild(document.createElement('div'));
  view = new EditorView({
    parent,
    state: EditorState.create({
      doc: text(GO) ?? '',
      selection: { anchor: 7 },
      extensions: [
        connected.client.plugin(uriOf(GO), 'python'),
        EditorView.updateListener.of(({ state }) =>
          useProjectStore.getState().setFileText(GO, state.doc.toString()),
        ),
      ],
    }),
  });
  onTestFinished(() => {
    view.destroy();
    parent.remove();
  });
  show(<p />);
});

const field = () => view.dom.querySelector('input[name="name"]') as HTMLInputElement;
function rename(to: string): void {
  expect(renameSymbol(view)).toBe(true);
  field().value = to;
  fireEvent.submit(field().form as HTMLFormElement);
}

describe('renameSymbol', () => {
  it('has a key, and asks for the new name', () => {
    expect(renameKeymap).toMatchObject([{ key: 'F2', preventDefault: true }]);
    renameSymbol(view);
    expect(field()).toHaveValue('Go');
    expect(field()).toHaveAccessibleName('New name of Go');
  });

  it('renames in all files, and an action with its blocks', async () => {
    answers['textDocument/rename'] = {
      changes: {
        [uriOf(GO)]: [edit(0, 6, 8, 'Drive')],
        [uriOf(USER)]: [edit(0, 15, 17, 'Drive')],
        'file:///library/x.py': [],
      },
    };
    rename(' Drive ');
    expect(await screen.findByText('Renamed to Drive: 2 places in 3 files.')).toBeInTheDocument();
    expect(server.sent('textDocument/rename')).toEqual([
      { newName: 'Drive', position: { line: 0, character: 6 }, textDocument: { uri: uriOf(GO) } },
    ]);
    expect(text('actions/Drive.py')).toContain('class Drive:');
    expect(text(GO)).toBeNull();
    expect(useProjectStore.getState().diagrams['Main']?.nodes['a']?.type).toBe('Drive');
    expect(text(USER)).toContain('import Drive');
  });

  it('leaves the action unchanged if another name was renamed', async () => {
    answers['textDocument/rename'] = { changes: { [uriOf(GO)]: [edit(1, 4, 8, 'x')] } };
    rename('x');
    expect(await screen.findByText('Renamed to x: 1 places in 1 files.')).toBeInTheDocument();
    expect(text(GO)).toBe('class Go:\n    x\n');
  });

  it('refuses a name that is invalid in Python', async () => {
    rename('3D');
    expect(await screen.findByText('“3D” cannot be a name in Python.')).toBeInTheDocument();
    expect(server.sent('textDocument/rename')).toEqual([]);
  });

  it.each(['Go', ' ', ''])('requests nothing with the name “%s”', async (name) => {
    rename(name);
    await expect.poll(() => view.dom.querySelector('.cm-lsp-rename-panel')).toBeNull();
    expect(server.sent('textDocument/rename')).toEqual([]);
  });

  it('reports that something cannot be renamed', async () => {
    rename('Drive');
    expect(await screen.findByText('“Go” cannot be renamed here.')).toBeInTheDocument();
    expect(text(GO)).toContain('class Go:');
  });

  it('does nothing outside of words', () => {
    view.dispatch({ selection: { anchor: 10 } });
    expect(renameSymbol(view)).toBe(false);
    expect(field()).toBeNull();
  });

  it('does nothing without a language server', () => {
    const alone = new EditorView({ doc: 'Go', selection: { anchor: 1 } });
    expect(renameSymbol(alone)).toBe(false);
  });
});
