import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { connectedClient, type FakeLanguageServer } from '../../../../harness/languageServer';
import { fakeServer, openProject, show } from '../../../../harness/testing';
import { leaveRename, rename, renameKeymap, renameSymbol, useRename, type RenameRequest } from './rename';
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
  useRename.setState({ request: null });
  show(<p />);
});

const request = () => useRename.getState().request;
const both = (name: string) => ({
  changes: { [uriOf(GO)]: [edit(0, 6, 8, name)], [uriOf(USER)]: [edit(0, 15, 17, name)] },
});

/** Asks for a rename at the cursor; returns it with its places. */
async function asked(): Promise<RenameRequest> {
  expect(renameSymbol(view)).toBe(true);
  await expect.poll(() => request()?.groups).toBeTruthy();
  return request() as RenameRequest;
}

describe('renameSymbol', () => {
  it('has a key, and finds what changes before it asks for the name', async () => {
    answers['textDocument/rename'] = both('Go_');
    expect(renameKeymap).toMatchObject([{ key: 'F2', preventDefault: true }]);
    const { before, groups } = await asked();
    expect(before).toBe('Go');
    expect(groups?.map(({ name, places }) => [name, places.map(({ text }) => text)])).toEqual([
      [GO, ['class Go:']],
      [USER, ['from Go import Go']],
    ]);
    expect(text(GO)).toContain('class Go:');
    leaveRename();
    expect(request()).toBeNull();
    expect(view.hasFocus).toBe(true);
  });

  it('says that something cannot be renamed, and asks for nothing', async () => {
    renameSymbol(view);
    expect(await screen.findByText('“Go” cannot be renamed here.')).toBeInTheDocument();
    expect(request()).toBeNull();
  });

  it('renames nothing that is defined outside of the project', async () => {
    answers['textDocument/rename'] = {
      changes: { ...both('x').changes, 'file:///library/packages/x.py': [edit(0, 0, 1, 'x')] },
    };
    renameSymbol(view);
    expect(await screen.findByText('“Go” cannot be renamed here.')).toBeInTheDocument();
    expect(text(USER)).toBe('from Go import Go\n');
  });

  it('does nothing beside words', () => {
    view.dispatch({ selection: { anchor: 10 } });
    expect(renameSymbol(view)).toBe(false);
    expect(request()).toBeNull();
  });

  it('does nothing without a language server', () => {
    const alone = new EditorView({ doc: 'Go', selection: { anchor: 1 } });
    expect(renameSymbol(alone)).toBe(false);
  });
});

describe('rename', () => {
  it('renames in all files, and an action with its blocks', async () => {
    answers['textDocument/rename'] = both('Drive');
    await rename(await asked(), 'Drive');
    expect(await screen.findByText('Renamed to Drive: 2 places in 2 files.')).toBeInTheDocument();
    expect(server.sent('textDocument/rename').at(-1)).toEqual({
      newName: 'Drive',
      position: { line: 0, character: 6 },
      textDocument: { uri: uriOf(GO) },
    });
    expect(text('actions/Drive.py')).toContain('class Drive:');
    expect(text(GO)).toBeNull();
    expect(useProjectStore.getState().diagrams['Main']?.nodes['a']?.type).toBe('Drive');
    expect(text(USER)).toContain('import Drive');
  });

  it('leaves the action unchanged if another name was renamed', async () => {
    answers['textDocument/rename'] = { changes: { [uriOf(GO)]: [edit(1, 4, 8, 'x')] } };
    await rename(await asked(), 'x');
    expect(await screen.findByText('Renamed to x: 1 place in 1 file.')).toBeInTheDocument();
    expect(text(GO)).toBe('class Go:\n    x\n');
  });
});
