import { describe, expect, it } from 'vitest';
import { emptyDiagram } from '@/model/diagram';
import { vocabulary } from '@/model/testing';
import { targetOf } from './target';

const diagram = {
  ...emptyDiagram('Main'),
  root: 'a',
  nodes: { a: { type: 'Turn' }, x: { type: 'Nowhere' } },
};

describe('targetOf', () => {
  it('has the block, its tree and the description of its type', () => {
    const spec = vocabulary.specs.get('Turn');
    expect(targetOf(diagram, 'a', vocabulary)).toEqual({
      diagram,
      tree: 'Main',
      id: 'a',
      node: { type: 'Turn' },
      spec,
    });
    expect(spec).toBeDefined();
    expect(targetOf(diagram, 'x', vocabulary)?.spec).toBeUndefined();
  });

  it.each([
    [undefined, 'a'],
    [diagram, undefined],
    [diagram, 'gone'],
  ])('is null without a diagram, a selection or its block', (tree, id) => {
    expect(targetOf(tree, id, vocabulary)).toBeNull();
  });
});
