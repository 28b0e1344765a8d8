import { render } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import type { Diagram, DiagramNode } from '@/model/diagram';
import type { Box } from '@/model/layout';
import { makeVocabulary, type NodeSpec } from '@/model/vocabulary';
import { TreeImage } from './TreeImage';

const port = (name: string, value: string | null) => ({
  name,
  direction: 'input' as const,
  type: 'string',
  default: value,
  required: false,
  description: '',
});

const spec = (type: string, family: NodeSpec['family'], more: Partial<NodeSpec> = {}): NodeSpec => ({
  type,
  family,
  symbol: '',
  minChildren: 0,
  maxChildren: Infinity,
  ports: [],
  summary: '',
  open: false,
  source: 'builtin',
  ...more,
});

const vocabulary = makeVocabulary([
  spec('Sequence', 'control'),
  spec('Go', 'action', { ports: [port('speed', '0.3'), port('goal', null)] }),
  spec('SubTree', 'subtree'),
]);

function draw(
  nodes: Readonly<Record<string, DiagramNode>>,
  positions: Readonly<Record<string, Box>>,
  layout: Diagram['layout'] = 'vertical',
) {
  const diagram = {
    id: 'Patrol',
    root: Object.keys(nodes)[0] ?? null,
    nodes,
    drafts: [],
    layout,
  } as unknown as Diagram;
  const { container } = render(
    <TreeImage
      diagram={diagram}
      layout={{ positions, width: 0, height: 0 }}
      vocabulary={vocabulary}
      palette={(name) => name}
    />,
  );
  return container.querySelector('svg') as SVGSVGElement;
}

const box = (x: number, y: number, width = 140, height = 44): Box => ({ x, y, width, height });
/** Returns the texts of a drawing, each with its place, size and colour. */
const texts = (svg: SVGSVGElement) =>
  [...svg.querySelectorAll('text')].map((text) =>
    [
      text.textContent,
      text.getAttribute('x'),
      text.getAttribute('y'),
      text.getAttribute('font-size'),
      text.getAttribute('fill'),
    ].join(' '),
  );
const edges = (svg: SVGSVGElement) =>
  [...svg.querySelectorAll('path[stroke="edge"]')].map((path) => path.getAttribute('d'));

describe('TreeImage', () => {
  it('contains its blocks with a margin', () => {
    const svg = draw(
      { a: { type: 'Sequence' }, b: { type: 'Go' } },
      { a: box(0, 0), b: box(-50, 100, 200, 60) },
    );
    expect(svg.getAttribute('viewBox')).toBe('-74 -24 248 208');
    expect([svg.getAttribute('width'), svg.getAttribute('height')]).toEqual(['248', '208']);
    const ground = svg.querySelector('rect');
    expect(['x', 'y', 'width', 'height', 'fill'].map((name) => ground?.getAttribute(name))).toEqual([
      '-74',
      '-24',
      '248',
      '208',
      'canvas',
    ]);
    expect(svg.querySelector('title')?.textContent).toBe('Patrol');
  });

  it('has a size even without blocks', () => {
    expect(draw({}, {}).getAttribute('viewBox')).toBe('-24 -24 48 48');
  });

  it('names a block, its type and its ports', () => {
    const node = { type: 'Go', name: 'to the door', ports: { goal: '{goal}' } };
    const svg = draw({ a: node }, { a: box(10, 20, 200, 100) });
    expect(texts(svg)).toEqual([
      'to the door 54 20 14 text',
      'Go 54 35 11.5 muted',
      'speed 54 57 12 muted',
      '0.3 188 57 11.5 muted',
      'goal 54 79 12 muted',
      '{goal} 188 79 11.5 text',
    ]);
    expect(svg.querySelector('g')?.getAttribute('transform')).toBe('translate(10 20)');
  });

  it('shows a dash for a port without a value, and cuts a long value', () => {
    const svg = draw({ a: { type: 'Go', ports: { speed: 'x'.repeat(17) } } }, { a: box(0, 0, 300, 100) });
    expect(texts(svg)).toEqual([
      'Go 54 27 14 text',
      'speed 54 57 12 muted',
      `${'x'.repeat(15)}… 288 57 11.5 text`,
      'goal 54 79 12 muted',
      '— 288 79 11.5 muted',
    ]);
    const whole = draw({ a: { type: 'Go', ports: { speed: 'x'.repeat(16) } } }, { a: box(0, 0, 300, 100) });
    expect(texts(whole)[2]).toContain('x'.repeat(16));
  });

  it('shows no more ports than a block has room for', () => {
    const ports = Object.fromEntries(Array.from({ length: 9 }, (_, index) => [`p${index}`, 'v']));
    const svg = draw({ a: { type: 'Unknown', ports } }, { a: box(0, 0, 200, 300) });
    expect(texts(svg).filter((text) => text.startsWith('p'))).toHaveLength(6);
  });

  it('cuts a name that is too wide', () => {
    const name = 'a very long name of a block indeed';
    const [text] = texts(draw({ a: { type: 'Go', name } }, { a: box(0, 0, 140) }));
    const words = text?.slice(0, text.indexOf('…'));
    expect(text).toContain('…');
    expect(name.startsWith(words ?? '?')).toBe(true);
    expect(words?.length).toBeGreaterThan(5);
    expect(words?.length).toBeLessThan(15);
  });

  it('shows only the tree of a subtree', () => {
    expect(texts(draw({ a: { type: 'SubTree', tree: 'Dock' } }, { a: box(0, 0) }))).toEqual([
      'Dock 54 27 14 text',
    ]);
  });

  it('has the colour of the family, or that of the block', () => {
    const tile = (node: DiagramNode) => {
      const svg = draw({ a: node }, { a: box(0, 0) });
      return [
        svg.querySelector('rect[clip-path]')?.getAttribute('fill'),
        svg.querySelector('path[stroke-width]')?.getAttribute('stroke'),
      ];
    };
    expect(tile({ type: 'Go' })).toEqual(['action', 'action']);
    expect(tile({ type: 'Sequence', color: '#123456' })).toEqual(['#123456', 'control']);
    expect(tile({ type: 'Nobody' })).toEqual(['unknown', 'unknown']);
  });

  it('draws disabled blocks pale', () => {
    const svg = draw(
      { a: { type: 'Go', disabled: true }, b: { type: 'Go' } },
      { a: box(0, 0), b: box(200, 0) },
    );
    expect([...svg.querySelectorAll('g[opacity]')].map((block) => block.getAttribute('opacity'))).toEqual([
      '0.45',
      '1',
    ]);
  });

  it('draws edges from parents to children, downwards or to the right', () => {
    const nodes = { a: { type: 'Sequence', children: ['b'] }, b: { type: 'Go' } };
    expect(edges(draw(nodes, { a: box(0, 0), b: box(0, 100) }))).toEqual(['M70 44L70 100']);
    expect(edges(draw(nodes, { a: box(0, 0), b: box(200, 0) }, 'horizontal'))).toEqual(['M140 22L200 22']);
  });

  it('draws nothing below a folded block', () => {
    const nodes = { a: { type: 'Sequence', children: ['b'], collapsed: true }, b: { type: 'Go' } };
    expect(edges(draw(nodes, { a: box(0, 0) }))).toEqual([]);
    expect(texts(draw(nodes, { a: box(0, 0) }))).toEqual(['Sequence 54 27 14 text']);
  });
});
