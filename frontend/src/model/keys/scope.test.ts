import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram, type DiagramNode } from '../diagram';
import { scopeOf, SHARED, type Forest } from './scope';

const tree = (id: string, ports?: unknown, ...nodes: DiagramNode[]): Diagram => ({
  ...emptyDiagram(id),
  root: 'n0',
  nodes: Object.fromEntries(nodes.map((node, index) => [`n${index}`, node])),
  ports,
});
const call = (called: string, ports: Record<string, string> = {}, more = {}): DiagramNode => ({
  type: 'SubTree',
  tree: called,
  ports,
  ...more,
});
const forest = (...trees: Diagram[]): Forest => ({
  diagrams: Object.fromEntries(trees.map((each) => [each.id, each])),
  mainTree: 'Main',
});
const scope = (trees: Forest, board: string, key = 'k') => [...scopeOf(trees, board, key)].sort();

describe('scopeOf', () => {
  it.each([['{k}'], ['{=}'], [' {k} ']])('passes the boundary of a SubTree with k="%s"', (text) => {
    const both = forest(tree('Main', [], call('Dock', { k: text })), tree('Dock'));
    expect(scope(both, 'Dock')).toEqual([SHARED, 'Dock', 'Main']);
  });

  it.each([['{other}'], ['5'], [undefined]])('ends at a SubTree with k="%s"', (text) => {
    const both = forest(tree('Main', [], call('Dock', text === undefined ? {} : { k: text })), tree('Dock'));
    expect(scope(both, 'Dock')).toEqual(['Dock']);
    expect(scope(both, 'Main')).toEqual([SHARED, 'Main']);
  });

  it('is the shared key and that of the main tree, and no key of other trees', () => {
    const both = forest(tree('Main', [], call('Dock')), tree('Dock'));
    expect(scope(both, SHARED)).toEqual([SHARED, 'Main']);
    const passed = forest(tree('Main', [], call('Dock', { k: '{@k}' })), tree('Dock'));
    expect(scope(passed, 'Dock')).toEqual([SHARED, 'Dock', 'Main']);
  });

  it('is passed by _autoremap, except for private keys and explicitly passed ones', () => {
    const auto = { _autoremap: 'true' };
    const deep = forest(
      tree('Main', [], call('A', auto)),
      tree('A', [], call('B', {}, { attributes: { _autoremap: '1' } })),
      tree('B'),
    );
    expect(scope(deep, 'B')).toEqual([SHARED, 'A', 'B', 'Main']);
    expect(scope(deep, 'B', '_k')).toEqual(['B']);
    const named = forest(tree('Main', [], call('A', { ...auto, k: '{x}' })), tree('A'));
    expect(scope(named, 'A')).toEqual(['A']);
  });

  it('uses the defaults of the ports that a tree declares', () => {
    const rows = [{ name: 'k', direction: 'input', type: 'int', default: '{=}' }];
    const both = forest(tree('Main', [], call('Dock')), tree('Dock', rows));
    expect(scope(both, 'Dock')).toEqual([SHARED, 'Dock', 'Main']);
  });
});
