import { beforeEach, describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import type { ShownStatus } from '@/store/moment/statusPainter';
import { blockPainter } from './blockPainter';

let block: HTMLElement;
let mark: HTMLElement;
let paint: (shown: ShownStatus) => void;

beforeEach(() => {
  block = document.createElement('div');
  mark = document.createElement('span');
  paint = blockPainter(block, mark);
});

const shown = (status: NodeStatus, more: Partial<ShownStatus> = {}): ShownStatus => ({
  status,
  past: undefined,
  flash: undefined,
  hasFault: false,
  ...more,
});
const flashOf = (status: NodeStatus, count = 1) => ({ status, count, since: 0 });

describe('blockPainter', () => {
  it.each(['RUNNING', 'SUCCESS', 'FAILURE', 'SKIPPED'] as const)('shows %s with an icon', (status) => {
    paint(shown(status));
    expect({ ...block.dataset }).toEqual({ status });
    expect({ ...mark.dataset }).toEqual({ status });
    expect(mark.querySelectorAll('svg path')).toHaveLength(1);
  });

  it('shows nothing while the node is idle', () => {
    paint(shown('RUNNING'));
    paint(shown('IDLE'));
    expect({ ...block.dataset }).toEqual({ status: 'IDLE' });
    expect({ ...mark.dataset }).toEqual({});
    expect(mark.childNodes).toHaveLength(0);
  });

  it('shows a status that an idle node had within the last tick, fading', () => {
    paint(shown('IDLE', { flash: flashOf('FAILURE') }));
    expect(block.dataset['flash']).toBe('FAILURE');
    expect({ ...mark.dataset }).toEqual({ status: 'FAILURE', passing: '' });
  });

  it('starts the animation again with each flash, also of the same status', () => {
    const beats = [1, 3, 5].map((count) => {
      paint(shown('IDLE', { flash: flashOf('FAILURE', count) }));
      return block.dataset['beat'];
    });
    expect(beats[0]).not.toBe(beats[1]);
    expect(beats[0]).toBe(beats[2]);
    paint(shown('IDLE'));
    expect(block.dataset).not.toHaveProperty('beat');
    expect(block.dataset).not.toHaveProperty('flash');
  });

  it('shows the last tick at rest while the node is idle', () => {
    paint(shown('IDLE', { past: 'FAILURE', flash: flashOf('SUCCESS') }));
    expect(block.dataset['past']).toBe('FAILURE');
    expect({ ...mark.dataset }).toEqual({ status: 'FAILURE', past: '' });
  });

  it('marks a fault as a failure, whatever the status is', () => {
    paint(shown('SUCCESS', { hasFault: true }));
    expect(block.dataset['status']).toBe('SUCCESS');
    expect({ ...mark.dataset }).toEqual({ status: 'FAILURE' });
  });

  it('does not touch what is right', async () => {
    paint(shown('RUNNING'));
    const icon = mark.firstChild;
    paint(shown('RUNNING', { flash: flashOf('RUNNING') }));
    expect(mark.firstChild).toBe(icon);
  });
});
