import { describe, expect, it } from 'vitest';
import { actionSource } from './actionTemplate';

describe('the source of a new node', () => {
  it.each([
    ['Control', 'ControlNode', 'for index in range(self.child_count):'],
    ['Decorator', 'DecoratorNode', 'status = self.tick_child()'],
  ] as const)('of the kind %s derives from %s', (kind, base, line) => {
    const source = actionSource('Mine', kind);
    expect(source).toContain(`from tree_gardener import ${base}, Status\n\n\nclass Mine(${base}):\n    """`);
    expect(source).toContain(line);
    expect(source).not.toContain('INPUT_PORTS');
  });

  it('declares the ports that its block has', () => {
    const source = actionSource('Mine', 'Decorator', ['hz']);
    expect(source).toContain('from tree_gardener import DecoratorNode, Port, Status');
    expect(source).toContain(
      '        "hz": Port(str, description="Say what it is."),\n    }\n\n    def update',
    );
    expect(actionSource('Mine', 'Action', ['hz'])).toContain('"hz": Port(str');
  });
});
