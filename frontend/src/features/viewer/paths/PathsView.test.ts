import * as THREE from 'three';
import { LineSegments2 } from 'three/examples/jsm/lines/LineSegments2.js';
import { expect, it, vi } from 'vitest';
import type { ShownPath } from '@/store/session/trace/shownPaths';
import { PathsView } from './PathsView';

const path = (more: Partial<ShownPath> = {}): ShownPath => ({
  label: '1',
  name: 'wider',
  hue: 0,
  isDashed: false,
  labelAt: 'moment',
  // After two steps the robot is put elsewhere.
  lines: [Float32Array.of(0, 0, 1, 1, 1, 0, 2, 0, 5, 5, 3, 1, 5, 6, 4, 0)],
  ...more,
});
const linesOf = (view: PathsView) =>
  view.group.children.filter((each): each is LineSegments2 => each instanceof LineSegments2);
const dotsOf = (view: PathsView) =>
  view.group.children.filter((each) => each instanceof THREE.Mesh && !(each instanceof LineSegments2));

it('draws a line for each robot, with gaps where it was put elsewhere', () => {
  const view = new PathsView();
  view.show([path(), path({ hue: 120, isDashed: true })], false, null);
  const [one, two] = linesOf(view);
  const ends = one!.geometry.getAttribute('instanceStart') as THREE.InterleavedBufferAttribute;
  expect([...ends.data.array].map((each) => Math.round(each * 1e3) / 1e3)).toEqual([
    ...[0, 0, 0.016, 1, 0, 0.016],
    ...[5, 5, 0.016, 5, 6, 0.016],
  ]);
  expect([one!.material.dashed, two!.material.dashed]).toEqual([false, true]);
  expect(one!.material.color.r).toBeGreaterThan(one!.material.color.g);
  expect(two!.material.color.g).toBeGreaterThan(two!.material.color.r);
});

it('has its colours lighter on a dark ground', () => {
  const view = new PathsView();
  const light = () => linesOf(view)[0]!.material.color.getHSL({ h: 0, s: 0, l: 0 }).l;
  view.show([path()], false, null);
  const before = light();
  view.show([path()], true, null);
  expect(light()).toBeGreaterThan(before);
  expect(linesOf(view)).toHaveLength(1);
});

it('has a dot where the robot is at the moment', () => {
  const view = new PathsView();
  view.show([path()], false, 2.5);
  const [dot] = dotsOf(view);
  expect(dot!.position.toArray().slice(0, 2)).toEqual([1, 0]);
  view.move(0.5);
  expect(dot!.visible).toBe(false);
  view.move(null);
  expect(dot!.visible).toBe(true);
  expect(dot!.position.toArray().slice(0, 2)).toEqual([5, 6]);
});

it('has the dot at the end where that is wanted', () => {
  const view = new PathsView();
  view.show([path({ labelAt: 'end' })], false, 0.5);
  const [dot] = dotsOf(view);
  expect(dot!.position.toArray().slice(0, 2)).toEqual([5, 6]);
});

it('writes the label of a path where text can be drawn', () => {
  const context = { strokeText: vi.fn(), fillText: vi.fn() };
  vi.stubGlobal(
    'OffscreenCanvas',
    class {
      getContext = () => context;
    },
  );
  const view = new PathsView();
  view.show([path({ label: '12' })], true, null);
  expect(context.fillText).toHaveBeenCalledWith('12', 32, 32, 64);
  expect(view.group.children.filter((each) => each instanceof THREE.Sprite)).toHaveLength(1);
  vi.unstubAllGlobals();
});

it('frees what it drew', () => {
  const view = new PathsView();
  view.show([path()], false, null);
  const freed = vi.fn();
  const [line] = linesOf(view);
  line!.geometry.addEventListener('dispose', freed);
  line!.material.addEventListener('dispose', freed);
  view.dispose();
  expect(freed).toHaveBeenCalledTimes(2);
  expect(view.group.children).toHaveLength(0);
});
