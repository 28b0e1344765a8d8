import { LSPPlugin, Workspace, type LSPClient } from '@codemirror/lsp-client';
import { ChangeSet, Text, type TransactionSpec } from '@codemirror/state';
import type { EditorView } from '@codemirror/view';
import { useProjectStore } from '@/store/project';
import { openFile } from '@/store/project/navigation';
import { openTab } from '@/workspace/tabs';
import { pathOf, sourceOf, uriOf } from './uris';

type WorkspaceFile = Workspace['files'][number];
type Update = ReturnType<Workspace['syncFiles']>[number];

/** The number of files whose unsaved text is sent; the server reads any others as they were saved. */
const MAX_FILES = 200;

class ProjectFile implements WorkspaceFile {
  readonly languageId = 'python';
  readonly views: EditorView[] = [];

  constructor(
    readonly uri: string,
    /** The path in the project; null for a source outside of it. */
    readonly path: string | null,
    public version: number,
    public doc: Text,
  ) {}

  getView(main?: EditorView): EditorView | null {
    return main && this.views.includes(main) ? main : (this.views[0] ?? null);
  }
}

function textOf(path: string | null): Text | null {
  const text = path === null ? null : useProjectStore.getState().currentText(path);
  return text === null ? null : Text.of(text.split('\n'));
}

const pythonFiles = (): string[] =>
  Object.keys(useProjectStore.getState().files)
    .filter((path) => path.endsWith('.py'))
    .slice(0, MAX_FILES);

/**
 * All Python files of the project, whether or not an editor shows them: the server knows the unsaved text of
 * each, and a rename reaches all of them.
 */
export class ProjectWorkspace extends Workspace {
  files: ProjectFile[] = [];
  private readonly versions = new Map<string, number>();
  private readonly waiting = new Map<string, (view: EditorView) => void>();

  constructor(
    client: LSPClient,
    /** Called with the address of a file that cannot be opened. */
    private readonly onElsewhere: (uri: string) => void,
  ) {
    super(client);
  }

  override syncFiles(): readonly Update[] {
    this.reconcile();
    return this.files.flatMap((file) => this.changesOf(file));
  }

  override openFile(uri: string, _language: string, view: EditorView): void {
    const file = this.fileAt(uri) ?? this.add(uri, view.state.doc);
    file.views.push(view);
    const { doc } = view.state;
    if (!doc.eq(file.doc)) this.replace(file, doc);
    this.waiting.get(uri)?.(view);
    this.waiting.delete(uri);
  }

  override closeFile(uri: string, view: EditorView): void {
    const file = this.fileAt(uri);
    const at = file?.views.indexOf(view) ?? -1;
    if (at >= 0) file?.views.splice(at, 1);
  }

  override connected(): void {
    this.reconcile();
    for (const file of this.files) {
      // An editor may have text that was typed while the server was not running.
      file.doc = file.getView()?.state.doc ?? textOf(file.path) ?? file.doc;
      const view = file.getView();
      if (view) LSPPlugin.get(view)?.clear();
      this.client.didOpen(file);
    }
  }

  override updateFile(uri: string, update: TransactionSpec): void {
    const file = this.fileAt(uri);
    const view = file?.getView();
    if (view) view.dispatch(update);
    else if (file && file.path !== null && update.changes) {
      const changed = ChangeSet.of(update.changes, file.doc.length).apply(file.doc);
      useProjectStore.getState().setFileText(file.path, changed.toString());
    }
  }

  override displayFile(uri: string): Promise<EditorView | null> {
    if (!this.open(uri)) return Promise.resolve(null);
    const view = this.fileAt(uri)?.getView();
    if (view) return Promise.resolve(view);
    return new Promise((resolve) => this.waiting.set(uri, resolve));
  }

  /** Opens the tab of a file; returns whether there is such a file. */
  private open(uri: string): boolean {
    const [path, source] = [pathOf(uri), sourceOf(uri)];
    if (source !== null) openTab({ kind: 'source', path: source });
    else if (path === null) this.onElsewhere(uri);
    else if (textOf(path) !== null) openFile(path);
    return source !== null || textOf(path) !== null;
  }

  private fileAt(uri: string): ProjectFile | undefined {
    return this.files.find((file) => file.uri === uri);
  }

  private add(uri: string, doc: Text): ProjectFile {
    const file = new ProjectFile(uri, pathOf(uri), this.nextVersion(uri), doc);
    this.files.push(file);
    if (this.client.serverCapabilities) this.client.didOpen(file);
    return file;
  }

  /** Adds new files, and removes files that were renamed or deleted since the last call. */
  private reconcile(): void {
    const paths = new Set(pythonFiles());
    for (const path of paths) {
      const doc = this.files.some((file) => file.path === path) ? null : textOf(path);
      if (doc) this.add(uriOf(path), doc);
    }
    const gone = this.files.filter(({ path, views }) => !paths.has(path ?? '') && views.length === 0);
    this.files = this.files.filter((file) => !gone.includes(file));
    if (this.client.serverCapabilities) for (const file of gone) this.client.didClose(file.uri);
  }

  private changesOf(file: ProjectFile): Update[] {
    const prevDoc = file.doc;
    const view = file.getView();
    const plugin = view && LSPPlugin.get(view);
    if (view && plugin) {
      const changes = plugin.unsyncedChanges;
      if (changes.empty) return [];
      file.doc = view.state.doc;
      file.version = this.nextVersion(file.uri);
      plugin.clear();
      return [{ file, prevDoc, changes }];
    }
    const doc = textOf(file.path);
    if (!doc || doc.eq(prevDoc)) return [];
    file.doc = doc;
    file.version = this.nextVersion(file.uri);
    return [{ file, prevDoc, changes: wholeChange(prevDoc, doc) }];
  }

  private replace(file: ProjectFile, doc: Text): void {
    file.doc = doc;
    file.version = this.nextVersion(file.uri);
    if (!this.client.serverCapabilities) return;
    this.client.notification('textDocument/didChange', {
      textDocument: { uri: file.uri, version: file.version },
      contentChanges: [{ text: doc.toString() }],
    });
  }

  private nextVersion(uri: string): number {
    const version = (this.versions.get(uri) ?? 0) + 1;
    this.versions.set(uri, version);
    return version;
  }
}

const wholeChange = (before: Text, after: Text): ChangeSet =>
  ChangeSet.of({ from: 0, to: before.length, insert: after }, before.length);
