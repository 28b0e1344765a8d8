import type {
  ActionModel,
  ChangesResult,
  CheckResult,
  Diagnostic,
  FileChange,
  ProjectDetail,
  ProjectRole,
  ProjectSettings,
  RosDistro,
} from '@/api/types';
import type { Diagram, NodeId } from '@/model/diagram';
import type { Recipe } from '@/model/edits';
import type { UndoStack } from '@/model/undo';
import type { Vocabulary } from '@/model/vocabulary';

export interface FileEntry {
  readonly path: string;
  /**
   * A tree is stored in `diagrams`; it has a text here only while the text cannot be parsed. A large file is
   * one whose content the server left out: it is a text or binary, which is known when it is loaded.
   */
  readonly kind: 'tree' | 'text' | 'binary' | 'large';
  readonly text: string | null;
  /** The base revision of the next change; 0: the server does not have the file yet. */
  readonly revision: number;
  readonly savedText: string | null;
}

export interface ProjectData {
  readonly projectId: string | null;
  /** The user's role; edits of a viewer are refused and counted in `refusedEdits`. */
  readonly role: ProjectRole;
  readonly refusedEdits: number;
  readonly name: string;
  readonly description: string;
  readonly settings: ProjectSettings | null;
  readonly mainTree: string;
  readonly revision: number;
  readonly files: Readonly<Record<string, FileEntry>>;
  /** The revisions of files, by path, that are deleted here but not yet on the server. */
  readonly removed: Readonly<Record<string, number>>;
  readonly diagrams: Readonly<Record<string, Diagram>>;
  readonly actions: readonly ActionModel[];
  readonly diagnostics: readonly Diagnostic[];
  /** The ROS distribution of the project as the server last found it. */
  readonly rosDistro: RosDistro | null;
  readonly vocabulary: Vocabulary;
  readonly histories: Readonly<Record<string, UndoStack>>;
  readonly activeTree: string | null;
  /** The selected blocks of the active tree, in order of selection. */
  readonly selection: readonly NodeId[];
  /** A request to the canvas of a tree to scroll to a node; the counter makes each request new. */
  readonly revealed: { readonly tree: string; readonly node: NodeId; readonly count: number } | null;
  /** Increases with each edit that must be saved. */
  readonly changeCounter: number;
}

export interface EditOptions {
  /** Consecutive edits with the same key are one undo step. */
  readonly mergeKey?: string;
  /** The selection after the edit. */
  readonly select?: readonly NodeId[];
  /** Other trees that change in the same step; null deletes one. */
  readonly also?: Readonly<Record<string, Diagram | null>>;
  /** Texts of files by path that the same step writes: new and replaced ones, other trees among them; null removes one. */
  readonly files?: Readonly<Record<string, string | null>>;
}

/** The findings about a project in an answer of the server. */
export type Answer = Pick<CheckResult, 'checked' | 'ros_distro'> & {
  readonly diagnostics: readonly Diagnostic[];
  readonly actions: readonly ActionModel[];
};

export interface ProjectActions {
  load(detail: ProjectDetail): void;
  close(): void;
  setActiveTree(id: string | null): void;
  select(treeId: string, ids: readonly NodeId[]): void;
  reveal(treeId: string, node: NodeId): void;
  /** Changes a tree by recipes, as one step on its undo stack; `label` is an i18n key of `canvas:edit`. */
  apply(treeId: string, label: string, recipes: readonly Recipe[], options?: EditOptions): void;
  /** Ends a gesture: the next edit is a step of its own. */
  seal(treeId?: string): void;
  /** Undoes the last step of a tree, or of the active one. */
  undo(tree?: string): void;
  redo(): void;
  addTree(id: string): void;
  renameTree(from: string, to: string): void;
  deleteTree(id: string): void;
  /** Renames an action: its file, its class, and every use. */
  renameAction(from: string, to: string): void;
  setFileText(path: string, text: string): void;
  addFile(path: string, text: string): void;
  deleteFile(path: string): void;
  setSettings(patch: Partial<ProjectSettings>): void;
  setChecked(checked: Answer): void;
  /** Returns the changes to send to the server, each file with its base revision. */
  pendingChanges(): FileChange[];
  applySaved(sent: readonly FileChange[], result: ChangesResult): void;
  /** Sets the base of a file after a conflict, null for an unknown text; the user's text stays. */
  rebase(path: string, revision: number, savedText: string | null): void;
  /** Returns the text of a file as it would be saved; null if it is binary or unknown. */
  currentText(path: string): string | null;
}

export type ProjectState = ProjectData & ProjectActions;

export const treePath = (id: string): string => `trees/${id}.json`;
export const actionPath = (name: string): string => `actions/${name}.py`;

export function treeIdOf(path: string): string | null {
  return /^trees\/([^/]+)\.json$/.exec(path)?.[1] ?? null;
}
