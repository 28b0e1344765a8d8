import { render } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { TreePicture } from './TreePicture';

const draw = (diagram: unknown) => render(<TreePicture diagram={diagram} />).container;

const tree = (nodes: Readonly<Record<string, unknown>>, layout?: string) => ({
  format: 'bt-studio/diagram',
  version: 1,
  id: 'Main',
  root: Object.keys(nodes)[0] ?? null,
  nodes,
  drafts: [],
  ...(layout ? { layout } : {}),
});

const pair = { a: { type: 'Sequence', children: ['b'] }, b: { type: 'AlwaysSuccess' } };
const numbers = (text: string | null | undefined) => (text ?? '').match(/-?[\d.]+/g)?.map(Number) ?? [];
const boxes = (host: HTMLElement) =>
  [...host.querySelectorAll('rect')].map((rect) => ({
    x: Number(rect.getAttribute('x')),
    y: Number(rect.getAttribute('y')),
    width: Number(rect.getAttribute('width')),
    height: Number(rect.getAttribute('height')),
    radius: Number(rect.getAttribute('rx')),
    fill: rect.getAttribute('fill'),
  }));

describe('TreePicture', () => {
  it('draws each block in the colour of its family', () => {
    const nodes = {
      a: { type: 'Sequence', children: ['b', 'c', 'd', 'e'] },
      b: { type: 'ScriptCondition' },
      c: { type: 'Inverter' },
      d: { type: 'MyOwnAction' },
      e: { type: 'SubTree', tree: 'Other' },
    };
    const found = boxes(draw(tree(nodes)));
    expect(found.map(({ fill }) => fill)).toEqual([
      'var(--bts-control)',
      'var(--bts-condition)',
      'var(--bts-decorator)',
      'var(--bts-action)',
      'var(--bts-subtree)',
    ]);
    expect(found.map(({ radius, height }) => (radius === 10 ? 10 : radius / height))).toEqual([
      10, 0.5, 10, 10, 10,
    ]);
  });

  it('shows all blocks, with a margin', () => {
    const host = draw(tree(pair, 'vertical'));
    const [a, b] = boxes(host);
    const [x = 0, y = 0, width = 0, height = 0] = numbers(host.querySelector('svg')?.getAttribute('viewBox'));
    if (!a || !b) throw new Error('Two blocks are missing.');
    expect([x, y]).toEqual([Math.min(a.x, b.x) - 16, a.y - 16]);
    expect(x + width).toBe(Math.max(a.x + a.width, b.x + b.width) + 16);
    expect(y + height).toBe(b.y + b.height + 16);
  });

  it.each([
    ['vertical', 'the lower edge'],
    ['horizontal', 'the right edge'],
  ])('joins the blocks of %s trees at %s', (layout) => {
    const host = draw(tree(pair, layout));
    const [a, b] = boxes(host);
    if (!a || !b) throw new Error('Two blocks are missing.');
    const isVertical = layout === 'vertical';
    const start = isVertical ? [a.x + a.width / 2, a.y + a.height] : [a.x + a.width, a.y + a.height / 2];
    const end = isVertical ? [b.x + b.width / 2, b.y] : [b.x, b.y + b.height / 2];
    const middle = isVertical ? ((start[1] ?? 0) + (end[1] ?? 0)) / 2 : ((start[0] ?? 0) + (end[0] ?? 0)) / 2;
    const bends = isVertical ? [start[0], middle, end[0], middle] : [middle, start[1], middle, end[1]];
    expect(numbers(host.querySelector('path')?.getAttribute('d'))).toEqual([...start, ...bends, ...end]);
  });

  it('ignores manual positions', () => {
    const [a] = boxes(draw(tree({ a: { type: 'Sequence', position: [5000, 5000] } })));
    expect([a?.x, a?.y]).toEqual([0, 0]);
  });

  it.each([
    ['cannot be read', { nodes: 3 }],
    ['is missing', null],
    ['is empty', tree({})],
  ])('shows a placeholder if a diagram %s', (_, diagram) => {
    const host = draw(diagram);
    expect(host.querySelector('svg')).toBeNull();
    expect(host.querySelector('div')).toHaveAttribute('aria-hidden', 'true');
  });
});
