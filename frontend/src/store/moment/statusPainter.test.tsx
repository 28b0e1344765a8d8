import { act } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { useLiveStore, usePastLive } from '@/store/project/live';
import type { Moment } from '@/store/recording/types';
import { show } from '../../../harness/testing';
import {
  onStatuses,
  paintStatus,
  shownStatus,
  usePaintedStatus,
  write,
  type ShownStatus,
} from './statusPainter';
import { atPresent, useMoment } from './store';

const statuses = (of: Record<string, NodeStatus>) => ({ statuses: new Map(Object.entries(of)) });
const looksBack = (isBack: boolean) => useMoment.setState({ shown: isBack ? ({ t: 1 } as Moment) : null });

beforeEach(() => {
  useMoment.setState(atPresent, true);
  useLiveStore.getState().clear();
  usePastLive.getState().clear();
});

describe('paintStatus', () => {
  it('paints now, and then only the blocks that changed', () => {
    const [a, b] = [vi.fn(), vi.fn()];
    paintStatus('Main/a', a);
    const stop = paintStatus('Main/b', b);
    expect(a).toHaveBeenLastCalledWith(expect.objectContaining({ status: 'IDLE', hasFault: false }));
    useLiveStore.setState(statuses({ 'Main/b': 'RUNNING' }));
    expect(a).toHaveBeenCalledTimes(1);
    expect(b).toHaveBeenLastCalledWith(expect.objectContaining({ status: 'RUNNING' }));
    stop();
    useLiveStore.setState(statuses({}));
    expect(b).toHaveBeenCalledTimes(2);
  });

  it('paints each element of a block, and again after all have gone', () => {
    const [block, row] = [vi.fn(), vi.fn()];
    const stops = [paintStatus('Main/a', block), paintStatus('Main/a', row)];
    useLiveStore.setState(statuses({ 'Main/a': 'SUCCESS' }));
    expect(row).toHaveBeenLastCalledWith(expect.objectContaining({ status: 'SUCCESS' }));
    stops.forEach((stop) => stop());
    const again = vi.fn();
    paintStatus('Main/a', again);
    stops.forEach((stop) => stop());
    useLiveStore.setState(statuses({}));
    expect(again).toHaveBeenLastCalledWith(expect.objectContaining({ status: 'IDLE' }));
    expect(block).toHaveBeenCalledTimes(2);
  });

  it('shows the moment at which the user looks, and the present again', () => {
    const paint = vi.fn<(shown: ShownStatus) => void>();
    paintStatus('Main/a', paint);
    useLiveStore.setState(statuses({ 'Main/a': 'RUNNING' }));
    usePastLive.setState(statuses({ 'Main/a': 'FAILURE' }));
    expect(paint).toHaveBeenCalledTimes(2);
    looksBack(true);
    expect(paint.mock.lastCall?.[0].status).toBe('FAILURE');
    useLiveStore.setState(statuses({ 'Main/a': 'SUCCESS' }));
    expect(paint).toHaveBeenCalledTimes(3);
    looksBack(false);
    expect(paint.mock.lastCall?.[0].status).toBe('SUCCESS');
  });

  it('tells of a status of the last tick, a fault and a flash', () => {
    const flash = { status: 'SUCCESS', count: 1, since: 0 } as const;
    const changed = vi.fn();
    const stop = onStatuses(changed);
    useLiveStore.setState({
      past: new Map([['Main/a', 'FAILURE']]),
      flashes: new Map([['Main/a', flash]]),
      faults: new Map([['Main/a', 'It broke.']]),
    });
    expect(shownStatus('Main/a')).toEqual({ status: 'IDLE', past: 'FAILURE', flash, hasFault: true });
    expect(changed).toHaveBeenCalledTimes(1);
    stop();
    useLiveStore.setState({ past: new Map() });
    expect(changed).toHaveBeenCalledTimes(1);
  });
});

const paint = (element: Element, { status }: ShownStatus) => write(element, 'data-status', status);

function Row({ of }: { readonly of: string }) {
  return <p ref={usePaintedStatus<HTMLParagraphElement>(of, paint)} />;
}

describe('usePaintedStatus', () => {
  it('paints its element without rendering it, and follows another block', () => {
    useLiveStore.setState(statuses({ 'Main/b': 'RUNNING' }));
    const { container, rerender } = show(<Row of="Main/a" />);
    const row = container.querySelector('p');
    expect(row).toHaveAttribute('data-status', 'IDLE');
    act(() => useLiveStore.setState(statuses({ 'Main/a': 'FAILURE', 'Main/b': 'RUNNING' })));
    expect(row).toHaveAttribute('data-status', 'FAILURE');
    rerender(<Row of="Main/b" />);
    expect(row).toHaveAttribute('data-status', 'RUNNING');
  });
});

it('removes an attribute without a value', () => {
  const element = document.createElement('i');
  write(element, 'data-past', 'SUCCESS');
  expect(element).toHaveAttribute('data-past', 'SUCCESS');
  write(element, 'data-past', undefined);
  expect(element).not.toHaveAttribute('data-past');
});
