import { describe, expect, it } from 'vitest';
import { changed, existing, followed, isOn, plainBreakpoint, readBreakpoints, toggled } from './breakpoints';
import type { Diagram } from './diagram';

const tree = (id: string, ...nodes: string[]) =>
  ({ id, nodes: Object.fromEntries(nodes.map((node) => [node, { type: 'Sleep' }])) }) as unknown as Diagram;
const at = plainBreakpoint;

describe('breakpoints', () => {
  it('are set and removed on a block', () => {
    const one = toggled([], 'Main', 'a');
    expect(one).toEqual([at('Main', 'a')]);
    expect(isOn(one[0]!, 'Main', 'a')).toBe(true);
    expect(isOn(one[0]!, 'Dock', 'a')).toBe(false);
    expect(toggled(one, 'Main', 'a')).toEqual([]);
    expect(toggled(one, 'Dock', 'a')).toHaveLength(2);
  });

  it('follow a block into another tree, and wait for a deleted one', () => {
    const list = [at('Main', 'a'), at('Main', 'b')];
    const before = { Main: tree('Main', 'a', 'b') };
    expect(followed(list, before, before)).toBe(list);
    const moved = { Main: tree('Main', 'b'), Dock: tree('Dock', 'a') };
    expect(followed(list, before, moved)).toEqual([at('Dock', 'a'), at('Main', 'b')]);
    const without = { Main: tree('Main', 'b') };
    expect(followed(list, before, without)).toBe(list);
    expect(existing(list, without)).toEqual([at('Main', 'b')]);
  });

  it('follow a tree to its new name, and wait for a tree that is not loaded', () => {
    const list = [at('Main', 'a')];
    expect(followed(list, { Main: tree('Main', 'a') }, { New: tree('New', 'a') })).toEqual([at('New', 'a')]);
    expect(followed(list, {}, {})).toBe(list);
  });

  it('have a result only for a moment with one', () => {
    const returns = changed([at('Main', 'a')], 'Main', 'a', { when: 'returns' });
    expect(returns).toMatchObject([{ when: 'returns', status: 'FAILURE' }]);
    expect(changed(returns, 'Main', 'a', { when: 'after' })).toMatchObject([{ status: null }]);
    expect(changed(returns, 'Main', 'b', { on: false })).toEqual(returns);
  });

  it('are read from a stored text, without what is damaged', () => {
    const full = { ...at('Main', 'a'), instance: ['s'], condition: 'x > 1', hits: 3, log: 'x', on: false };
    const damaged = [null, 1, {}, { tree_id: 'Main' }, { tree_id: 1, node_id: 'a' }];
    expect(readBreakpoints([full, ...damaged])).toEqual([full]);
    const odd = { tree_id: 'Main', node_id: 'a', when: 'never', hits: -1, instance: [1], condition: 7 };
    expect(readBreakpoints([odd])).toEqual([at('Main', 'a')]);
    expect(readBreakpoints('x')).toEqual([]);
  });
});
