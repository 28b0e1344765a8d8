import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import catalog from '@catalog';
import { emptyDiagram, type Diagram, type DiagramNode } from '../diagram';
import { edit } from '../edits';
import { readPortText } from '../ports';
import { makeVocabulary, readCatalog } from '../vocabulary';
import { allKeys, applyChanges, carriedBy, keyOf, linesToLookAt, planRename, type Key } from './rename';
import { hasAutoremap, SHARED, type Forest } from './scope';
import { keysOf, usesIn } from './uses';

const vocabulary = makeVocabulary(readCatalog(catalog));

const tree = (id: string, ...nodes: DiagramNode[]): Diagram => ({
  ...emptyDiagram(id),
  root: 'n0',
  nodes: Object.fromEntries([
    ['n0', { type: 'Sequence', children: nodes.map((_, index) => `n${index + 1}`) }],
    ...nodes.map((node, index) => [`n${index + 1}`, node] as const),
  ]),
});
const forest = (...trees: Diagram[]): Forest => ({
  diagrams: Object.fromEntries(trees.map((each) => [each.id, each])),
  mainTree: 'Main',
});
const call = (called: string, ports: Record<string, string>): DiagramNode => ({
  type: 'SubTree',
  tree: called,
  ports,
});
const sleep = (text: string): DiagramNode => ({ type: 'Sleep', ports: { msec: text } });

function renamed(trees: Forest, key: Key, to: string): Forest {
  const plan = planRename(trees, vocabulary, key, to);
  const diagrams = Object.entries(trees.diagrams).map(([id, diagram]) => [
    id,
    edit(diagram, ...applyChanges(id, plan)).diagram,
  ]);
  return { ...trees, diagrams: Object.fromEntries(diagrams) as Forest['diagrams'] };
}

const textsOf = (trees: Forest, id: string) =>
  Object.values(trees.diagrams[id]?.nodes ?? {})
    .flatMap(({ ports, conditions }) => [...Object.entries(ports ?? {}), ...Object.entries(conditions ?? {})])
    .map(([name, text]) => `${name}=${text}`);

const rename = (trees: Forest, board: string, to = 'v') => renamed(trees, { board, name: 'k' }, to);

describe('planRename', () => {
  it('changes the same name of another tree only where it is the same entry', () => {
    const trees = forest(
      tree('Main', sleep('{k}'), call('Other', { x: '{k}' })),
      tree('Other', sleep('{k}'), sleep('{@k}')),
    );
    const main = rename(trees, 'Main');
    expect(textsOf(main, 'Main')).toEqual(['msec={v}', 'x={v}']);
    expect(textsOf(main, 'Other')).toEqual(['msec={k}', 'msec={@v}']);
    const other = rename(trees, 'Other');
    expect(textsOf(other, 'Main')).toEqual(['msec={k}', 'x={k}']);
    expect(textsOf(other, 'Other')).toEqual(['msec={v}', 'msec={@k}']);
  });

  it('renames the ports of all SubTrees of an inner tree', () => {
    const trees = forest(
      tree('Main', call('In', { k: '5' }), call('In', { k: '{x}' })),
      tree('In', sleep('{k}')),
    );
    expect(textsOf(rename(trees, 'In'), 'Main')).toEqual(['v=5', 'v={x}']);
  });

  it('keeps {=} where both sides are renamed', () => {
    const trees = forest(tree('Main', call('In', { k: '{=}' })), tree('In', sleep('{k}')));
    expect(textsOf(rename(trees, 'Main'), 'Main')).toEqual(['v={=}']);
    expect(textsOf(rename(trees, 'Main'), 'In')).toEqual(['msec={v}']);
  });

  it('renames the ports that a tree declares, and scripts', () => {
    const inner = {
      ...tree('In', { type: 'Script', ports: { code: 'k := 1' }, conditions: { _skipIf: 'k > kk' } }),
      ports: [{ name: 'k', direction: 'input', type: 'int' }, { name: 'kk' }],
    };
    const after = rename(forest(tree('Main'), inner), 'In');
    expect(after.diagrams['In']?.ports).toEqual([
      { name: 'v', direction: 'input', type: 'int' },
      { name: 'kk' },
    ]);
    expect(textsOf(after, 'In')).toEqual(['code=v := 1', '_skipIf=v > kk']);
  });

  it('lists unreadable scripts', () => {
    const trees = forest(tree('Main', { type: 'Script', ports: { code: 'k % 2' } }));
    expect(planRename(trees, vocabulary, keyOf('Main', 'k'), 'v').unread).toEqual([
      { tree: 'Main', node: 'n1', text: 'k % 2' },
    ]);
  });

  it.each([
    ['k', 'same'],
    ['', 'not-a-name'],
    ['a b', 'not-a-name'],
    ['ID', 'not-a-name'],
    ['_v', 'not-a-name'],
    ['used', 'taken'],
    ['inner', 'taken'],
    ['free', null],
  ])('to %j is refused with %s', (to, refusal) => {
    const trees = forest(
      tree('Main', sleep('{k}'), sleep('{used}'), call('In', { _autoremap: '1', k: '{x}' })),
      tree('In', sleep('{inner}')),
      tree('Far', sleep('{free}')),
    );
    expect(planRename(trees, vocabulary, keyOf('Main', 'k'), to).refusal).toBe(refusal);
  });

  it('keeps which uses mean the same entry, in any forest', () => {
    fc.assert(
      fc.property(forests, fc.nat(), fc.constantFrom('fresh', 'a', 'b'), (trees, index, to) => {
        const keys = allKeys(trees, vocabulary);
        const key = keys[index % Math.max(1, keys.length)];
        fc.pre(key !== undefined && planRename(trees, vocabulary, key, to).refusal === null);
        expect(entries(renamed(trees, key, to))).toEqual(entries(trees));
      }),
      { numRuns: 400 },
    );
  });
});

const keyTexts = fc.constantFrom('{a}', '{b}', '{@a}', '{@b}', '{=}', '7');
const leaves = fc.oneof(
  keyTexts.map(sleep),
  fc
    .constantFrom('a := b', '@a := a', 'b > 1')
    .map((code): DiagramNode => ({ type: 'Script', ports: { code } })),
);
const calls = (called: string) =>
  fc
    .record({ a: fc.option(keyTexts), b: fc.option(keyTexts), _autoremap: fc.option(fc.constant('true')) })
    .map((ports) =>
      call(
        called,
        Object.fromEntries(Object.entries(ports).filter(([, text]) => text !== null)) as Record<
          string,
          string
        >,
      ),
    );
/** Trees, each of which calls only later ones. */
const forests = fc
  .tuple(
    fc.array(fc.oneof(leaves, calls('Mid'), calls('Low')), { minLength: 1, maxLength: 4 }),
    fc.array(fc.oneof(leaves, calls('Low')), { minLength: 1, maxLength: 4 }),
    fc.array(leaves, { minLength: 1, maxLength: 3 }),
  )
  .map(([main, mid, low]) => forest(tree('Main', ...main), tree('Mid', ...mid), tree('Low', ...low)));

/**
 * Returns the entry of each use, numbered by first use. An entry is found by following the key up through
 * every chain of calls.
 */
function entries(trees: Forest): number[][] {
  const numbers = new Map<string, number>();
  const found: number[][] = [];
  const visit = (id: string, path: string, resolve: (key: string) => string): void => {
    const diagram = trees.diagrams[id]!;
    const root = (key: string): string => (key.startsWith('@') ? `/${key.slice(1)}` : resolve(key));
    for (const use of usesIn(diagram, trees, vocabulary)) {
      const places = keysOf(use).map(root);
      found.push(
        places.map((place) => numbers.get(place) ?? (numbers.set(place, numbers.size), numbers.size - 1)),
      );
    }
    for (const [node, each] of Object.entries(diagram.nodes)) {
      if (each.type !== 'SubTree') continue;
      const inside = `${path}/${node}`;
      visit(each.tree ?? '', inside, (key) => {
        const text = each.ports?.[key];
        if (text === undefined)
          return hasAutoremap(each) && !key.startsWith('_') ? resolve(key) : `${inside}/${key}`;
        const value = readPortText(text);
        if (value.kind === 'same-name') return resolve(key);
        return value.kind === 'key' ? root(value.global ? `@${value.key}` : value.key) : `${inside}/${key}`;
      });
    }
  };
  visit('Main', '', (key) => `/${key}`);
  return found;
}

describe('allKeys', () => {
  it('names each entry once', () => {
    const trees = forest(
      tree('Main', sleep('{k}'), call('In', { k: '{=}' })),
      tree('In', sleep('{k}'), sleep('{@k}'), sleep('{own}')),
    );
    expect(allKeys(trees, vocabulary)).toEqual([
      { board: 'Main', name: 'k' },
      { board: 'In', name: 'own' },
    ]);
    expect(keyOf('Main', '@k')).toEqual({ board: SHARED, name: 'k' });
  });
});

describe('carriedBy', () => {
  it('names the trees that pass the key on without its name', () => {
    const trees = forest(tree('Main', sleep('{k}'), call('In', { _autoremap: '1' })), tree('In'));
    expect(carriedBy(trees, planRename(trees, vocabulary, keyOf('Main', 'k'), 'v'))).toEqual(['Main']);
  });
});

describe('linesToLookAt', () => {
  it('has the lines of Python that contain the key as a string', () => {
    const texts = { 'a.py': 'x = 1\n  get("k")\n', 'b.py': "k = 'kk'", 'c.md': '"k"' };
    expect(linesToLookAt(texts, 'k')).toEqual([{ path: 'a.py', line: 2, text: 'get("k")' }]);
  });
});
