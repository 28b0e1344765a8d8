import { useProjectStore } from '@/store/project';
import type { DocumentTab } from './documents';

/** The longest wait for a document's editor, which may load over a slow connection. */
const PATIENCE_MS = 30_000;
/** The time within which a closing menu or palette returns the focus. */
const SETTLED_MS = 250;
const RETRY_MS = 20;

let pending = new AbortController();

function focusableOf(tab: DocumentTab): HTMLElement | null {
  if (tab.kind === 'compare' || tab.kind === 'past') return null;
  if (tab.kind === 'tree') {
    return document.querySelector(`[data-testid="canvas"][data-tree="${CSS.escape(tab.id)}"]`);
  }
  if (tab.kind === 'source') {
    return document.querySelector(
      `[data-testid="source-tab"][data-path="${CSS.escape(tab.path)}"] .cm-content`,
    );
  }
  const editor = document.querySelector(
    `[data-testid="universe-editor"][data-path="${CSS.escape(tab.path)}"]`,
  );
  if (editor) return editor.querySelector('[data-testid="universe-view"]');
  return document.querySelector(
    `[data-testid="code-editor"][data-path="${CSS.escape(tab.path)}"] .cm-content`,
  );
}

/** Moves the keyboard focus to the editor of an opened document, once it has loaded. */
export function focusDocument(tab: DocumentTab): void {
  pending.abort();
  const mine = new AbortController();
  pending = mine;
  abortOnceChosen(mine);
  const started = performance.now();
  let firstSeen: number | null = null;

  const attempt = () => {
    if (mine.signal.aborted) return;
    const now = performance.now();
    const target = focusableOf(tab);
    if (target?.checkVisibility() && !document.querySelector('[role="dialog"][aria-modal="true"]')) {
      firstSeen ??= now;
      // An element of the document that has the focus by now keeps it: a search, or a field of a screen reader.
      const panel = target.closest('[role="tabpanel"]') ?? target;
      if (!panel.contains(document.activeElement)) target.focus({ preventScroll: true });
    }
    if (now - (firstSeen ?? now) < SETTLED_MS && now - started < PATIENCE_MS) setTimeout(attempt, RETRY_MS);
    else mine.abort();
  };
  setTimeout(attempt);
}

/**
 * Aborts a request to move the focus when the user chooses a focus: by a press elsewhere, or Tab. Other keys
 * are taken as typed ahead.
 */
function abortOnceChosen(request: AbortController): void {
  const listen = { capture: true, signal: request.signal };
  window.addEventListener('pointerdown', () => request.abort(), listen);
  window.addEventListener('keydown', ({ key }) => key === 'Tab' && request.abort(), listen);
}

/** Cancels the wait for a document's editor, so that the next request gets the focus. */
export function letGoOfDocument(): void {
  pending.abort();
}

/** Identifies a selection: the tree, and its block if there is one. */
export const selectionKey = (tree: string | null, count: number, node: string | undefined): string =>
  `${tree ?? ''} ${count === 1 ? (node ?? '') : count}`;

/**
 * Moves the focus to a property of the selected block, once the inspector shows that block: to the field of a
 * port or script, or to the first one.
 */
export function focusInspector(port?: string): void {
  pending.abort();
  const mine = new AbortController();
  pending = mine;
  abortOnceChosen(mine);
  const started = performance.now();

  const attempt = () => {
    if (mine.signal.aborted) return;
    const { activeTree, selection } = useProjectStore.getState();
    const panel = document.querySelector<HTMLElement>('[data-testid="inspector"]');
    // The inspector renders after the canvas: until then it shows the selection before.
    if (panel?.dataset['selection'] === selectionKey(activeTree, selection.length, selection[0])) {
      mine.abort();
      focusField(panel, port);
    } else if (performance.now() - started < PATIENCE_MS) setTimeout(attempt, RETRY_MS);
    else mine.abort();
  };
  attempt();
}

function focusField(panel: HTMLElement, port: string | undefined): void {
  const name = CSS.escape(port ?? '');
  const asked = `[data-testid="port-${name}"], [data-testid="condition-${name}"]`;
  const field =
    (port === undefined ? null : panel.querySelector<HTMLElement>(asked)) ??
    panel.querySelector<HTMLElement>('[data-testid^="port-"]') ??
    panel.querySelector<HTMLElement>('input, textarea, select, button');
  const input = field?.matches('input, textarea, button, [contenteditable]')
    ? field
    : (field?.querySelector<HTMLElement>('input:checked') ?? field?.querySelector<HTMLElement>('input'));
  input?.focus();
  if (input instanceof HTMLInputElement) input.select();
}
