import { freshId } from '@/model/diagram';
import { fragmentOf, insertFragment, withFreshIds } from '@/model/edits';
import { acceptsChild, bestPlacement, type Placement } from '@/model/rules';
import { fragmentToXml, xmlToFragment } from '@/model/xml';
import { activeDiagram, change, deleteSelection, placeAfter } from './commands';
import { useProjectStore } from './index';

/** What was copied last, for browsers that refuse to give the clipboard back. */
let remembered = '';

export async function copySelection(): Promise<boolean> {
  const diagram = activeDiagram();
  const { selection } = useProjectStore.getState();
  if (!diagram || selection.length === 0) return false;
  remembered = fragmentToXml(fragmentOf(diagram, selection));
  try {
    await navigator.clipboard.writeText(remembered);
  } catch {
    // Not allowed here: pasting in this tab works from what is remembered.
  }
  return true;
}

export async function cutSelection(): Promise<void> {
  if (await copySelection()) deleteSelection();
}

async function clipboardText(): Promise<string> {
  try {
    return await navigator.clipboard.readText();
  } catch {
    return remembered;
  }
}

/** Pastes into the selected block where it takes children, else after it, else as a draft. */
export async function paste(): Promise<boolean> {
  const fragment = xmlToFragment(await clipboardText());
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
