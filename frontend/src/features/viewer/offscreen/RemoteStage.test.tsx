import { fireEvent } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Scene } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { hidePaths, showPaths } from '@/store/session/trace/shownPaths';
import { pretendWebGl } from '../../../../harness/scene';
import { openSession } from '../../../../harness/testing';
import { setMeasuring, useMeasuring } from '../measuring';
import { loadViewOptions, type ViewOptions } from '../viewOptions';
import type { FromWorker, ToWorker, View } from './messages';
import { RemoteStage } from './RemoteStage';

pretendWebGl('NVIDIA');

const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [{ id: 1, body: 'wall', link: '', kind: 'static', shapes: [], pose: [0, 0, 0, 0, 0, 0, 1] }],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};

const options = loadViewOptions();
const view = (part: Partial<ViewOptions> = {}): View => ({
  options: { ...options, ...part },
  ...{ isDark: false, isVisible: true, isJudged: true, canMove: true },
  measuring: { isOn: false, points: [] },
});

function begin() {
  const parent = document.body.appendChild(document.createElement('div'));
  const sent: ToWorker[] = [];
  const worker = {
    onmessage: vi.fn<(event: { data: FromWorker }) => void>(),
    onerror: vi.fn<() => void>(),
    postMessage: (message: ToWorker) => void sent.push(message),
    terminate: vi.fn(),
  };
  const reports = { onTurned: vi.fn(), onSlow: vi.fn(), onDrawn: vi.fn(), onFailed: vi.fn() };
  const stage = new RemoteStage(parent, view(), reports, () => worker as unknown as Worker);
  const canvas = parent.querySelector('canvas')!;
  canvas.setPointerCapture = vi.fn();
  onTestFinished(() => {
    stage.end();
    parent.remove();
  });
  const sentAs = <K extends ToWorker['kind']>(kind: K) =>
    sent.filter((message): message is Extract<ToWorker, { kind: K }> => message.kind === kind);
  const tell = (data: FromWorker) => worker.onmessage({ data });
  return { stage, canvas, worker, reports, sent, sentAs, tell };
}

beforeEach(() => {
  HTMLCanvasElement.prototype.transferControlToOffscreen = () => ({}) as OffscreenCanvas;
  frames.publish(SCENE);
  onTestFinished(() => {
    frames.clear();
    Reflect.deleteProperty(HTMLCanvasElement.prototype, 'transferControlToOffscreen');
  });
});

describe('a view that a worker draws', () => {
  it('begins with the canvas, the view, the scene, and what happened before', () => {
    const { sent } = begin();
    expect(sent.map(({ kind }) => kind)).toEqual(['begin', 'view', 'frame', 'past']);
  });

  it('passes on the frames as they come, until it ends', () => {
    const { stage, sentAs, canvas, worker } = begin();
    frames.publish({ ...SCENE, name: 'other' });
    expect(sentAs('frame').map(({ frame }) => (frame as Scene).name)).toEqual(['room', 'other']);
    stage.end();
    frames.publish(SCENE);
    expect(sentAs('frame')).toHaveLength(2);
    expect(worker.terminate).toHaveBeenCalled();
    expect(canvas.isConnected).toBe(false);
  });

  it('passes on the paths that are shown, also those from before', () => {
    const path = { label: '1', name: 'a', hue: 0, isDashed: true, labelAt: 'end', lines: [] } as const;
    showPaths('compare', [path]);
    const { sentAs } = begin();
    hidePaths('compare');
    expect(sentAs('paths').map(({ paths }) => paths)).toEqual([[path], []]);
  });

  it('numbers the requests to move the camera', () => {
    const { stage, sentAs } = begin();
    stage.show(view({ grid: false }));
    stage.show(view({ viewpoint: { kind: 'top' } }));
    expect(sentAs('view').map(({ viewpoint }) => viewpoint)).toEqual([1, 1, 2]);
  });

  it('passes on the pointer, which it captures, and keeps the wheel from the page', () => {
    const { canvas, sentAs } = begin();
    fireEvent.pointerDown(canvas, { pointerId: 7 });
    expect(canvas.setPointerCapture).toHaveBeenCalledWith(7);
    expect(fireEvent.wheel(canvas, { deltaY: 3 })).toBe(false);
    expect(fireEvent.contextMenu(canvas)).toBe(false);
    expect(sentAs('event').map(({ event }) => event.type)).toEqual(['pointerdown', 'wheel', 'contextmenu']);
  });

  it('passes on keys only while a body is dragged', () => {
    const { sentAs, tell } = begin();
    expect(fireEvent.keyDown(window, { key: 'q' })).toBe(true);
    tell({ kind: 'cursor', cursor: 'grabbing' });
    expect(fireEvent.keyDown(window, { key: 'q' })).toBe(false);
    expect(fireEvent.keyDown(window, { key: 'x' })).toBe(true);
    tell({ kind: 'cursor', cursor: '' });
    expect(fireEvent.keyDown(window, { key: 'Escape' })).toBe(true);
    expect(sentAs('event').map(({ to, event }) => [to, event['key']])).toEqual([
      ['keys', 'q'],
      ['keys', 'x'],
    ]);
  });

  it('does what the worker asks, and answers', async () => {
    const executor = await openSession({ state: 'paused' });
    const { reports, worker, sentAs, tell } = begin();
    setMeasuring(true);
    tell({ kind: 'measured', point: [1, 2, 3] });
    expect(useMeasuring.getState().points).toEqual([[1, 2, 3]]);
    tell({ kind: 'turned' });
    tell({ kind: 'slow', hz: 2 });
    tell({ kind: 'drawn' });
    expect(reports.onDrawn).toHaveBeenCalledOnce();
    expect(reports.onTurned).toHaveBeenCalledOnce();
    expect(reports.onSlow).toHaveBeenCalledExactlyOnceWith(2);
    const [pose, from] = [
      [1, 0, 0, 0, 0, 0],
      [0, 0, 0, 0, 0, 0],
    ] as [[number, number, number, number, number, number], [number, number, number, number, number, number]];
    tell({ kind: 'move', id: 4, body: 'crate', pose, from });
    await vi.waitFor(() => expect(sentAs('moved')).toEqual([{ kind: 'moved', id: 4, error: null }]));
    executor.refuse('move_body', 'It is fixed.');
    tell({ kind: 'move', id: 5, body: 'crate', pose, from });
    await vi.waitFor(() =>
      expect(sentAs('moved')[1]).toEqual({ kind: 'moved', id: 5, error: 'It is fixed.' }),
    );
    worker.onerror();
    expect(reports.onFailed).toHaveBeenCalledOnce();
  });
});
