import type * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { ShownTrail } from '@/store/session/trace/shownTrail';
import { Trail } from '@/store/session/trace/trail';
import { TrailView } from './TrailView';

function walked(count: number) {
  const trail = new Trail();
  for (let step = 0; step < count; step += 1) trail.add(step * 0.5, step, step);
  return trail;
}

const drawn = (view: TrailView, count: number) =>
  [
    ...(
      view.line.geometry.getAttribute('instanceStart') as THREE.InterleavedBufferAttribute
    ).data.array.slice(0, count),
  ].map((value) => Math.round(value * 1e4) / 1e4);

describe('TrailView', () => {
  it('draws a line just above the floor from point to point', () => {
    const view = new TrailView(new ShownTrail(walked(3)));
    expect(drawn(view, 12)).toEqual([0, 0, 0.012, 0.5, 1, 0.012, 0.5, 1, 0.012, 1, 2, 0.012]);
    expect(view.line.geometry.instanceCount).toBe(2);
    expect(view.line.visible).toBe(true);
    expect(view.line.frustumCulled).toBe(false);
  });

  it.each([0, 1])('draws nothing for %s points', (count) => {
    const view = new TrailView(new ShownTrail(walked(count)));
    expect(view.line.visible).toBe(false);
    expect(view.line.geometry.instanceCount).toBe(0);
  });

  it('reports whether the trail has changed since', () => {
    const trail = walked(2);
    const view = new TrailView(new ShownTrail(trail));
    expect(view.update()).toBe(false);
    trail.add(5, 5, 9);
    expect(view.update()).toBe(true);
    expect(view.update()).toBe(false);
    trail.clear();
    expect(view.update()).toBe(true);
    expect(view.line.visible).toBe(false);
  });

  it('is cut to the moment at which the user looks', () => {
    const shown = new ShownTrail(walked(5));
    const view = new TrailView(shown);
    shown.show(2, null);
    expect(view.update()).toBe(true);
    expect(view.line.geometry.instanceCount).toBe(2);
    shown.show(null, null);
    expect(view.update()).toBe(true);
    expect(view.line.geometry.instanceCount).toBe(4);
  });

  it('frees what it drew', () => {
    const view = new TrailView(new ShownTrail(walked(2)));
    const freed = vi.fn();
    view.line.geometry.addEventListener('dispose', freed);
    view.line.material.addEventListener('dispose', freed);
    view.dispose();
    expect(freed).toHaveBeenCalledTimes(2);
  });
});
