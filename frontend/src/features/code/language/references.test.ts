import { EditorState } from '@codemirror/state';
import { EditorView, runScopeHandlers } from '@codemirror/view';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { connectedClient } from '../../../../harness/languageServer';
import { openProject } from '../../../../harness/testing';
import { basics } from '../basics';
import { closeReferences, findReferences, referencesKeys, useReferences } from './references';
import { uriOf } from './uris';
import { ProjectWorkspace } from './workspace';

const GO = 'actions/Go.py';
const found = () => useReferences.getState().found;

beforeEach(() => {
  openProject({ texts: { [GO]: 'class Go:\n    pass\n' } });
  onTestFinished(closeReferences);
});

async function editor(answer: unknown) {
  const { client, server } = await connectedClient(
    { workspace: (of) => new ProjectWorkspace(of, () => undefined) },
    { 'textDocument/references': answer },
  );
  const extensions = [basics('Go.py'), client.plugin(uriOf(GO), 'python'), referencesKeys];
  const view = new EditorView({
    state: EditorState.create({ doc: 'class Go:\n    pass\n', selection: { anchor: 7 }, extensions }),
  });
  onTestFinished(() => view.destroy());
  return { view, server };
}

describe('findReferences', () => {
  it('lists where the name at the cursor is used, and Esc closes the list', async () => {
    const range = { start: { line: 0, character: 6 }, end: { line: 0, character: 8 } };
    const { view, server } = await editor([{ uri: uriOf(GO), range }]);
    expect(findReferences(view)).toBe(true);
    await expect.poll(found).toMatchObject({ name: 'Go', groups: [{ name: GO, places: [{ line: 0 }] }] });
    expect(server.sent('textDocument/references')).toMatchObject([
      { textDocument: { uri: uriOf(GO) }, context: { includeDeclaration: true } },
    ]);
    view.dispatch({ selection: { anchor: 6, head: 8 } });
    const press = () => runScopeHandlers(view, new KeyboardEvent('keydown', { key: 'Escape' }), 'editor');
    expect(press()).toBe(true);
    expect(found()).toBeNull();
    expect(view.state.selection.main.empty).toBe(false);
    expect(press()).toBe(true);
    expect(view.state.selection.main.empty).toBe(true);
    expect(press()).toBe(false);
  });

  it('says of a name that nobody uses that there is none, and each search is new', async () => {
    const { view } = await editor(null);
    findReferences(view);
    await expect.poll(found).toMatchObject({ groups: [] });
    const before = found()?.request ?? 0;
    findReferences(view);
    await expect.poll(() => found()?.request).toBe(before + 1);
  });

  it('does nothing beside words and without a server', async () => {
    const { view } = await editor(null);
    view.dispatch({ selection: { anchor: 10 } });
    expect(findReferences(view)).toBe(false);
    expect(findReferences(new EditorView({ doc: 'Go' }))).toBe(false);
  });
});
