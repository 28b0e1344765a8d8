import type { ReactElement } from 'react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import type { Scene } from '@/generated/messages';
import { frames } from '@/store/session/frames';
import { currentPoses } from '@/store/session/poses';
import { useShownPaths } from '@/store/session/trace/shownPaths';
import { trail } from '@/store/session/trace/trail';
import { pretendWebGl } from '../../../../harness/scene';
import { useMeasuring } from '../measuring';
import type { Stage } from '../scene/Stage';
import { loadViewOptions } from '../viewOptions';
import { Drawing } from './Drawing';
import type { FromWorker, View } from './messages';

pretendWebGl('NVIDIA');

type StageProps = Parameters<typeof Stage>[0];

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
const SIZE = { width: 400, height: 300, dpr: 2 };
const view = (more: Partial<View> = {}): View => ({
  options: loadViewOptions(),
  isDark: false,
  isVisible: true,
  isJudged: true,
  canMove: false,
  measuring: { isOn: false, points: [] },
  ...more,
});

function begin() {
  const post = vi.fn<(message: FromWorker) => void>();
  const root = { configure: vi.fn(() => Promise.resolve()), render: vi.fn() };
  const drawing = new Drawing(post, () => root as never);
  const shown = (): StageProps => (root.render.mock.lastCall![0] as ReactElement<StageProps>).props;
  drawing.receive({ kind: 'begin', canvas: {} as OffscreenCanvas, size: SIZE });
  return { post, root, drawing, shown };
}

beforeEach(() => {
  onTestFinished(() => {
    frames.clear();
    trail.clear();
    currentPoses.clear();
  });
});

describe('the drawing in a worker', () => {
  it('begins when it knows the canvas, the view and the scene', () => {
    const { root, drawing, shown } = begin();
    drawing.receive({ kind: 'view', view: view({ isDark: true }), viewpoint: 1 });
    expect(root.render).not.toHaveBeenCalled();
    drawing.receive({ kind: 'frame', frame: SCENE });
    expect(shown()).toMatchObject({ scene: SCENE, isDark: true, isJudged: true });
    expect(root.configure).toHaveBeenLastCalledWith(
      expect.objectContaining({ dpr: 2, size: { width: 400, height: 300, top: 0, left: 0 } }),
    );
    drawing.receive({ kind: 'size', size: { ...SIZE, width: 500 } });
    expect(root.configure).toHaveBeenLastCalledWith(
      expect.objectContaining({ size: { width: 500, height: 300, top: 0, left: 0 } }),
    );
    expect(shown().host.element?.clientWidth).toBe(500);
  });

  it('moves the camera only for a new request, although each message is a copy', () => {
    const { drawing, shown } = begin();
    drawing.receive({ kind: 'frame', frame: SCENE });
    drawing.receive({ kind: 'view', view: structuredClone(view()), viewpoint: 1 });
    const first = shown().options.viewpoint;
    drawing.receive({ kind: 'view', view: structuredClone(view({ isDark: true })), viewpoint: 1 });
    expect(shown().isDark).toBe(true);
    expect(shown().options.viewpoint).toBe(first);
    drawing.receive({ kind: 'view', view: structuredClone(view()), viewpoint: 2 });
    expect(shown().options.viewpoint).not.toBe(first);
  });

  it('knows what happened before it was opened', () => {
    const { drawing } = begin();
    drawing.receive({ kind: 'frame', frame: SCENE });
    const past = JSON.stringify({ time: 3, points: [0, 0, 1, 0], times: [2, 3] });
    drawing.receive({ kind: 'past', poses: [[1, [4, 0, 0, 0, 0, 0, 1]]], trail: past });
    expect(currentPoses.get(1)).toEqual([4, 0, 0, 0, 0, 0, 1]);
    expect([trail.count, trail.time]).toEqual([2, 3]);
  });

  it('knows the paths that the page shows', () => {
    const { drawing } = begin();
    const path = { label: '1', name: 'a', hue: 0, isDashed: true, labelAt: 'end', lines: [] } as const;
    drawing.receive({ kind: 'paths', paths: [path] });
    expect(useShownPaths.getState().paths).toEqual([path]);
    drawing.receive({ kind: 'paths', paths: [] });
  });

  it('passes events and answers to the tools, and what they do to the page', async () => {
    const { post, drawing, shown } = begin();
    drawing.receive({ kind: 'frame', frame: SCENE });
    const measuring = { isOn: true, points: [[1, 2, 3] as const] };
    drawing.receive({ kind: 'view', view: view({ canMove: true, measuring }), viewpoint: 1 });
    expect(useMeasuring.getState()).toMatchObject(measuring);
    const { host, onMoved, onSlow, onDrawn } = shown();
    expect(host.canMove()).toBe(true);
    const heard: string[] = [];
    host.element?.addEventListener('pointerdown', () => heard.push('pointer'));
    host.keys.addEventListener('keydown', (event) => heard.push((event as KeyboardEvent).key));
    drawing.receive({ kind: 'event', to: 'element', event: { type: 'pointerdown' } });
    drawing.receive({ kind: 'event', to: 'keys', event: { type: 'keydown', key: 'q' } });
    expect(heard).toEqual(['pointer', 'q']);
    const moving = host.moveBody('crate', [0, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0]);
    drawing.receive({ kind: 'moved', id: 1, error: null });
    await moving;
    onMoved();
    onSlow(2);
    onDrawn();
    expect(post.mock.calls.map(([{ kind }]) => kind)).toEqual(['move', 'turned', 'slow', 'drawn']);
  });
});
