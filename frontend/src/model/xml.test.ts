import { describe, expect, it } from 'vitest';
import { fragmentOf } from './edits';
import { parseDiagram } from './serialize';
import { fragmentToXml, xmlToFragment } from './xml';

const diagram = parseDiagram({
  format: 'bt-studio/diagram',
  version: 1,
  id: 'T',
  root: 'r',
  nodes: {
    r: { type: 'Sequence', name: 'a "quoted" <name> & more', children: ['a', 's'] },
    a: {
      type: 'Turn',
      ports: { ang_speed: '0.5' },
      conditions: { _skipIf: "x < 3 && y == 'a'" },
      comment: 'two\nlines',
      disabled: true,
    },
    s: { type: 'SubTree', tree: 'Other', ports: { goal: '{goal}' }, color: '#123456' },
  },
});

describe('the clipboard', () => {
  it('reproduces the copied blocks, with new ids', () => {
    const fragment = xmlToFragment(fragmentToXml(fragmentOf(diagram, ['r'])));
    const read = Object.values(fragment!.nodes).map(({ children, ...node }) => ({
      ...node,
      count: children?.length ?? 0,
    }));
    const wanted = Object.values(diagram.nodes).map(({ children, ...node }) => ({
      ...node,
      count: children?.length ?? 0,
    }));
    expect(read).toEqual(wanted);
  });
  it('reads a whole document in explicit form', () => {
    const fragment = xmlToFragment(
      '<?xml version="1.0"?><root BTCPP_format="4"><BehaviorTree ID="M"><Control ID="Sequence"><Action ID="Turn" name="t" ang_speed="1"/></Control></BehaviorTree><TreeNodesModel><Action ID="Turn"/></TreeNodesModel></root>',
    );
    expect(fragment?.tops).toHaveLength(1);
    expect(Object.values(fragment!.nodes).map((node) => node.type)).toEqual(['Sequence', 'Turn']);
  });
  it('keeps _autoremap an attribute, as files have it', () => {
    const fragment = xmlToFragment('<SubTree ID="Other" _autoremap="true" goal="{goal}"/>');
    expect(Object.values(fragment!.nodes)).toEqual([
      { type: 'SubTree', tree: 'Other', ports: { goal: '{goal}' }, attributes: { _autoremap: 'true' } },
    ]);
  });
  it.each(['', 'hello', '<broken', '<!DOCTYPE x><a/>', '<root/>'])('refuses %j', (text) => {
    expect(xmlToFragment(text)).toBeNull();
  });
});

it('copies silenced findings with their reasons', () => {
  const nodes = { a: { type: 'Sleep', silenced: { BT0119: '"so" & <so>' } } };
  const text = fragmentToXml({ tops: ['a'], nodes });
  const again = xmlToFragment(text);
  expect(Object.values(again?.nodes ?? {})).toEqual([nodes.a]);
  const broken = xmlToFragment('<Sleep _bts_silenced="later"/>');
  expect(Object.values(broken?.nodes ?? {})).toEqual([{ type: 'Sleep', silenced: { '?': 'later' } }]);
});
