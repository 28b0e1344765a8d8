import { expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from '@/model/diagram';
import { useProjectStore } from '@/store/project';
import { openDiagram } from '../../../../harness/canvas';
import { factsOf } from './facts';

it('knows each block, also one that a folded block hides or that is looked into', () => {
  const diagram: Diagram = {
    ...emptyDiagram('Main'),
    root: 'r',
    nodes: {
      r: { type: 'Sequence', children: ['f', 's'] },
      f: { type: 'Inverter', children: ['a'], collapsed: true },
      a: { type: 'Nobody' },
      s: { type: 'SubTree', tree: 'Dock', children: ['s d'] },
      's d': { type: 'Sleep' },
    },
  };
  openDiagram(diagram);
  const facts = factsOf({
    diagram,
    inside: new Map([['s d', { tree: 'Dock', node: 'd' }]]),
    vocabulary: useProjectStore.getState().vocabulary,
    problems: new Map([
      ['a', { source: 'server', severity: 'error', node: 'a', code: '', message: '', hint: '' }],
      ['f', { source: 'server', severity: 'warning', node: 'f', code: '', message: '', hint: '' }],
    ]),
    selection: new Set(['f']),
  });
  expect(facts.get('a')).toMatchObject({ key: 'Main/a', family: null, hasError: true, isSelected: false });
  expect(facts.get('f')).toMatchObject({ family: 'decorator', hasError: false, isSelected: true });
  expect(facts.get('s d')?.key).toBe('Dock/d');
});
