import { Actions, DockLocation, Model, TabNode, TabSetNode, type IJsonTabNode } from 'flexlayout-react';
import { create } from 'zustand';
import { nameIn } from '@/model/document/glance';
import { useProjectStore } from '@/store/project';
import { documentName, kindOf } from '@/store/project/moving';
import type { DocumentTab } from './documents';
import { focusDocument } from './focus';
import { EDITORS, openMissing, toggleBeside, type FrameWidth, type PanelId } from './layoutModel';

/** A line to which an editor moves its cursor; `request` distinguishes two requests for the same line. */
export interface LineTarget {
  path: string;
  line: number;
  request: number;
}

interface TabsData {
  model: Model | null;
  /** The class of window widths that the layout is for. */
  width: FrameWidth | null;
  target: LineTarget | null;
  /** The document that was in front most recently. */
  front: DocumentTab | null;
  /** The number of renames so far. The docking library does not notify a tab's content of a rename. */
  renames: number;
  /** The panels that are in windows of their own. */
  inWindows: readonly string[];
}

export const useTabs = create<TabsData>(() => ({
  model: null,
  width: null,
  target: null,
  front: null,
  renames: 0,
  inWindows: [],
}));

const MAIN_LAYOUT = Model.MAIN_LAYOUT_ID;

let requests = 0;

/** Returns whether there is only one tab of this kind. */
const isAlone = (tab: DocumentTab): tab is Extract<DocumentTab, { kind: 'compare' | 'past' }> =>
  tab.kind === 'compare' || tab.kind === 'past';

function tabId(tab: DocumentTab): string {
  if (isAlone(tab)) return tab.kind;
  return tab.kind === 'tree' ? `tree:${tab.id}` : `${tab.kind}:${tab.path}`;
}

function nameOf(tab: DocumentTab): string {
  // The frame translates this name, like those of its panels.
  if (isAlone(tab)) return `panel.${tab.kind}`;
  if (tab.kind === 'tree') return tab.id;
  if (!isNamed(tab)) return tab.path.split('/').at(-1) ?? tab.path;
  return nameIn(useProjectStore.getState().currentText(tab.path) ?? '') ?? documentName(tab.path);
}

/** Returns whether the document contains its own name, as universes and robots do. */
const isNamed = (tab: DocumentTab): boolean =>
  tab.kind === 'file' && ['universe', 'robot'].includes(kindOf(tab.path));

/**
 * Returns the folder of a file (the id of a universe or robot) if another open tab has the same name; null if
 * the name is unique.
 */
export function folderOf(tab: DocumentTab, open: readonly DocumentTab[]): string | null {
  if (tab.kind !== 'file' && tab.kind !== 'source') return null;
  const name = nameOf(tab);
  const isUnique = open.every((other) => tabId(other) === tabId(tab) || nameOf(other) !== name);
  if (!isUnique && isNamed(tab)) return documentName(tab.path);
  return isUnique ? null : tab.path.split('/').slice(0, -1).join('/') || '/';
}

/** Returns the icon and name of a document's tab. */
function faceOf(tab: DocumentTab): Pick<IJsonTabNode, 'name' | 'config' | 'helpText'> {
  const name = nameOf(tab);
  const helpText = isAlone(tab) ? '' : tab.kind === 'tree' ? name : tab.path;
  return { name, config: { document: true, tab }, helpText };
}

export const documentOf = (node: TabNode): DocumentTab | undefined =>
  (node.getConfig() as { tab?: DocumentTab } | undefined)?.tab;

/** Returns the tab of a document, even if it was opened under an earlier name. */
function nodeOf(model: Model | null, tab: DocumentTab): TabNode | null {
  let found: TabNode | null = null;
  model?.visitNodes((node) => {
    const shown = node instanceof TabNode ? documentOf(node) : undefined;
    if (shown && tabId(shown) === tabId(tab)) found = node as TabNode;
  });
  return found;
}

/** Opens a document, or brings its tab to the front, and moves the focus to it. */
export function openTab(tab: DocumentTab, line?: number): void {
  if (!bringToFront(tab)) return;
  if (tab.kind === 'file' && line) aimAt(tab.path, line);
  focusDocument(tab);
}

/** Opens a document, or brings its tab to the front; returns whether there is a place for it. */
export function bringToFront(tab: DocumentTab): boolean {
  const { model } = useTabs.getState();
  if (!model) return false;
  const open = nodeOf(model, tab);
  if (open) model.doAction(Actions.selectTab(open.getId()));
  else {
    const json: IJsonTabNode = { type: 'tab', component: tab.kind, ...faceOf(tab) };
    model.doAction(Actions.addTab(json, EDITORS, DockLocation.CENTER, -1, true));
  }
  uncover(model, nodeOf(model, tab));
  return true;
}

/** Ends the maximized state of another set of tabs, which would cover what is brought to the front. */
function uncover(model: Model, node: TabNode | null): void {
  const covering = model.getMaximizedTabset();
  if (node?.getLayoutId() !== MAIN_LAYOUT || !covering || covering === node.getParent()) return;
  model.doAction(Actions.maximizeToggle(covering.getId()));
}

/** Brings a tree to the front if a tree is there already; returns whether it is in front now. */
export function showTree(id: string): boolean {
  const { model } = useTabs.getState();
  const front = model && frontDocument(model);
  if (front?.kind !== 'tree') return false;
  return front.id === id || bringToFront({ kind: 'tree', id });
}

/** Moves the cursor of the editor that shows a file to a line. */
export function aimAt(path: string, line: number): void {
  requests += 1;
  useTabs.setState({ target: { path, line, request: requests } });
}

export function closeTab(tab: DocumentTab): void {
  const { model } = useTabs.getState();
  const open = nodeOf(model, tab);
  if (open) model?.doAction(Actions.deleteTab(open.getId()));
}

const PAST: DocumentTab = { kind: 'past' };

/**
 * Opens the tab of the tree as it ran: in front of a tree, and behind any other document unless the user asked
 * for a run. The focus stays.
 */
export function openPast(isAsked = false): void {
  const { model, front } = useTabs.getState();
  if (!model || nodeOf(model, PAST)) return;
  const json: IJsonTabNode = { type: 'tab', component: 'past', className: 'bts-past', ...faceOf(PAST) };
  const isSelected = isAsked || front === null || front.kind === 'tree';
  model.doAction(Actions.addTab(json, EDITORS, DockLocation.CENTER, -1, isSelected));
  if (isAsked) uncover(model, nodeOf(model, PAST));
}

/** Closes the tab of the tree as it ran; the document that it covered comes to the front. */
export function closePast(): void {
  const { model, front } = useTabs.getState();
  const wasVisible = nodeOf(model, PAST)?.isVisible() ?? false;
  closeTab(PAST);
  const node = front && wasVisible ? nodeOf(model, front) : null;
  if (node) model?.doAction(Actions.selectTab(node.getId()));
}

/** Renames a document's tab in place. */
export function followRename(from: DocumentTab, to: DocumentTab): void {
  const { model } = useTabs.getState();
  const open = nodeOf(model, from);
  if (!open || nodeOf(model, to)) return;
  model?.doAction(Actions.updateNodeAttributes(open.getId(), faceOf(to)));
  useTabs.setState(({ renames }) => ({ renames: renames + 1 }));
}

/** Renames the tabs of universes and robots to the names in their documents. */
export function followNames(): void {
  const { model } = useTabs.getState();
  let isNew = false;
  model?.visitNodes((node) => {
    const tab = node instanceof TabNode ? documentOf(node) : undefined;
    if (!tab || !isNamed(tab) || !exists(tab)) return;
    const name = nameOf(tab);
    if ((node as TabNode).getName() === name) return;
    model.doAction(Actions.updateNodeAttributes(node.getId(), { name }));
    isNew = true;
  });
  if (isNew) useTabs.setState(({ renames }) => ({ renames: renames + 1 }));
}

function exists(tab: DocumentTab): boolean {
  const { files, diagrams } = useProjectStore.getState();
  if (tab.kind === 'source') return true;
  return tab.kind === 'tree' ? tab.id in diagrams : tab.kind === 'file' && tab.path in files;
}

/**
 * Closes the tabs of trees that no longer exist, after an undo or a rename. A text editor reports a missing
 * file itself.
 */
export function closeGone(): void {
  const { model } = useTabs.getState();
  for (const tab of model ? openDocuments(model) : []) {
    if (tab.kind === 'tree' && !exists(tab)) closeTab(tab);
  }
}

/** Brings a panel to the front; one that the basic layout lacks is opened. */
export function showPanel(panel: PanelId): void {
  const { model } = useTabs.getState();
  if (model && !model.getNodeById(panel)) openMissing(model, panel);
  const node = model?.getNodeById(panel);
  if (!model || !(node instanceof TabNode)) return;
  if (!node.isVisible()) model.doAction(Actions.selectTab(panel));
  uncover(model, node);
}

/** Opens or closes a panel beside the documents. */
export function togglePanel(panel: PanelId): void {
  const { model, width } = useTabs.getState();
  if (model && width) toggleBeside(model, width, panel);
}

/** Records which panels are in windows of their own. */
export function followWindows(model: Model): void {
  const found: string[] = [];
  model.visitNodes((node) => {
    const isOut = node instanceof TabNode && node.getLayoutId() !== MAIN_LAYOUT;
    if (isOut) found.push(node.getId());
  });
  if (found.join() !== useTabs.getState().inWindows.join()) useTabs.setState({ inWindows: found });
}

export function openDocuments(model: Model): DocumentTab[] {
  const found: DocumentTab[] = [];
  model.visitNodes((node) => {
    const tab = node instanceof TabNode ? documentOf(node) : undefined;
    if (tab) found.push(tab);
  });
  return found;
}

/** Returns the document in front: that of the active tab set, otherwise that of the editors. */
export function frontDocument(model: Model): DocumentTab | null {
  const active = model.getActiveTabset();
  for (const tabset of [active, model.getNodeById(EDITORS)]) {
    const selected = tabset instanceof TabSetNode ? tabset.getSelectedNode() : undefined;
    const tab = selected instanceof TabNode ? documentOf(selected) : undefined;
    if (tab) return tab;
  }
  return null;
}

const isSame = (a: DocumentTab, b: DocumentTab | null) => b !== null && tabId(a) === tabId(b);

/** Returns whether a tab shows the document in front. */
export function isInFront(node: TabNode): boolean {
  const tab = documentOf(node);
  return tab !== undefined && isSame(tab, useTabs.getState().front);
}

/** Makes the tree in front the active one for canvas, inspector and undo. */
export function followFront(model: Model): void {
  const front = frontDocument(model);
  if (front && !isAlone(front) && !isSame(front, useTabs.getState().front)) useTabs.setState({ front });
  const { activeTree, setActiveTree } = useProjectStore.getState();
  if (front?.kind === 'tree' && front.id !== activeTree) setActiveTree(front.id);
}

const openKey = (projectId: string) => `bts.open.${projectId}`;

export function keepOpen(projectId: string, model: Model): void {
  const front = frontDocument(model);
  localStorage.setItem(openKey(projectId), JSON.stringify({ tabs: openDocuments(model), front }));
}

/** Opens the documents of the last visit to this project; its main tree is always among them. */
export function reopen(projectId: string, mainTree: string): void {
  let kept: { tabs?: DocumentTab[]; front?: DocumentTab | null } = {};
  try {
    kept = JSON.parse(localStorage.getItem(openKey(projectId)) ?? '{}') as typeof kept;
  } catch {
    // Unreadable stored tabs count as none.
  }
  const tabs = (kept.tabs ?? []).filter(exists);
  for (const tab of tabs) openTab(tab);
  const front = kept.front && exists(kept.front) ? kept.front : null;
  if (front) openTab(front);
  else if (tabs.length === 0) openTab({ kind: 'tree', id: mainTree });
}
