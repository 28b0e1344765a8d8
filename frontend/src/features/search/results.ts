import { canReplace, type Passage } from '@/model/search/passages';
import type { Hit, Hits } from '@/model/search/seek';
import type { Replacement } from '@/store/project/edits/replace';

/** A hit, with the text that contains it. */
export interface Row {
  readonly passage: Passage;
  readonly hit: Hit;
}

/** The hits in one tree or file. */
export interface Group {
  readonly path: string;
  readonly rows: readonly Row[];
}

export interface Results {
  readonly groups: readonly Group[];
  readonly count: number;
  readonly isCut: boolean;
}

/** Groups hits by document, in the order of the passages. */
export function resultsOf(passages: readonly Passage[], { hits, isCut }: Hits): Results {
  const groups = new Map<string, Row[]>();
  for (const hit of hits) {
    const passage = passages[hit.text];
    if (!passage) continue;
    const rows = groups.get(passage.path) ?? [];
    rows.push({ passage, hit });
    groups.set(passage.path, rows);
  }
  return { groups: [...groups].map(([path, rows]) => ({ path, rows })), count: hits.length, isCut };
}

/** Returns the hits that can be replaced, grouped by the text that contains them. */
export function replacementsOf(rows: readonly Row[]): Replacement[] {
  const byPassage = new Map<Passage, Hit[]>();
  for (const { passage, hit } of rows) {
    if (canReplace(passage)) byPassage.set(passage, [...(byPassage.get(passage) ?? []), hit]);
  }
  return [...byPassage].map(([passage, hits]) => ({ passage, hits }));
}
