import { readFileSync } from 'node:fs';
import catalog from '@catalog';
import { describe, expect, it } from 'vitest';
import { CODES, findProblems } from './problems';
import { parseDiagram } from './serialize';
import { treeFacts } from './treeFacts';
import { makeVocabulary, readCatalog, type ActionDescription } from './vocabulary';

type Found = readonly [tree: string, node: string, port: string, code: string, severity: string];

interface Cases {
  readonly actions: readonly ActionDescription[];
  readonly cases: readonly {
    readonly what: string;
    readonly trees: Readonly<Record<string, object>>;
    readonly found: readonly Found[];
  }[];
}

const { actions, cases } = JSON.parse(readFileSync('../tests/shared/problems.json', 'utf-8')) as Cases;
const nodes = readCatalog(catalog);
const inOrder = (rows: readonly (readonly string[])[]): string[] => rows.map((row) => row.join(' | ')).sort();

/** Returns the translator's code of a finding: for a kind with several codes, the one that is in `among`. */
function codes(kind: keyof typeof CODES, among: readonly string[]): string {
  const known = CODES[kind];
  return known.find((code) => among.includes(code)) ?? known[0] ?? kind;
}

describe('the editor judges projects as the translator does', () => {
  it.each(cases.map((each) => [each.what, each] as const))('%s', (_what, { trees, found }) => {
    const diagrams = Object.entries(trees).map(([id, tree]) =>
      parseDiagram({ format: 'bt-studio/diagram', version: 1, id, ...tree }),
    );
    const facts = new Map(diagrams.map((diagram) => [diagram.id, treeFacts(diagram)]));
    const vocabulary = makeVocabulary(nodes, actions, facts, 'MainTree');
    const own = diagrams.flatMap((diagram) =>
      findProblems(diagram, vocabulary).map(({ kind, node, port, severity }) => {
        const here = found.filter((each) => each[0] === diagram.id && each[1] === (node ?? ''));
        const code = codes(
          kind,
          here.map((each) => each[3]),
        );
        return [diagram.id, node ?? '', port ?? '', code, severity];
      }),
    );
    expect(inOrder(own)).toEqual(inOrder(found));
  });
});
