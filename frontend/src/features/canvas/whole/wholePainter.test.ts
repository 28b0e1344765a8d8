import { describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import type { Part } from '@/model/nested';
import type { ShownStatus } from '@/store/moment/statusPainter';
import type { Facts } from './facts';
import { drawCells, together, type Picture } from './wholePainter';

const shown = (status: NodeStatus, more: Partial<ShownStatus> = {}): ShownStatus => ({
  status,
  past: undefined,
  flash: undefined,
  hasFault: false,
  ...more,
});

describe('together', () => {
  it('shows what runs before what has ended, and a fault always', () => {
    expect(together([shown('SUCCESS'), shown('RUNNING'), shown('FAILURE')]).status).toBe('RUNNING');
    expect(together([shown('SUCCESS'), shown('IDLE'), shown('FAILURE')]).status).toBe('FAILURE');
    expect(together([shown('RUNNING'), shown('IDLE', { hasFault: true })]).hasFault).toBe(true);
    expect(together([])).toEqual(shown('IDLE'));
  });

  it('shows the last tick only while all are idle', () => {
    const past = shown('IDLE', { past: 'SUCCESS' });
    expect(together([past, shown('IDLE')])).toMatchObject({ status: 'IDLE', past: 'SUCCESS' });
    expect(together([past, shown('RUNNING')])).toMatchObject({ status: 'RUNNING', past: undefined });
  });
});

describe('drawCells', () => {
  const fact = (id: string, more: Partial<Facts> = {}): Facts => ({
    id,
    key: `Main/${id}`,
    node: { type: 'Sleep' },
    family: 'action',
    hasError: false,
    isSelected: false,
    ...more,
  });
  const parts: Part[] = [
    {
      id: 'r',
      box: { x: 0, y: 0, width: 100, height: 50 },
      title: 20,
      level: 1,
      piece: { box: { x: 4, y: 20, width: 20, height: 20 }, blocks: ['a', 'b', 'c'], columns: 2, cell: 10 },
    },
  ];

  function draw(statuses: Record<string, ShownStatus>, more: Partial<Picture> = {}) {
    const drawn: { what: 'fill' | 'ring'; color: string; alpha: number; box: number[] }[] = [];
    const context = {
      fillStyle: '',
      strokeStyle: '',
      lineWidth: 0,
      globalAlpha: 1,
      fillRect: (...box: number[]) =>
        drawn.push({ what: 'fill', color: context.fillStyle, alpha: context.globalAlpha, box }),
      strokeRect: (...box: number[]) =>
        drawn.push({ what: 'ring', color: context.strokeStyle, alpha: context.globalAlpha, box }),
    };
    drawCells(context as unknown as CanvasRenderingContext2D, {
      parts,
      facts: new Map(['a', 'b', 'c'].map((id) => [id, fact(id)])),
      marks: new Map(),
      hits: new Set(),
      statusOf: (key) => statuses[key] ?? shown('IDLE'),
      colorOf: (token) => token,
      ...more,
    });
    return drawn;
  }

  it('draws each block in its cell, in the colour of its status, or pale in that of its family', () => {
    const drawn = draw({ 'Main/a': shown('RUNNING'), 'Main/b': shown('IDLE', { past: 'FAILURE' }) });
    expect(drawn.map(({ color }) => color)).toEqual(['running-bright', 'failure-bright', 'action']);
    expect(drawn.map(({ alpha }) => alpha < 1)).toEqual([false, false, true]);
    const starts = drawn.map(({ box: [x = 0, y = 0] }) => [Math.floor(x), Math.floor(y)]);
    expect(starts).toEqual([
      [4, 20],
      [14, 20],
      [4, 30],
    ]);
  });

  it('rings what is selected, found, different or wrong', () => {
    const drawn = draw(
      {},
      {
        facts: new Map([
          ['a', fact('a', { isSelected: true })],
          ['b', fact('b', { hasError: true })],
          ['c', fact('c', { node: { type: 'Sleep', color: '#123456' } })],
        ]),
        marks: new Map([['c', 'added']]),
      },
    );
    const rings = drawn.filter(({ what }) => what === 'ring').map(({ color }) => color);
    expect(rings).toEqual(['accent', 'failure-bright', 'success']);
    expect(drawn.some(({ color }) => color === '#123456')).toBe(true);
    expect(draw({}, { hits: new Set(['b']) }).filter(({ what }) => what === 'ring')).toHaveLength(1);
  });
});
