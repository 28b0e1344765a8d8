import type { Diagram } from './diagram';
import { canMorph, canWrapIn, isKindLegal, type Kind } from './rules';
import type { NodeSpec, Vocabulary } from './vocabulary';

/** A type of block that can be chosen, with its description. */
export interface Choice {
  readonly kind: Kind;
  readonly spec: NodeSpec;
  readonly label: string;
}

/**
 * Returns every type of block that this tree may contain: built-ins, actions, subtrees by name, and last the
 * offered actions that the project has not taken.
 */
export function allChoices(
  diagram: Pick<Diagram, 'id'> | null,
  vocabulary: Vocabulary,
  offered: readonly NodeSpec[] = [],
): Choice[] {
  const choices: Choice[] = [];
  for (const spec of vocabulary.specs.values()) {
    if (spec.type === 'SubTree') continue;
    choices.push({ kind: { type: spec.type }, spec, label: spec.type });
  }
  const subtree = vocabulary.specs.get('SubTree');
  if (subtree && diagram) {
    for (const [tree, { description }] of vocabulary.trees) {
      const kind = { type: 'SubTree', tree };
      const spec = description === '' ? subtree : { ...subtree, summary: description };
      if (isKindLegal(diagram, kind, vocabulary)) choices.push({ kind, spec, label: tree });
    }
  }
  for (const spec of offered) {
    if (!vocabulary.specs.has(spec.type)) choices.push({ kind: { type: spec.type }, spec, label: spec.type });
  }
  return choices;
}

export type Purpose =
  | { readonly for: 'add' }
  | { readonly for: 'wrap'; readonly count: number }
  | { readonly for: 'morph'; readonly node: string };

/** Returns whether a choice is legal for a purpose. */
export function suits(choice: Choice, diagram: Diagram, purpose: Purpose): boolean {
  switch (purpose.for) {
    case 'add':
      return true;
    case 'wrap':
      return canWrapIn(choice.spec) && purpose.count <= choice.spec.maxChildren;
    case 'morph':
      return canMorph(diagram, purpose.node, choice.spec);
  }
}

/**
 * Returns how well a text matches a search; 0: not at all. The best match is the whole text, then its start,
 * the start of a word, the capitals, any place, and the letters in order.
 */
export function matchScore(text: string, search: string): number {
  if (search === '') return 1;
  const [hay, needle] = [text.toLowerCase(), search.toLowerCase()];
  if (hay === needle) return 6;
  if (hay.startsWith(needle)) return 5;
  const capitals = text.replace(/[^A-Z0-9]/g, '').toLowerCase();
  if (capitals.startsWith(needle)) return 4;
  if (hay.includes(needle)) return 3;
  let at = 0;
  for (const letter of hay) if (letter === needle[at]) at += 1;
  return at === needle.length ? 2 : 0;
}

const FAMILY_ORDER = ['action', 'condition', 'control', 'decorator', 'subtree'] as const;

/** A search finds an offered action by a part of its name, not by single letters. */
const LEAST_OFFERED = 3;

function nameScore({ label, spec }: Choice, search: string): number {
  const score = matchScore(label, search);
  return spec.source === 'offered' && score < LEAST_OFFERED ? 0 : score;
}

/** Returns whether a search means the name of a choice; an empty search means every one. */
export const isNamed = (choice: Choice, search: string): boolean =>
  search === '' || nameScore(choice, search) > 0;

/**
 * Returns the choices whose name or summary, as the page shows it, matches: the user's own actions first, then
 * by family in the order of the catalogue, and last the offered actions, which only a search shows.
 */
export function searchChoices(
  choices: readonly Choice[],
  search: string,
  summaryOf: (choice: Choice) => string = ({ spec }) => spec.summary,
): Choice[] {
  return choices
    .map((choice, index) => {
      const named = nameScore(choice, search);
      const told =
        search.length > 2 && summaryOf(choice).toLowerCase().includes(search.toLowerCase()) ? 1 : 0;
      return { choice, index, score: Math.max(named * 2, told) };
    })
    .filter(({ score }) => score > 0)
    .sort(
      (a, b) =>
        b.score - a.score ||
        Number(a.choice.spec.source === 'offered') - Number(b.choice.spec.source === 'offered') ||
        Number(b.choice.spec.source === 'action') - Number(a.choice.spec.source === 'action') ||
        FAMILY_ORDER.indexOf(a.choice.spec.family) - FAMILY_ORDER.indexOf(b.choice.spec.family) ||
        a.index - b.index,
    )
    .map(({ choice }) => choice);
}
