import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import type { ShownStatus } from '@/store/moment/statusPainter';
import type { BlockNode, TreeEdge } from '../flow';
import { drawTiny, pathsOf, type TinyTree, type View } from './tinyTree';

class RecordedPath {
  readonly paths: string[];
  constructor(path = '') {
    this.paths = path === '' ? [] : [path];
  }
  addPath(other: RecordedPath): void {
    this.paths.push(...other.paths);
  }
}

interface Drawn {
  readonly what: 'fill' | 'ring' | 'lines';
  readonly color: string;
  readonly box?: readonly number[];
  readonly paths?: readonly string[];
}

function recordingContext() {
  const drawn: Drawn[] = [];
  const context = {
    fillStyle: '',
    strokeStyle: '',
    lineWidth: 0,
    save: vi.fn(),
    restore: vi.fn(),
    translate: vi.fn(),
    scale: vi.fn(),
    fillRect: (...box: number[]) => drawn.push({ what: 'fill', color: context.fillStyle, box }),
    strokeRect: (...box: number[]) => drawn.push({ what: 'ring', color: context.strokeStyle, box }),
    stroke: ({ paths }: RecordedPath) => drawn.push({ what: 'lines', color: context.strokeStyle, paths }),
  };
  return { context: context as unknown as CanvasRenderingContext2D, drawn };
}

const block = (
  id: string,
  x: number,
  y: number,
  more: Partial<BlockNode> = {},
  data: object = {},
): BlockNode =>
  ({
    id,
    position: { x, y },
    width: 200,
    height: 50,
    data: { tree: 'Main', node: { type: 'Sleep' }, spec: { family: 'action' }, inside: null, ...data },
    ...more,
  }) as unknown as BlockNode;
const nodes = [block('a', 0, 0), block('b', 100, 100), block('c', 400, 100)];
const edges = ['b', 'c'].map(
  (target) => ({ id: target, source: 'a', target, data: { isHorizontal: false } }) as unknown as TreeEdge,
);

const shown = (status: NodeStatus, more: Partial<ShownStatus> = {}): ShownStatus => ({
  status,
  past: undefined,
  flash: undefined,
  hasFault: false,
  ...more,
});

function draw(view: View, statuses: Record<string, ShownStatus>, more: Partial<TinyTree> = {}) {
  const { context, drawn } = recordingContext();
  const tree: TinyTree = {
    nodes,
    edges,
    marks: new Map(),
    statusOf: (key) => statuses[key] ?? shown('IDLE'),
    colorOf: (token) => token,
    ...more,
  };
  drawTiny(context, tree, pathsOf(tree), view);
  return {
    fills: drawn.filter(({ what }) => what === 'fill'),
    rings: drawn.filter(({ what }) => what === 'ring'),
    lines: Object.fromEntries(drawn.filter((d) => d.what === 'lines').map((d) => [d.color, d.paths])),
  };
}

beforeEach(() => void vi.stubGlobal('Path2D', RecordedPath));

describe('drawTiny', () => {
  it('draws each block at its place of the view, at least a pixel wide and two high', () => {
    const { fills } = draw([10, 20, 0.001], {});
    expect(fills.map(({ box }) => box)).toEqual([
      [10, 20, 1, 2],
      [10.1, 20.1, 1, 2],
      [10.4, 20.1, 1, 2],
    ]);
    expect(fills.map(({ color }) => color)).toEqual(['action', 'action', 'action']);
  });

  it('colours a low block by its status, and rings a higher one', () => {
    const statuses = { 'Main/a': shown('RUNNING'), 'Main/b': shown('IDLE', { past: 'FAILURE' }) };
    const low = draw([0, 0, 0.01], statuses);
    expect(low.fills.map(({ color }) => color)).toEqual(['running-bright', 'failure-bright', 'action']);
    expect(low.rings).toEqual([]);
    const high = draw([0, 0, 0.14], statuses);
    expect(high.fills.map(({ color }) => color)).toEqual(['action', 'action', 'action']);
    expect(high.rings.map(({ color }) => color)).toEqual(['running-bright', 'failure-bright']);
  });

  it('draws a fault as a failure, and a line in the status of its child', () => {
    const { fills, lines } = draw([0, 0, 0.01], {
      'Main/b': shown('IDLE', { hasFault: true }),
      'Main/c': shown('SUCCESS'),
    });
    expect(fills[1]?.color).toBe('failure-bright');
    expect([lines['failure-bright']?.length, lines['success-bright']?.length]).toEqual([1, 1]);
    expect(lines['edge']).toEqual([]);
  });

  it('marks what is selected, and what changed since', () => {
    const selected = [block('a', 0, 0, { selected: true }), ...nodes.slice(1)];
    const { rings } = draw([0, 0, 0.01], {}, { nodes: selected, marks: new Map([['b', 'removed']]) });
    expect(rings.map(({ color }) => color)).toEqual(['accent', 'failure']);
  });

  it('takes the status of a block inside of a subtree from there, and the colour that a user chose', () => {
    const inside = block(
      'a',
      0,
      0,
      {},
      {
        inside: { tree: 'Dock', node: 'd' },
        node: { type: 'Sleep', color: '#123456' },
      },
    );
    expect(draw([0, 0, 0.01], {}, { nodes: [inside], edges: [] }).fills[0]?.color).toBe('#123456');
    const { fills } = draw([0, 0, 0.01], { 'Dock/d': shown('RUNNING') }, { nodes: [inside], edges: [] });
    expect(fills[0]?.color).toBe('running-bright');
  });

  it('has lines to the right in a left-right tree, and none to blocks that are not there', () => {
    const right = edges.map((edge) => ({ ...edge, data: { ...edge.data!, isHorizontal: true } }));
    const paths = pathsOf({ nodes: nodes.slice(0, 2), edges: right });
    expect([...paths.keys()]).toEqual(['b']);
    expect((paths.get('b') as unknown as RecordedPath).paths[0]).toMatch(/^M200 25/);
  });
});
