import { screen } from '@testing-library/react';
import i18next from 'i18next';
import { describe, expect, it, onTestFinished } from 'vitest';
import type { PortSpec } from '@/model/ports';
import { vocabulary } from '@/model/testing';
import type { NodeSpec } from '@/model/vocabulary';
import { useShownValues } from '@/store/session/values/shown';
import type { PortMark } from '@/store/run/portMarks';
import { port, show } from '../../../../harness/testing';
import { BlockPorts } from './BlockPorts';

const specOf = (...ports: ReturnType<typeof port>[]): NodeSpec => ({
  ...vocabulary.specs.get('Turn')!,
  ports: ports as PortSpec[],
});

function open(
  spec: NodeSpec | undefined,
  ports: Record<string, string> = {},
  marks: Record<string, PortMark> = {},
) {
  const t = i18next.getFixedT('en', 'canvas');
  const node = { type: 'Turn', ports };
  const place = { tree: 'Main', node: 'a' };
  show(<BlockPorts place={place} node={node} spec={spec} marks={new Map(Object.entries(marks))} t={t} />);
  return screen.queryAllByRole('listitem').map(({ textContent }) => textContent);
}

/** Returns the class of the value of the only port. */
const look = () => screen.getByRole('listitem').lastElementChild!.className;

describe('BlockPorts', () => {
  it('is absent for a block without ports', () => {
    expect(open(specOf())).toEqual([]);
    expect(screen.queryByRole('list')).toBeNull();
  });

  it('marks a value that differs from the saved one, and says both', () => {
    const mark: PortMark = { state: 'taken', saved: null, message: '' };
    open(
      specOf(port('a', 'double', { default: '0.3' }), port('b', 'int')),
      { a: '0.5', b: '1' },
      { a: mark },
    );
    const value = screen.getByText('0.5');
    expect(value).toHaveAttribute('data-live', 'taken');
    expect(value).toHaveAttribute('title', '0.5 – changed since the program was started; before: 0.3');
    expect(screen.getByText('1')).not.toHaveAttribute('data-live');
  });

  it('shows values, defaults, and missing values', () => {
    const rows = open(
      specOf(
        port('a', 'int'),
        port('b', 'int', { default: '3' }),
        port('c', 'int', { required: true }),
        port('d', 'int'),
      ),
      { a: '1' },
    );
    expect(rows).toEqual([' a1', ' b3', ' crequired', ' d—']);
  });

  it('shows the direction of a value', () => {
    const rows = open(
      specOf(
        port('in', 'int'),
        port('out', 'int', { direction: 'output' }),
        port('both', 'int', { direction: 'inout' }),
      ),
    );
    expect(rows).toEqual([' in—', '→ out—', '⇄ both—']);
  });

  it('shows ports that are set without being declared', () => {
    expect(open(undefined, { x: '{goal}' })).toEqual([' x{goal}']);
  });

  it('shows six ports, and counts the others', () => {
    const names = ['a', 'b', 'c', 'd', 'e', 'f', 'g'];
    expect(open(specOf(...names.map((name) => port(name, 'int'))))).toHaveLength(7);
    expect(screen.getByText('1 more port')).toBeInTheDocument();
    expect(screen.queryByText(/ g/)).toBeNull();
  });

  it('counts no others if there are six', () => {
    const names = ['a', 'b', 'c', 'd', 'e', 'f'];
    expect(open(specOf(...names.map((name) => port(name, 'int'))))).toHaveLength(6);
    expect(screen.queryByText(/more/)).toBeNull();
  });

  it.each([
    ['a literal', '7', {}, /portLiteral/],
    ['a key', '{goal}', {}, /portKey/],
    ['the key of its own name', '{=}', {}, /portKey/],
    ['a broken key', '{goal', {}, /portMissing/],
    ['a missing value', undefined, { required: true }, /portMissing/],
    ['a default of a required port', undefined, { required: true, default: '1' }, /portDefault/],
    ['nothing', undefined, {}, /portDefault/],
  ])('draws %s in its style', (_, value, more, expected) => {
    open(specOf(port('x', 'int', more)), value === undefined ? {} : { x: value });
    expect(look()).toMatch(expected);
  });

  it('cuts values of more than sixteen letters, with the whole one as its title', () => {
    open(undefined, { x: 'sixteen letters!' });
    expect(screen.getByTitle('sixteen letters!')).not.toHaveAttribute('data-long');
    open(undefined, { y: 'seventeen letters' });
    expect(screen.getByTitle('seventeen letters')).toHaveAttribute('data-long', 'true');
  });

  it('marks the ports whose live values are wanted, if they name an entry', () => {
    useShownValues.setState({ ports: new Set(['Main/a/angle', 'Main/a/rate', 'Main/b/way']) });
    onTestFinished(() => useShownValues.setState({ ports: new Set() }));
    open(specOf(port('angle', 'double'), port('rate', 'double'), port('way', 'string')), {
      angle: '{a}',
      rate: '5',
      way: '{w}',
    });
    expect(screen.getByTestId('value-Main/a/angle')).toHaveTextContent('{a}');
    expect(screen.queryByTestId('value-Main/a/rate')).toBeNull();
    expect(screen.queryByTestId('value-Main/a/way')).toBeNull();
  });

  it('keeps room for a wanted value', () => {
    useShownValues.setState({ ports: new Set(['Main/a/p8']) });
    onTestFinished(() => useShownValues.setState({ ports: new Set() }));
    const names = Array.from({ length: 8 }, (_, index) => `p${index + 1}`);
    const rows = open(specOf(...names.map((name) => port(name, 'any'))), { p8: '{x}' });
    expect(rows.map((row) => row.trim().slice(0, 2))).toEqual(['p1', 'p2', 'p3', 'p4', 'p5', 'p8', '2 ']);
  });
});
