import { act, fireEvent, screen } from '@testing-library/react';
import { readFileSync } from 'node:fs';
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { Engine } from '@/store/recording/engine';
import { liveSource } from '@/store/recording/liveSource';
import type { EngineLink } from '@/store/recording/recordedRun';
import { followPresent, setEngineLink } from '@/store/moment/looking';
import { useMoment } from '@/store/moment/store';
import { initialSession } from '@/store/session/reduce';
import { useSessionStore } from '@/store/session/store';
import { segmentOf } from '../../../harness/runs';
import { TimeAxis } from './TimeAxis';

const file = new Uint8Array(readFileSync('../tests/executor/recorder/samples/v1.mcap'));
const segment = segmentOf({ to_t: 1, bytes: file.length });

let stop = () => {};

beforeEach(() => {
  vi.stubGlobal(
    'ResizeObserver',
    class {
      observe() {}
      disconnect() {}
      unobserve() {}
    },
  );
  vi.spyOn(liveSource, 'read').mockImplementation((_, offset, length) =>
    Promise.resolve(file.slice(offset, offset + length)),
  );
  setEngineLink(() => {
    const link: EngineLink = { post: (message) => engine.receive(message), onMessage: () => {} };
    const engine = new Engine((message) => queueMicrotask(() => act(() => link.onMessage(message))));
    return link;
  });
  stop = followPresent();
});

afterEach(() => {
  act(() => {
    stop();
    useSessionStore.setState(initialSession, true);
  });
  vi.unstubAllGlobals();
});

function axis() {
  act(() => useSessionStore.setState({ segments: [segment] }));
  show(<TimeAxis />);
  const strip = screen.getByRole('slider');
  const shown = (t: string) =>
    vi.waitFor(() => expect(screen.getByTestId('time-axis').getAttribute('data-shown')).toBe(t));
  return { strip, shown };
}

it('is not there without a recording', () => {
  show(<TimeAxis />);
  expect(screen.queryByTestId('time-axis')).toBeNull();
});

it('shows the place of the pointer, and the present by its button', async () => {
  const { strip, shown } = axis();
  strip.getBoundingClientRect = () => ({ left: 100, width: 400 }) as DOMRect;
  fireEvent.pointerDown(strip, { button: 0, clientX: 300 });
  await shown('0.500');
  expect(strip.getAttribute('aria-valuetext')).toBe('0.50 s of 1.0 s');
  fireEvent.pointerMove(strip, { buttons: 1, clientX: 400 });
  await shown('0.750');
  await user.click(screen.getByRole('button', { name: 'Live' }));
  expect(useMoment.getState().t).toBeNull();
  expect(strip.getAttribute('aria-valuetext')).toBe('the present, 1.0 s');
});

it('is led by keys', async () => {
  const { strip, shown } = axis();
  strip.focus();
  await user.keyboard('{Home}');
  await shown('0.000');
  await user.keyboard('{Shift>}{ArrowRight}{/Shift}');
  await shown('1.000');
  await user.keyboard('{ArrowLeft}');
  await vi.waitFor(() => expect(useMoment.getState().shown!.t).toBeLessThan(1));
  await user.keyboard('{Escape}');
  expect(useMoment.getState().t).toBeNull();
});

it('goes to a mark', async () => {
  const text = 'robot bumped into a crate';
  const line = { source: 'world' as const, level: 'warning' as const, text, time: 0.25, id: 1 };
  act(() => useSessionStore.setState({ logs: [{ ...line, node_id: '', node_path: '', launch_node: '' }] }));
  const { shown } = axis();
  await user.click(screen.getByRole('button', { name: `Collision at 0.25 s: ${text}` }));
  await shown('0.250');
});
