import { freshId } from '@/model/diagram';
import { fragmentOf, insertFragment, withFreshIds } from '@/model/edits';
import { acceptsChild, bestPlacement, type Placement } from '@/model/rules';
import { fragmentToXml, xmlToFragment } from '@/model/xml';
import { activeDiagram, change, deleteSelection, placeAfter } from './blocks';
import { useProjectStore } from '../index';

/** The last copied text, for browsers that do not allow reading the clipboard. */
let remembered = '';

/** Returns the selected blocks as XML; null if there are none. */
export function copiedText(): string | null {
  const diagram = activeDiagram();
  const { selection } = useProjectStore.getState();
  if (!diagram || selection.length === 0) return null;
  remembered = fragmentToXml(fragmentOf(diagram, selection));
  return remembered;
}

export async function copySelection(): Promise<boolean> {
  if (copiedText() === null) return false;
  try {
    await navigator.clipboard.writeText(remembered);
  } catch {
    // The browser refused. Pasting in this tab uses the remembered text.
  }
  return true;
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

/** Pastes under the selected block if it accepts children, otherwise after it, otherwise as a draft. */
export function pasteText(text: string): boolean {
  const fragment = xmlToFragment(text);
  const diagram = activeDiagram();
  if (!fragment || !diagram) return false;
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
  change('paste', [insertFragment(copy, place)], { select: copy.tops });
  return true;
}
