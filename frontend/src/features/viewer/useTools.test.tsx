import { fireEvent, screen, waitFor } from '@testing-library/react';
import { Notifications } from '@mantine/notifications';
import { useRef } from 'react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Introspection, Scene, Shape } from '@/generated/messages';
import { currentPoses } from '@/store/session/poses';
import { pixelOf, showScene } from '../../../harness/scene';
import { openSession, show } from '../../../harness/testing';
import { useMoves } from './lastMove';
import { setMeasuring, useMeasuring } from './measuring';
import type { Orbit } from './scene/Surroundings';
import { World } from './scene/World';
import { pageHost } from './pageHost';
import { useTools } from './useTools';

const BOX: Shape = { shape: 'box', size: [1, 1, 1], pose: [0, 0, 0, 0, 0, 0, 1], color: [1, 0, 0, 1] };
const SCENE: Scene = {
  type: 'scene',
  name: 'room',
  t: 0,
  objects: [
    { id: 1, body: 'crate', link: '', kind: 'dynamic', shapes: [BOX], pose: [0, 0, 0.5, 0, 0, 0, 1] },
    { id: 2, body: 'person', link: '', kind: 'actor', shapes: [BOX], pose: [0, 2, 0.5, 0, 0, 0, 1] },
  ],
  meshes: {},
  lights: [],
  ground_color: [1, 1, 1, 1],
  sensors: [],
};

const view = { enabled: true } as Orbit;

function Tools({ world }: { readonly world: World }) {
  const controls = useRef<Orbit | null>(view);
  useTools(world, controls, pageHost);
  return <primitive object={world.group} />;
}

async function begin(introduction: Partial<Introspection> = { state: 'paused' }) {
  const executor = await openSession(introduction);
  const world = new World(SCENE, true);
  const shown = showScene(<Tools world={world} />);
  shown.camera.position.set(0, 0, 10);
  shown.camera.lookAt(0, 0, 0);
  const { canvas, camera } = shown;
  const at = (x: number, y: number, more: object = {}) => ({
    button: 0,
    pointerId: 1,
    ...pixelOf(camera, x, y, 1),
    ...more,
  });
  const down = (x: number, y: number, more = {}) => fireEvent.pointerDown(canvas, at(x, y, more));
  const move = (x: number, y: number, more = {}) =>
    fireEvent.pointerMove(canvas, at(x, y, { buttons: 1, ...more }));
  const up = (x: number, y: number, more = {}) => fireEvent.pointerUp(canvas, at(x, y, more));
  const crate = () =>
    world
      .object(1)!
      .position.toArray()
      .map((part) => Math.round(part * 1e4) / 1e4 + 0);
  return { ...shown, executor, world, down, move, up, crate };
}

beforeEach(() => {
  view.enabled = true;
  currentPoses.clear();
  setMeasuring(false);
  useMoves.setState({ last: null });
});

describe('dragging a body while time is paused', () => {
  it('moves it over the ground, and sends it to the session', async () => {
    const { canvas, executor, down, move, up, crate } = await begin();
    const capture = vi.spyOn(canvas, 'setPointerCapture');
    down(0.2, 0.1);
    expect(view.enabled).toBe(false);
    expect(canvas.style.cursor).toBe('grabbing');
    expect(capture).toHaveBeenCalledExactlyOnceWith(1);
    move(1.2, -0.4);
    expect(crate()).toEqual([1, -0.5, 0.5]);
    up(1.2, -0.4);
    expect(executor.sentAs('move_body')).toEqual([
      { id: 'crate', pose: [1, -0.5, 0.5, 0, 0, 0].map((part) => expect.closeTo(part, 4) as number) },
    ]);
    expect(view.enabled).toBe(true);
    expect(canvas.style.cursor).toBe('');
    await waitFor(() =>
      expect(useMoves.getState().last).toEqual({
        body: 'crate',
        from: [0, 0, 0.5, 0, 0, 0].map((part) => expect.closeTo(part) as number),
      }),
    );
  });

  it('turns it by 15 degrees with Q and E', async () => {
    const { executor, down, up } = await begin();
    expect(fireEvent.keyDown(window, { key: 'q' })).toBe(true);
    down(0, 0);
    expect(fireEvent.keyDown(window, { key: 'q' })).toBe(false);
    fireEvent.keyDown(window, { key: 'q' });
    fireEvent.keyDown(window, { key: 'e' });
    expect(fireEvent.keyDown(window, { key: 'x' })).toBe(true);
    up(0, 0);
    const [sent] = executor.sentAs('move_body') as { pose: number[] }[];
    expect(sent?.pose[5]).toBeCloseTo(Math.PI / 12);
  });

  it.each([
    ['Escape', (canvas: HTMLElement) => fireEvent.keyDown(window, { key: 'Escape', target: canvas })],
    ['the system', (canvas: HTMLElement) => fireEvent.pointerCancel(canvas)],
  ])('is cancelled by %s: it returns, and nothing is sent', async (_, cancel) => {
    const { canvas, executor, down, move, up, crate } = await begin();
    down(0, 0);
    move(2, 0);
    cancel(canvas);
    expect(crate()).toEqual([0, 0, 0.5]);
    expect(view.enabled).toBe(true);
    up(2, 0);
    expect(executor.sentAs('move_body')).toEqual([]);
  });

  it('sends nothing for a body that stayed', async () => {
    const { executor, down, up } = await begin();
    down(0, 0);
    up(0, 0);
    expect(executor.sentAs('move_body')).toEqual([]);
  });

  it('puts it back if the session refuses, and reports why', async () => {
    const { executor, down, move, up, crate } = await begin();
    currentPoses.set(1, [0.25, 0, 0.5, 0, 0, 0, 1]);
    executor.refuse('move_body', 'Something stands there.');
    show(<Notifications />);
    down(0, 0);
    move(2, 0);
    up(2, 0);
    expect((await screen.findAllByText('Something stands there.')).length).toBeGreaterThan(0);
    expect(crate()).toEqual([0.25, 0, 0.5]);
    expect(useMoves.getState().last).toBeNull();
  });

  it('leaves people, the ground, and other buttons to the view', async () => {
    const { canvas, down } = await begin();
    const later = vi.fn();
    canvas.addEventListener('pointerdown', later);
    down(0, 2);
    down(4, 4);
    down(0, 0, { button: 2 });
    expect(later).toHaveBeenCalledTimes(3);
    expect(view.enabled).toBe(true);
    down(0, 0);
    expect(later).toHaveBeenCalledTimes(3);
    expect(view.enabled).toBe(false);
  });

  it.each([
    ['time runs', { state: 'application_running' }],
    ['another window controls', { state: 'paused', role: 'viewer' }],
  ] as const)('does not begin while %s', async (_, introduction) => {
    const { canvas, down, move } = await begin(introduction);
    down(0, 0);
    expect(view.enabled).toBe(true);
    move(0, 0, { buttons: 0 });
    expect(canvas.style.cursor).toBe('');
  });

  it('shows what can be dragged', async () => {
    const { canvas, move } = await begin();
    move(0, 0, { buttons: 0 });
    expect(canvas.style.cursor).toBe('grab');
    move(0, 2, { buttons: 1 });
    expect(canvas.style.cursor).toBe('grab');
    move(0, 2, { buttons: 0 });
    expect(canvas.style.cursor).toBe('');
  });

  it('ends with the view', async () => {
    const { rerender, down, move, crate, canvas } = await begin();
    down(0, 0);
    move(2, 0);
    rerender(<group />);
    expect(crate()).toEqual([0, 0, 0.5]);
    expect(view.enabled).toBe(true);
    fireEvent.pointerDown(canvas, { button: 0, clientX: 200, clientY: 150 });
    expect(view.enabled).toBe(true);
  });
});

describe('measuring', () => {
  it('takes the points that are clicked, on bodies and on the ground', async () => {
    const { canvas, down, move, up } = await begin();
    setMeasuring(true);
    move(0, 0, { buttons: 0 });
    expect(canvas.style.cursor).toBe('crosshair');
    down(0, 0);
    up(0, 0);
    down(-3, 0);
    up(-3, 0);
    const [first, second] = useMeasuring.getState().points;
    expect(first).toEqual([expect.closeTo(0, 4), expect.closeTo(0, 4), expect.closeTo(1, 4)]);
    expect(second).toEqual([expect.closeTo(-3 * (10 / 9), 4), expect.closeTo(0, 4), expect.closeTo(0, 4)]);
    expect(view.enabled).toBe(true);
  });

  it('takes no point of a drag, of another button, or while it is off', async () => {
    const { canvas, down, up } = await begin();
    setMeasuring(true);
    fireEvent.pointerDown(canvas, { button: 0, clientX: 200, clientY: 150 });
    fireEvent.pointerUp(canvas, { button: 0, clientX: 204, clientY: 150 });
    down(0, 0, { button: 2 });
    up(0, 0, { button: 2 });
    setMeasuring(false);
    down(-3, 0);
    up(-3, 0);
    expect(useMeasuring.getState().points).toEqual([]);
  });
});
