import { describe, expect, it } from 'vitest';
import type { NodeStatus } from '@/generated/messages';
import { Trace } from '@/store/session/trace/trace';
import { drawTimeline, drawTimes, paletteOf, ROW_PX } from './draw';

const palette = {
  surface: 'surface',
  line: 'line',
  text: 'text',
  running: 'running',
  success: 'success',
  failure: 'failure',
  skipped: 'skipped',
  moment: 'moment',
};

type Rect = readonly [color: string, x: number, y: number, width: number, height: number];

/** A canvas that records each rectangle with its colour, and each text with its place. */
class Recorder {
  fillStyle = '';
  font = '';
  textBaseline = '';
  strokeStyle = '';
  readonly rims: [color: string, text: string][] = [];
  readonly rects: Rect[] = [];
  readonly texts: [text: string, x: number, y: number][] = [];
  readonly calls: string[] = [];
  cleared: number[] = [];
  clipped: number[] = [];
  clearRect(...box: number[]): void {
    this.cleared = box;
  }
  fillRect(x: number, y: number, width: number, height: number): void {
    this.rects.push([this.fillStyle, x, y, width, height]);
  }
  fillText(text: string, x: number, y: number): void {
    this.texts.push([text, x, y]);
  }
  strokeText(text: string): void {
    this.rims.push([this.strokeStyle, text]);
  }
  rect(...box: number[]): void {
    this.clipped = box;
  }
  save(): void {
    this.calls.push('save');
  }
  beginPath(): void {
    this.calls.push('begin');
  }
  clip(): void {
    this.calls.push('clip');
  }
  restore(): void {
    this.calls.push('restore');
  }
}

interface Drawn {
  readonly trace: Trace;
  readonly uids?: readonly number[];
  readonly span?: { from: number; to: number };
  readonly height?: number;
  readonly scrollTop?: number;
}

function drawn({
  trace,
  uids = [1],
  span = { from: 0, to: 10 },
  height = 110,
  scrollTop = 0,
}: Drawn): Recorder {
  const recorder = new Recorder();
  const context = recorder as unknown as CanvasRenderingContext2D;
  drawTimeline(trace, { context, width: 1000, height, span, uids, scrollTop, palette });
  return recorder;
}

/** Returns a run until 8 s, in which node 1 has one status from 2 s to 4 s. */
function traceOf(status: NodeStatus, uid = 1): Trace {
  const trace = new Trace();
  trace.start([], 0);
  trace.tick([[uid, status]], [], 2);
  trace.tick([[uid, 'IDLE']], [], 4);
  trace.advance(8);
  return trace;
}

const strips = ({ rects }: Recorder) => rects.filter(([color]) => color !== 'line' && color !== 'text');

describe('drawTimeline', () => {
  it.each([
    ['RUNNING', 'running', 25, 18],
    ['SUCCESS', 'success', 33, 10],
    ['FAILURE', 'failure', 25, 10],
    ['SKIPPED', 'skipped', 33, 2],
  ] as const)('draws %s at a height of its own', (status, color, y, height) => {
    expect(strips(drawn({ trace: traceOf(status) }))).toEqual([[color, 200, y, 200, height]]);
  });

  it('draws nothing for an idle node', () => {
    expect(strips(drawn({ trace: traceOf('RUNNING', 2) }))).toEqual([]);
  });

  it('cuts stretches that began before, and shows those shorter than a pixel', () => {
    const trace = traceOf('RUNNING');
    expect(strips(drawn({ trace, span: { from: 3, to: 5 } }))).toEqual([['running', 0, 25, 500, 18]]);
    const long = { from: 0, to: 10_000 };
    expect(strips(drawn({ trace, span: long }))[0]?.[3]).toBe(1);
  });

  it('draws only the visible rows, moved by the scrolling', () => {
    const trace = new Trace();
    trace.start([], 0);
    const uids = Array.from({ length: 20 }, (_, index) => index);
    trace.tick(
      uids.map((uid) => [uid, 'RUNNING'] as const),
      [],
      0,
    );
    trace.advance(10);
    const tops = (scrollTop: number, height: number) =>
      strips(drawn({ trace, uids, scrollTop, height })).map(([, , y]) => y);
    expect(tops(0, 22 + 2 * ROW_PX)).toEqual([25, 49]);
    expect(tops(30, 22 + 2 * ROW_PX)).toEqual([19, 43, 67]);
    expect(tops(18 * ROW_PX, 1000)).toEqual([25, 49]);
  });

  it('marks round times on the axis', () => {
    const { rects, texts, font } = drawn({ trace: traceOf('RUNNING'), span: { from: 0, to: 10 } });
    expect(texts.slice(0, 3)).toEqual([
      ['0 s', 4.5, 11],
      ['1 s', 104.5, 11],
      ['2 s', 204.5, 11],
    ]);
    expect(rects.filter(([color]) => color === 'line').slice(0, 2)).toEqual([
      ['line', 0, 17, 1, 110],
      ['line', 100, 17, 1, 110],
    ]);
    expect(rects).toContainEqual(['line', 0, 21, 1000, 1]);
    expect(font).toContain('11px');
  });

  it('clears everything, and keeps strips off the axis', () => {
    const recorder = drawn({ trace: traceOf('RUNNING') });
    expect(recorder.cleared).toEqual([0, 0, 1000, 110]);
    expect(recorder.clipped).toEqual([0, 22, 1000, 88]);
    expect(recorder.calls).toEqual(['save', 'begin', 'clip', 'restore']);
    expect(recorder.textBaseline).toBe('middle');
  });

  it('draws the present if it is visible', () => {
    const present = (span: { from: number; to: number }) =>
      drawn({ trace: traceOf('RUNNING'), span }).rects.filter(([color]) => color === 'text');
    expect(present({ from: 0, to: 10 })).toEqual([['text', 800, 17, 1, 110]]);
    expect(present({ from: 0, to: 8 })).toEqual([['text', 999, 17, 1, 110]]);
    expect(present({ from: 8, to: 10 })).toEqual([['text', 0, 17, 1, 110]]);
    expect(present({ from: 0, to: 7 })).toEqual([]);
    expect(present({ from: 9, to: 10 })).toEqual([]);
  });
});

it('reads its colours from the theme', () => {
  const element = document.createElement('div');
  document.body.append(element);
  const names = {
    surface: 'surface',
    line: 'border',
    text: 'muted',
    running: 'running-bright',
    success: 'success-bright',
    failure: 'failure-bright',
    skipped: 'skipped',
    moment: 'text',
  };
  for (const token of Object.values(names)) element.style.setProperty(`--bts-${token}`, ` ${token} `);
  expect(paletteOf(element)).toEqual(names);
  element.remove();
});

it('draws round times over a strip, each with a rim that keeps it readable', () => {
  const canvas = new Recorder();
  drawTimes(canvas as unknown as CanvasRenderingContext2D, { from: 4, to: 14 }, 300, palette);
  expect(canvas.texts).toEqual([
    ['5 s', 34, 1],
    ['10 s', 184, 1],
  ]);
  expect(canvas.rims).toEqual([
    ['surface', '5 s'],
    ['surface', '10 s'],
  ]);
  expect(canvas.rects.map(([color, x]) => [color, x])).toEqual([
    ['moment', 30],
    ['moment', 180],
  ]);
});
