import type { Diagram } from '@/model/diagram';

export const FIRST_TEST = 'tests/main.test.yaml';

/** Returns the text of a first test of a tree, with a double for each of its leaves that is an action. */
export function firstTest(tree: string, diagram: Diagram | undefined, actions: ReadonlySet<string>): string {
  const types = Object.values(diagram?.nodes ?? {}).map(({ type }) => type);
  const leaves = [...new Set(types)].filter((type) => actions.has(type)).sort();
  const doubles = leaves.map((type) => `      ${type}: SUCCESS\n`).join('');
  return `format: bt-studio/test
version: 1
tests:
  - name: the first tick
    tree: ${JSON.stringify(tree)}
${doubles ? `    doubles:\n${doubles}` : ''}    ticks: 1
    expect:
      - {at: 1, root: SUCCESS}
`;
}
