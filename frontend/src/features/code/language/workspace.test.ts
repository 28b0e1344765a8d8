import { EditorState } from '@codemirror/state';
import { EditorView } from '@codemirror/view';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useProjectStore } from '@/store/project';
import { connectedClient, type FakeLanguageServer } from '../../../../harness/languageServer';
import { watchTabs } from '../../../../harness/tabs';
import { openProject, watchNavigation } from '../../../../harness/testing';
import { sourceUriOf, uriOf } from './uris';
import { ProjectWorkspace } from './workspace';

const GO = 'actions/Go.py';
const TURN = 'actions/Turn.py';
const NODE = 'packages/rclpy/node.py';
const onElsewhere = vi.fn();
const store = () => useProjectStore.getState();

let client: Awaited<ReturnType<typeof connectedClient>>['client'];
let server: FakeLanguageServer;
let navigator: ReturnType<typeof watchNavigation>;

const paths = (method: string) =>
  server
    .sent(method)
    .map((params) =>
      (params as { textDocument: { uri: string } }).textDocument.uri.replace('file:///project/', ''),
    );

const changes = () => server.sent('textDocument/didChange');
/** Resolves when the server has received everything that was sent before. */
const answered = () => client.request('test/answer', {});

beforeEach(async () => {
  onElsewhere.mockClear();
  openProject({ texts: { [GO]: 'go = 1', [TURN]: 'turn = 1', 'notes.md': '' } });
  navigator = watchNavigation();
  ({ client, server } = await connectedClient({ workspace: (of) => new ProjectWorkspace(of, onElsewhere) }));
});

function editor(path: string): EditorView {
  const doc = store().currentText(path) ?? '';
  const view = new EditorView({
    state: EditorState.create({ doc, extensions: client.plugin(uriOf(path), 'python') }),
  });
  onTestFinished(() => view.destroy());
  return view;
}

describe('the files of the server', () => {
  it('are all Python files of the project', () => {
    expect(paths('textDocument/didOpen')).toEqual([GO, TURN]);
    expect(server.sent('textDocument/didOpen')[0]).toMatchObject({
      textDocument: { languageId: 'python', text: 'go = 1', version: 1 },
    });
  });

  it('follow what is typed without an editor', async () => {
    store().setFileText(TURN, 'turn = 2');
    client.sync();
    await expect
      .poll(changes)
      .toMatchObject([
        { textDocument: { uri: uriOf(TURN), version: 2 }, contentChanges: [{ text: 'turn = 2' }] },
      ]);
    client.sync();
    await answered();
    expect(changes()).toHaveLength(1);
  });

  it('follow what is typed in an editor', async () => {
    const view = editor(GO);
    view.dispatch({ changes: { from: 5, to: 6, insert: '3' } });
    client.sync();
    await expect.poll(changes).toMatchObject([{ textDocument: { uri: uriOf(GO), version: 2 } }]);
    client.sync();
    await answered();
    expect(changes()).toHaveLength(1);
  });

  it('are opened and closed with those of the project', async () => {
    store().addFile('actions/New.py', 'new = 1');
    store().deleteFile(TURN);
    client.sync();
    await expect.poll(() => paths('textDocument/didOpen')).toEqual([GO, TURN, 'actions/New.py']);
    await expect.poll(() => paths('textDocument/didClose')).toEqual([TURN]);
  });

  it('stay while an editor shows them', async () => {
    const view = editor(TURN);
    store().deleteFile(TURN);
    client.sync();
    await answered();
    expect(paths('textDocument/didClose')).toEqual([]);
    view.destroy();
    client.sync();
    await expect.poll(() => paths('textDocument/didClose')).toEqual([TURN]);
  });
});

describe('an edit of the server', () => {
  const edit = (path: string) =>
    client.workspace.updateFile(uriOf(path), { changes: { from: 0, insert: '# ' } });

  it('changes a file that no editor shows', () => {
    edit(TURN);
    expect(store().currentText(TURN)).toBe('# turn = 1');
  });

  it('changes an editor that shows the file', () => {
    const view = editor(GO);
    edit(GO);
    expect(view.state.doc.toString()).toBe('# go = 1');
    expect(store().currentText(GO)).toBe('go = 1');
  });
});

describe('a definition', () => {
  it('in an open file brings it to the front', async () => {
    const view = editor(GO);
    expect(await client.workspace.displayFile(uriOf(GO))).toBe(view);
    expect(navigator.openFile).toHaveBeenCalledWith(GO, undefined);
  });

  it('in another file opens it, and waits for its editor', async () => {
    const shown = client.workspace.displayFile(uriOf(TURN));
    expect(navigator.openFile).toHaveBeenCalledWith(TURN, undefined);
    const view = editor(TURN);
    expect(await shown).toBe(view);
  });

  it('in a deleted file opens nothing', async () => {
    expect(await client.workspace.displayFile(uriOf('actions/Gone.py'))).toBeNull();
    expect(navigator.openFile).not.toHaveBeenCalled();
  });

  it('outside of the project opens a tab to read, whose text the server knows while it is open', async () => {
    const tabs = watchTabs();
    const shown = client.workspace.displayFile(sourceUriOf(NODE));
    expect(tabs()).toEqual([{ kind: 'source', path: NODE }]);
    const view = new EditorView({
      state: EditorState.create({
        doc: 'class Node: ...',
        extensions: client.plugin(sourceUriOf(NODE), 'python'),
      }),
    });
    expect(await shown).toBe(view);
    await expect.poll(() => paths('textDocument/didOpen').at(-1)).toBe(sourceUriOf(NODE));
    view.destroy();
    client.sync();
    await expect.poll(() => paths('textDocument/didClose')).toEqual([sourceUriOf(NODE)]);
  });

  it('that cannot be opened is named', async () => {
    expect(await client.workspace.displayFile('file:///elsewhere/a.py')).toBeNull();
    expect(onElsewhere).toHaveBeenCalledExactlyOnceWith('file:///elsewhere/a.py');
  });
});
