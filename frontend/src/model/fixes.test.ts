import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram, type DiagramNode } from './diagram';
import { edit } from './edits';
import { fixesFor } from './fixes';
import { findProblems } from './problems';
import { similarNames } from './similar';
import { vocabulary } from './testing';

const tree = (nodes: Record<string, DiagramNode>): Diagram => ({
  ...emptyDiagram('MainTree'),
  root: 'r',
  nodes,
});
const under = (node: DiagramNode) => tree({ r: { type: 'Sequence', children: ['x'] }, x: node });

/** Returns the fixes of the only problem. */
function fixesOf(diagram: Diagram) {
  const [problem] = findProblems(diagram, vocabulary);
  return problem ? fixesFor(problem, diagram, vocabulary) : [];
}

describe('fixes', () => {
  it.each<[string, Diagram]>([
    ['rename-type', under({ type: 'Trun' })],
    ['rename-port', under({ type: 'Turn', ports: { ang_sped: '1' } })],
    ['remove-port', under({ type: 'Turn', ports: { nonsense: '1' } })],
    ['use-key', tree({ r: { type: 'Repeat', children: ['x'] }, x: { type: 'Turn' } })],
    ['use-key', under({ type: 'Turn', ports: { ang_speed: '{speed' } })],
    ['use-key', under({ type: 'Turn', ports: { ang_speed: '{a}{b}' } })],
    ['set-port', under({ type: 'Turn', ports: { ang_speed: '1.5m' } })],
    ['remove-port', under({ type: 'Free', ports: { '1st': '1' } })],
    ['remove-condition', under({ type: 'Turn', conditions: { _skipIf: '' } })],
    ['set-port', under({ type: 'SubTree', tree: 'Inner', attributes: { _autoremap: 'maybe' } })],
    ['set-port', under({ type: 'SubTree', tree: 'Inner', ports: { far: '2' } })],
    ['use-key', under({ type: 'SubTree', tree: 'Inner' })],
    [
      'rename-type',
      tree({
        r: { type: 'ReactiveSequence', children: ['x', 'y'] },
        x: { type: 'AsyncSequence', children: ['a'] },
        y: { type: 'AsyncSequence', children: ['b'] },
        a: { type: 'Turn' },
        b: { type: 'Turn' },
      }),
    ],
    ['set-port', under({ type: 'Turn', ports: { ang_speed: '{}' } })],
    ['set-port', under({ type: 'Turn', ports: { ang_speed: '0,5' } })],
    [
      'use-key',
      tree({
        r: { type: 'LoopInt', ports: { queue: '1;2', value: 'v' }, children: ['x'] },
        x: { type: 'Turn' },
      }),
    ],
    [
      'wrap-children',
      tree({ r: { type: 'Inverter', children: ['x', 'y'] }, x: { type: 'Turn' }, y: { type: 'Turn' } }),
    ],
  ])('%s fixes its finding, and undo restores the fault', (key, diagram) => {
    const [offered] = fixesOf(diagram).filter(({ does }) => typeof does === 'function');
    expect(offered?.key).toBe(key);
    if (typeof offered?.does !== 'function') throw new Error('no recipe');
    const { diagram: mended } = edit(diagram, offered.does);
    expect(findProblems(mended, vocabulary)).toEqual([]);
    expect(findProblems(diagram, vocabulary)).not.toEqual([]);
  });

  it.each<[string, Diagram, string, string[]]>([
    [
      'a missing value',
      tree({ r: { type: 'Repeat', children: ['x'] }, x: { type: 'Turn' } }),
      'num_cycles',
      ['type-value', 'use-key'],
    ],
    [
      'a missing value of a tree',
      under({ type: 'SubTree', tree: 'Inner' }),
      'far',
      ['type-value', 'use-key'],
    ],
    [
      'a wrong value',
      tree({
        r: { type: 'Repeat', ports: { num_cycles: 'often' }, children: ['x'] },
        x: { type: 'Turn' },
      }),
      'num_cycles',
      ['type-value', 'use-key'],
    ],
    [
      'a number that is too large',
      tree({
        r: { type: 'Repeat', ports: { num_cycles: '99999999999' }, children: ['x'] },
        x: { type: 'Turn' },
      }),
      'num_cycles',
      ['type-value'],
    ],
  ])('offers to type a value before a key: %s', (_what, diagram, port, keys) => {
    const fixes = fixesOf(diagram);
    expect(fixes.map(({ key }) => key)).toEqual(keys);
    expect(fixes[0]?.does).toMatchObject({ makes: 'typing', port });
  });

  it('offers only a key to a port that is written', () => {
    const missing = { kind: 'missing-key', node: 'r', port: 'value' } as const;
    const diagram = tree({ r: { type: 'LoopInt', children: ['x'] }, x: { type: 'Turn' } });
    expect(fixesFor(missing, diagram, vocabulary).map(({ key }) => key)).toEqual(['use-key']);
  });

  it('offers to write a missing action, with the given ports', () => {
    const made = fixesOf(under({ type: 'FollowWall', ports: { side: 'left' } })).at(-1);
    expect(made).toMatchObject({
      key: 'make-action',
      does: { makes: 'action', name: 'FollowWall', ports: ['side'] },
    });
  });

  it.each([
    [['x'], 'Decorator'],
    [['x', 'y'], 'Control'],
  ])('offers to write a missing node that has the children %s as a %s', (children, kind) => {
    const nodes = Object.fromEntries(children.map((id) => [id, { type: 'Turn' }]));
    const diagram = {
      ...emptyDiagram('MainTree'),
      root: 'r',
      nodes: { r: { type: 'Mine', children }, ...nodes },
    };
    expect(fixesOf(diagram).at(-1)).toMatchObject({ does: { makes: 'action', name: 'Mine', kind } });
  });

  it('offers to make a missing tree, but no tree that would call itself', () => {
    const fixes = fixesOf(under({ type: 'SubTree', tree: 'Patrol' }));
    expect(fixes).toMatchObject([{ key: 'make-tree', does: { makes: 'tree', name: 'Patrol' } }]);
  });
  it('knows findings of the server, too', () => {
    const diagram = under({ type: 'Turn', disabled: true });
    const [offered] = fixesFor({ code: 'BT0105', node: 'x' }, diagram, vocabulary);
    expect(offered?.key).toBe('enable');
  });
  it('offers nothing for unknown findings', () => {
    expect(fixesFor({ code: 'BT0999', node: 'x' }, under({ type: 'Turn' }), vocabulary)).toEqual([]);
    expect(fixesFor({ code: 'BT0105', node: 'gone' }, under({ type: 'Turn' }), vocabulary)).toEqual([]);
  });
});

describe('similarNames', () => {
  it.each([
    ['Sequnece', ['Sequence', 'Fallback', 'ReactiveSequence'], ['Sequence']],
    ['sequence', ['Sequence'], ['Sequence']],
    ['Go', ['Turn', 'Do'], ['Do']],
    ['Walk', ['Turn'], []],
  ])('%s', (name, names, expected) => {
    expect(similarNames(name, names)).toEqual(expected);
  });
});
