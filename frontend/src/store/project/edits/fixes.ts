import { rewrite } from '@/model/document/rewrite';
import { isObject, type Json } from '@/model/document/values';
import { parsed } from '@/model/document/yaml';
import type { Fix, Making } from '@/model/fixes';
import { openBlock } from '@/store/problems/open';
import { withTexts } from '@/store/saving/large';
import { createAction } from './actionTemplate';
import { useProjectStore } from '../index';
import { actionPath, treePath } from '../state';

const store = () => useProjectStore.getState();

/** Takes a fix back; returns whether it did. It does not if the project or the file has changed since. */
export type TakeBack = () => boolean;

function takeBack(path: string, act: () => void): TakeBack {
  const { projectId, currentText } = store();
  const after = currentText(path);
  return () => {
    const isSame = store().projectId === projectId && store().currentText(path) === after;
    if (isSame) act();
    return isSame;
  };
}

/** Writes a file's text, which is loaded before if it is large. Returns null if nothing changes. */
async function rewritten(path: string, change: (text: string) => string): Promise<TakeBack | null> {
  const { projectId, files } = store();
  if (files[path]?.kind === 'large') await withTexts([path]);
  if (store().projectId !== projectId) return null;
  const before = store().currentText(path);
  if (before === null) return null;
  const after = change(before);
  if (after === before) return null;
  store().setFileText(path, after);
  return takeBack(path, () => store().setFileText(path, before));
}

/** The most lines of the call that names a topic. */
const CALL_LINES = 12;

/** Returns the lines from `first` to the end of the call that begins there, as a range of indexes. */
function callAt(lines: readonly string[], first: number): { readonly from: number; readonly to: number } {
  let open = 0;
  for (let to = first; to < Math.min(lines.length, first + CALL_LINES); to += 1) {
    for (const mark of lines[to]?.match(/[()]/g) ?? []) open += mark === '(' ? 1 : -1;
    if (open <= 0) return { from: first, to: to + 1 };
  }
  return { from: first, to: first + 1 };
}

/**
 * Replaces the name of a topic, in whichever quotes it stands: in the call at a line, else where the file has
 * it exactly once. A text that stands elsewhere, too, may be a port or a key.
 */
function replaced(source: string, { said, other, line }: Extract<Making, { makes: 'topic' }>): string {
  const literals = ['"', "'"].map(
    (quote) => [`${quote}${said}${quote}`, `${quote}${other}${quote}`] as const,
  );
  const inAll = (text: string) =>
    literals.reduce((changed, [from, to]) => changed.replaceAll(from, to), text);
  const lines = source.split('\n');
  if (line !== null) {
    const { from, to } = callAt(lines, line - 1);
    const call = lines.slice(from, to).join('\n');
    if (inAll(call) !== call) return [...lines.slice(0, from), inAll(call), ...lines.slice(to)].join('\n');
  }
  const count = literals.reduce((sum, [literal]) => sum + source.split(literal).length - 1, 0);
  return count === 1 ? inAll(source) : source;
}

function remapped(text: string, sensor: string, topic: string): string {
  const raw = parsed(text).document.toJS() as Json;
  const robots = isObject(raw) ? raw['robots'] : undefined;
  const first = Array.isArray(robots) ? (robots as Json[])[0] : undefined;
  const has = isObject(first) && isObject(first['topics']);
  const path = ['robots', 0, 'topics'];
  const op = has
    ? ({ kind: 'set', path: [...path, sensor], value: topic } as const)
    : ({ kind: 'set', path, value: { [sensor]: topic } } as const);
  return isObject(first) ? rewrite(text, [op]) : text;
}

async function make(making: Exclude<Making, { makes: 'typing' }>): Promise<TakeBack | null> {
  if (making.makes === 'topic') return rewritten(making.path, (text) => replaced(text, making));
  if (making.makes === 'remap')
    return rewritten(making.path, (text) => remapped(text, making.sensor, making.topic));
  const path = making.makes === 'action' ? actionPath(making.name) : treePath(making.name);
  if (making.makes === 'tree') store().addTree(making.name);
  else createAction(making.name, making.kind ?? 'Action', making.ports);
  return takeBack(path, () => {
    store().deleteFile(path);
    const { actions, diagnostics, setChecked } = store();
    if (making.makes === 'action') {
      setChecked({ diagnostics, actions: actions.filter((each) => each.name !== making.name) });
    }
  });
}

/**
 * Applies a fix. If the fix created or changed a file, returns a function that takes it back; changes of the
 * tree are undone as usual.
 *
 * @throws UnwritableError, if the file shares values by anchors; or it cannot be loaded.
 */
export async function applyFix(tree: string, { does }: Fix): Promise<TakeBack | null> {
  if (typeof does !== 'function' && does.makes === 'typing') {
    openBlock({ tree, node: does.node, port: does.port });
    return null;
  }
  if (typeof does !== 'function') return make(does);
  store().apply(tree, 'fix', [does]);
  return null;
}
