import { readCopied, writeCopied, type Copied } from '@/model/copied';
import { freshId, type DiagramNode } from '@/model/diagram';
import { fragmentOf, insertFragment, withFreshIds, type Fragment } from '@/model/edits';
import { closureOf, nameIn, pathOf, type Insertion } from '@/model/reuse';
import { acceptsChild, bestPlacement, type Placement } from '@/model/rules';
import { bring } from '@/store/dialogs/arrivals';
import { withAllPython } from '@/store/saving/large';
import { activeDiagram, change, deleteSelection, placeAfter } from './blocks';
import { useProjectStore } from '../index';
import { treeIdOf } from '../state';

/** The last copied text, for browsers that do not allow reading the clipboard. */
let remembered = '';

/** The number of texts that were copied or cut: a text that comes late must not replace a later one. */
let copied = 0;

/** Returns the trees and actions of the project that blocks use, by path. */
function filesOf(fragment: Fragment): Record<string, string> {
  const { files, diagrams, currentText } = useProjectStore.getState();
  const sources: Record<string, string> = {};
  for (const path of Object.keys(files)) {
    const tree = treeIdOf(path);
    // A tree that cannot be read is not copied.
    if (tree === null ? !/^actions\/[^/]+\.py$/.test(path) : !(tree in diagrams)) continue;
    const text = currentText(path);
    if (text !== null) sources[path] = text;
  }
  return closureOf(Object.values(fragment.nodes).map(pathOf), sources);
}

/** Returns blocks as text, with the files that they use, as far as these are loaded. */
export function textOf(fragment: Fragment): string {
  const { projectId, name } = useProjectStore.getState();
  copied += 1;
  remembered = writeCopied(fragment, { project: projectId ?? '', name, files: filesOf(fragment) });
  return remembered;
}

/** Returns the selected blocks; null if there are none. */
export function selectedBlocks(): Fragment | null {
  const diagram = activeDiagram();
  const { selection } = useProjectStore.getState();
  if (!diagram || selection.length === 0) return null;
  return fragmentOf(diagram, selection);
}

async function toClipboard(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // The browser refused. Pasting in this tab uses the remembered text.
  }
}

/** Notes that the user has copied something other than blocks. */
export function noteCopy(): void {
  copied += 1;
}

/**
 * Copies blocks with the files that they use; large ones are loaded before, as far as this is possible. If the
 * user copies something else meanwhile, that stays.
 */
export async function copyBlocks(blocks: Fragment): Promise<void> {
  const number = (copied += 1);
  await withAllPython().catch(() => undefined);
  if (number === copied) await toClipboard(textOf(blocks));
}

export async function copySelection(): Promise<boolean> {
  const blocks = selectedBlocks();
  if (blocks) await copyBlocks(blocks);
  return blocks !== null;
}

/**
 * Copies a tree as a block that calls it; pasted into another project, the block brings all that the tree
 * uses.
 */
export function copyTree(tree: string): Promise<void> {
  return copyBlocks({ tops: ['tree'], nodes: { tree: { type: 'SubTree', tree } } });
}

export async function cutSelection(): Promise<void> {
  if (await copySelection()) deleteSelection();
}

/** Returns the content of the clipboard. A menu needs this function, since it gets no paste event. */
export async function clipboardText(): Promise<string> {
  try {
    return await navigator.clipboard.readText();
  } catch {
    return remembered;
  }
}

/** Returns the blocks with the names that their trees and actions have in this project. */
function withPlaces(fragment: Fragment, places: Insertion['places']): Fragment {
  const renamed = (node: DiagramNode): DiagramNode => {
    const place = places[pathOf(node)];
    if (place === undefined) return node;
    return node.type === 'SubTree' ? { ...node, tree: nameIn(place) } : { ...node, type: nameIn(place) };
  };
  const nodes = Object.entries(fragment.nodes).map(([id, node]) => [id, renamed(node)] as const);
  return { ...fragment, nodes: Object.fromEntries(nodes) };
}

/** Pastes under the selected block if it accepts children, else after it, else as a draft. */
function paste(fragment: Fragment, files?: Insertion['files']): void {
  const diagram = activeDiagram();
  if (!diagram) return;
  const { vocabulary, selection } = useProjectStore.getState();
  const [id] = selection;
  const copy = withFreshIds(fragment, (taken) => freshId({ ...diagram.nodes, ...taken }));
  let place: Placement;
  if (id !== undefined && acceptsChild(diagram, id, vocabulary)) {
    place = { at: 'child', parent: id, index: diagram.nodes[id]?.children?.length ?? 0 };
  } else {
    place = id === undefined ? bestPlacement(diagram, undefined, vocabulary) : placeAfter(diagram, id);
  }
  if (place.at === 'child' && copy.tops.length > 1) {
    const spec = vocabulary.specs.get(diagram.nodes[place.parent]?.type ?? '');
    const room = (spec?.maxChildren ?? 0) - (diagram.nodes[place.parent]?.children?.length ?? 0);
    if (copy.tops.length > room) place = { at: 'draft' };
  }
  change('paste', [insertFragment(copy, place)], { select: copy.tops, ...(files ? { files } : {}) });
}

/** Returns whether the blocks come with files from another project that this user may add to. */
function isDelivery({ origin }: Copied): boolean {
  const { projectId, role } = useProjectStore.getState();
  return origin !== null && origin.project !== projectId && role !== 'viewer';
}

/**
 * Pastes blocks. Blocks from another project bring the trees and actions that they use, after the user has
 * reviewed them. Returns the kind of the text: blocks, blocks whose files cannot be read, or nothing that can
 * be pasted.
 */
export function pasteText(text: string): 'blocks' | 'damaged' | 'nothing' {
  const copied = readCopied(text);
  if (!copied || !activeDiagram()) return 'nothing';
  const { fragment, origin, isDamaged } = copied;
  if (origin === null || !isDelivery(copied)) {
    paste(fragment);
    return isDamaged ? 'damaged' : 'blocks';
  }
  bring({
    act: 'paste',
    name: origin.name,
    needs: [...new Set(Object.values(fragment.nodes).map(pathOf))].filter((path) => path in origin.files),
    sources: origin.files,
    take: ({ places, files }) => paste(withPlaces(fragment, places), files),
  });
  return 'blocks';
}
