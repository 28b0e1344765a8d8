import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { trace } from '@/store/session/trace/trace';
import { runTree, treeNode } from '../../../harness/running';
import { TimelineView } from './TimelineView';

let view: TimelineView;
let following: boolean[];

beforeEach(() => {
  runTree([treeNode(1, 0, 'root')], { 1: [[1, 'RUNNING']] }, 100);
  view = new TimelineView();
  following = [];
  view.onFollowing = (isFollowing) => following.push(isFollowing);
});

describe('the span', () => {
  it('is the last half minute at first, and follows the run', () => {
    expect(view.span()).toEqual({ from: 70, to: 100 });
    trace.advance(110);
    expect(view.span()).toEqual({ from: 80, to: 110 });
  });

  it('stays where it was moved, until it reaches the present again', () => {
    view.pan(-0.5);
    expect(view.span()).toEqual({ from: 55, to: 85 });
    trace.advance(110);
    expect(view.span()).toEqual({ from: 55, to: 85 });
    expect(following).toEqual([false]);
    view.pan(-0.1);
    expect(following).toEqual([false]);
    view.pan(1);
    expect(view.span()).toEqual({ from: 80, to: 110 });
    expect(following).toEqual([false, true]);
  });

  it('begins with the run at the earliest', () => {
    view.pan(-50);
    expect(view.span()).toEqual({ from: 0, to: 30 });
  });

  it('zooms about the present, or about a place', () => {
    view.zoom(0.5);
    expect(view.span()).toEqual({ from: 85, to: 100 });
    expect(following).toEqual([]);
    view.zoom(0.5, 0);
    expect(view.span()).toEqual({ from: 85, to: 92.5 });
    expect(following).toEqual([false]);
  });

  it('is no longer than the run, and than the stored history', () => {
    view.zoom(1000);
    expect(view.span()).toEqual({ from: 0, to: 100 });
    trace.advance(5000);
    view.zoom(1000);
    expect(view.span()).toEqual({ from: 4400, to: 5000 });
  });

  it('shows all, and follows again', () => {
    view.pan(-0.5);
    view.follow();
    expect(view.span()).toEqual({ from: 70, to: 100 });
    expect(following).toEqual([false, true]);
    view.showAll();
    expect(view.span()).toEqual({ from: 0, to: 100 });
    expect(following).toEqual([false, true]);
  });
});

describe('the picture', () => {
  const rects: number[][] = [];
  let scale: number[] = [];
  let count = 0;
  const context = {
    clearRect: () => {
      count += 1;
      rects.length = 0;
    },
    setTransform: (...numbers: number[]) => {
      scale = numbers;
    },
    fillRect: (...box: number[]) => rects.push(box),
    fillText: () => undefined,
    save: () => undefined,
    restore: () => undefined,
    beginPath: () => undefined,
    rect: () => undefined,
    clip: () => undefined,
  };
  let canvas: HTMLCanvasElement;
  let scroller: HTMLElement;
  let detach: () => void;

  /** Advances the page's time; frames come every 16 ms. */
  const pass = (ms: number) => {
    const before = count;
    vi.advanceTimersByTime(ms);
    return count - before;
  };

  beforeEach(() => {
    vi.useFakeTimers();
    canvas = document.createElement('canvas');
    scroller = document.createElement('div');
    canvas.getContext = (() => context) as unknown as HTMLCanvasElement['getContext'];
    Object.defineProperty(canvas, 'clientWidth', { value: 300, configurable: true });
    Object.defineProperty(canvas, 'clientHeight', { value: 66 });
    view.setRows([1]);
    detach = view.attach(canvas, scroller);
    onTestFinished(() => {
      detach();
      vi.unstubAllGlobals();
      vi.useRealTimers();
    });
    pass(20);
  });

  it('shows the rows in the span', () => {
    // A second is 10 px wide; node 1 runs all the time, in the first row below the axis.
    expect(rects).toContainEqual([0, 25, 300, 18]);
    scroller.scrollTop = 10;
    view.redraw();
    pass(20);
    expect(rects).toContainEqual([0, 15, 300, 18]);
    view.setRows([]);
    pass(20);
    expect(rects).not.toContainEqual([0, 15, 300, 18]);
  });

  it('has the resolution of the screen', () => {
    expect([canvas.width, canvas.height]).toEqual([300, 66]);
    vi.stubGlobal('devicePixelRatio', 2);
    view.redraw();
    pass(20);
    expect([canvas.width, canvas.height]).toEqual([600, 132]);
    expect(scale).toEqual([2, 0, 0, 2, 0, 0]);
  });

  it('is drawn once a frame, however often it changes', () => {
    view.redraw();
    view.pan(-0.1);
    view.zoom(0.9);
    view.setRows([1]);
    expect(pass(20)).toBe(1);
  });

  it('is drawn with the run, at most ten times a second, and not while it is paused', () => {
    pass(200);
    trace.advance(101);
    trace.advance(102);
    expect(pass(120)).toBe(1);
    expect(pass(1000)).toBe(0);
  });

  it('is drawn when the theme changes', async () => {
    pass(200);
    document.documentElement.setAttribute('data-mantine-color-scheme', 'dark');
    // Observers of the document are notified in a microtask.
    await Promise.resolve();
    expect(pass(20)).toBe(1);
  });

  it('ends when the view is detached', () => {
    view.redraw();
    detach();
    trace.advance(200);
    expect(pass(1000)).toBe(0);
    view.redraw();
    expect(pass(1000)).toBe(0);
  });
});
