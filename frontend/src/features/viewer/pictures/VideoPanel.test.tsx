import { act, fireEvent, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { streams, type StreamOptions } from '@/store/session/streams';
import { show } from '../../../../harness/testing';
import { panned, poseOf, START, turned, zoomed, type Orbit } from './orbit';
import { VideoPanel } from './VideoPanel';

let wanted: StreamOptions | null = null;
let resize: (width: number) => void = () => undefined;

beforeEach(() => {
  wanted = null;
  vi.useFakeTimers();
  streams.connect((stream, options) => {
    if (stream === 'view') wanted = options;
  });
  vi.stubGlobal(
    'ResizeObserver',
    class {
      constructor(callback: (entries: { contentRect: { width: number } }[]) => void) {
        resize = (width) => callback([{ contentRect: { width } }]);
      }
      observe(): void {}
      unobserve(): void {}
      disconnect(): void {}
    },
  );
  onTestFinished(() => {
    streams.disconnect();
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });
});

function panel() {
  const { unmount } = show(<VideoPanel />);
  return { view: screen.getByTestId('viewer-video'), unmount };
}

/** Returns the options that are requested from the server after a gesture. */
function sent(): StreamOptions | null {
  act(() => {
    vi.advanceTimersByTime(60);
  });
  return wanted;
}

const looksFrom = (orbit: Orbit) => ({ max_hz: 30, width: 640, camera_pose: poseOf(orbit) });
/** Moves the pointer over the view; jsdom's pointer events have no movement. */
function drag(view: HTMLElement, x: number, y: number, more: object = {}): void {
  const event = new PointerEvent('pointermove', { bubbles: true, buttons: 1, ...more });
  Object.defineProperties(event, { movementX: { value: x }, movementY: { value: y } });
  fireEvent(view, event);
}

describe('the world drawn by the server', () => {
  it('subscribes from the initial direction, and ends with the panel', () => {
    const { view, unmount } = panel();
    expect(wanted).toEqual(looksFrom(START));
    expect(view).toHaveAccessibleName('The world, drawn by the server; drag to turn, scroll to zoom');
    expect(view.tabIndex).toBe(0);
    unmount();
    expect(wanted).toBeNull();
  });

  it('is explained if there is no WebGL', () => {
    panel();
    expect(screen.getByText(/This browser has no WebGL.*Press Run to start the world\./)).toBeInTheDocument();
  });

  it.each([
    ['ArrowLeft', turned(START, -24, 0)],
    ['ArrowRight', turned(START, 24, 0)],
    ['ArrowUp', turned(START, 0, 24)],
    ['ArrowDown', turned(START, 0, -24)],
    ['+', zoomed(START, 0.85)],
    ['-', zoomed(START, 1.18)],
  ])('is turned and zoomed with %s', (key, orbit) => {
    const { view } = panel();
    expect(fireEvent.keyDown(view, { key })).toBe(false);
    expect(sent()).toEqual(looksFrom(orbit));
  });

  it('ignores other keys, and those of elements above it', () => {
    const { view } = panel();
    expect(fireEvent.keyDown(view, { key: 'x' })).toBe(true);
    const above = document.createElement('button');
    view.append(above);
    expect(fireEvent.keyDown(above, { key: 'ArrowLeft' })).toBe(true);
    expect(sent()).toEqual(looksFrom(START));
    above.remove();
  });

  it('is turned by dragging, and moved with Shift or another button', () => {
    const { view } = panel();
    const capture = vi.spyOn(view, 'setPointerCapture');
    fireEvent.pointerDown(view, { pointerId: 3 });
    expect(capture).toHaveBeenCalledExactlyOnceWith(3);
    drag(view, 10, 5);
    const after = turned(START, 10, 5);
    expect(sent()).toEqual(looksFrom(after));
    drag(view, 10, 5, { shiftKey: true });
    const moved = panned(after, 10, 5);
    expect(sent()).toEqual(looksFrom(moved));
    drag(view, 4, 0, { buttons: 2 });
    expect(sent()).toEqual(looksFrom(panned(moved, 4, 0)));
  });

  it('stays if no button is pressed', () => {
    const { view } = panel();
    drag(view, 10, 5, { buttons: 0 });
    expect(sent()).toEqual(looksFrom(START));
  });

  it('is zoomed with the wheel, without scrolling the page', () => {
    const { view } = panel();
    expect(fireEvent.wheel(view, { deltaY: 100 })).toBe(false);
    expect(sent()).toEqual(looksFrom(zoomed(START, Math.exp(0.1))));
    expect(fireEvent.contextMenu(view)).toBe(false);
  });

  it('sends a gesture every 60 ms, with all movement until then', () => {
    const { view } = panel();
    fireEvent.keyDown(view, { key: 'ArrowLeft' });
    fireEvent.keyDown(view, { key: 'ArrowLeft' });
    act(() => {
      vi.advanceTimersByTime(59);
    });
    expect(wanted).toEqual(looksFrom(START));
    act(() => {
      vi.advanceTimersByTime(1);
    });
    expect(wanted).toEqual(looksFrom(turned(turned(START, -24, 0), -24, 0)));
  });

  it.each([
    [500, 640],
    [640, 640],
    [700, 960],
    [1200, 1280],
    [3000, 1280],
  ])('requests for a panel of %s pixels pictures of %s', (width, picture) => {
    const { view } = panel();
    fireEvent.keyDown(view, { key: '+' });
    sent();
    act(() => resize(width));
    expect(wanted).toEqual({ ...looksFrom(zoomed(START, 0.85)), width: picture });
  });

  it('counts the pixels of a high-resolution screen', () => {
    panel();
    vi.stubGlobal('devicePixelRatio', 2);
    act(() => resize(400));
    expect(wanted?.width).toBe(960);
  });
});
