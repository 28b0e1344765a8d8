import { describe, expect, it } from 'vitest';
import type { Diagram, DiagramNode } from '../diagram';
import { findEntry, keyIn, type Enclosing } from './entry';

const tree = (id: string, nodes: Record<string, DiagramNode>): Diagram => ({
  format: 'bt-studio/diagram',
  version: 1,
  id,
  root: Object.keys(nodes)[0] ?? null,
  nodes,
  drafts: [],
  layout: 'vertical',
});

/** Main calls Dock, which calls Turn. */
function world(dock: Record<string, string>, turn: Record<string, string>) {
  const diagrams = {
    Main: tree('Main', { d: { type: 'SubTree', tree: 'Dock', ports: dock } }),
    Dock: tree('Dock', { t: { type: 'SubTree', tree: 'Turn', ports: turn } }),
    Turn: tree('Turn', { x: { type: 'Rotate' } }),
  };
  const callers: Enclosing[] = [
    { path: 'Dock::1/Turn::2', tree: 'Dock', node: 't' },
    { path: 'Dock::1', tree: 'Main', node: 'd' },
  ];
  return (key: string, ...entries: string[]) => {
    const found = findEntry(key, callers, {
      diagrams,
      has: ({ scope, key: name }) => entries.includes(`${scope}|${name}`),
    });
    return found && `${found.scope}|${found.key}`;
  };
}

describe('keyIn', () => {
  it.each([
    ['{speed}', 'speed'],
    ['{=}', 'angle'],
    ['{@speed}', '@speed'],
    ['0.5', null],
    ['', null],
    ['{', null],
  ])('reads %o as %o', (text, key) => {
    expect(keyIn(text, 'angle')).toBe(key);
  });
});

describe('findEntry', () => {
  it('prefers the scope of the node itself', () => {
    const find = world({ goal: '{place}' }, { goal: '{goal}' });
    expect(find('goal', 'Dock::1/Turn::2|goal', 'Dock::1|goal', '|place')).toBe('Dock::1/Turn::2|goal');
  });

  it('follows the ports of the SubTrees under their names', () => {
    const find = world({ goal: '{place}' }, { angle: '{goal}' });
    expect(find('angle', '|place', '|angle')).toBe('|place');
    expect(find('angle', 'Dock::1|goal', '|place')).toBe('Dock::1|goal');
  });

  it('follows `{=}`, `_autoremap` and shared keys', () => {
    expect(world({ goal: '{=}' }, { _autoremap: 'true' })('goal', '|goal')).toBe('|goal');
    expect(world({}, { goal: '{@goal}' })('goal', '|goal')).toBe('|goal');
    expect(world({}, {})('@goal', '|goal')).toBe('|goal');
  });

  it('does not pass what a SubTree does not pass', () => {
    expect(world({}, {})('goal', '|goal')).toBeNull();
    expect(world({ _autoremap: 'true' }, { _autoremap: 'true' })('_goal', '|_goal')).toBeNull();
    expect(world({ goal: 'door' }, { goal: '{goal}' })('goal', '|goal')).toBeNull();
  });

  it('finds nothing for an entry that was not written', () => {
    expect(world({ goal: '{=}' }, { goal: '{=}' })('goal')).toBeNull();
  });
});
