import type * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import type { Scan } from '@/generated/messages';
import { valuesOf } from '../../../../harness/scene';
import { LidarView } from './LidarView';

const scan = (ranges: readonly number[], more: Partial<Scan> = {}): Scan => ({
  type: 'scan',
  t: 0,
  sensor: 'scan',
  pose: [0, 0, 0, 0, 0, 0, 1],
  angle_min: 0,
  angle_increment: Math.PI / 2,
  range_max: 8,
  ranges: new Uint8Array(new Float32Array(ranges).buffer),
  ...more,
});

const parts = (view: LidarView) => view.group.children as [THREE.LineSegments, THREE.Points];
const shown = ({ geometry }: THREE.LineSegments | THREE.Points) =>
  valuesOf(geometry).slice(0, geometry.drawRange.count * 3);

describe('LidarView', () => {
  it('draws each ray to its hit, or to its range', () => {
    const view = new LidarView();
    view.show(scan([1, Infinity, 3, 8, 0, NaN], { angle_min: Math.PI / 2 }));
    const [rays, hits] = parts(view);
    expect(shown(rays)).toEqual(
      [
        [0, 0, 0, 0, 1, 0],
        [0, 0, 0, -8, 0, 0],
        [0, 0, 0, 0, -3, 0],
        [0, 0, 0, 8, 0, 0],
        [0, 0, 0, 0, 8, 0],
        [0, 0, 0, -8, 0, 0],
      ].flat(),
    );
    expect(shown(hits)).toEqual([0, 1, 0, 0, -3, 0]);
  });

  it('keeps its buffers for a scan with fewer hits, and grows for more', () => {
    const view = new LidarView();
    const [rays, hits] = parts(view);
    view.show(scan([1, 2]));
    const memory = rays.geometry.getAttribute('position');
    const { version } = memory as THREE.BufferAttribute;
    view.show(scan([4]));
    expect(rays.geometry.getAttribute('position')).toBe(memory);
    expect((memory as THREE.BufferAttribute).version).toBe(version + 1);
    expect(shown(rays)).toEqual([0, 0, 0, 4, 0, 0]);
    expect(shown(hits)).toEqual([4, 0, 0]);
    view.show(scan([1, 1, 1, 1]));
    expect(rays.geometry.drawRange.count).toBe(8);
    expect(hits.geometry.drawRange.count).toBe(4);
    view.show(scan([]));
    expect(rays.geometry.drawRange.count).toBe(0);
  });

  it('is at the sensor', () => {
    const view = new LidarView();
    view.show(scan([1], { pose: [1, 2, 3, 0, 0, 1, 0] }));
    expect(view.group.position.toArray()).toEqual([1, 2, 3]);
    expect(view.group.quaternion.toArray()).toEqual([0, 0, 1, 0]);
    view.show(scan([1], { pose: [] }));
    expect(view.group.quaternion.toArray()).toEqual([0, 0, 0, 1]);
    expect(view.group.position.length()).toBe(0);
  });

  it('is drawn wherever it is, and freed', () => {
    const view = new LidarView();
    expect(parts(view).map(({ frustumCulled }) => frustumCulled)).toEqual([false, false]);
    const freed = vi.fn();
    for (const { geometry, material } of parts(view)) {
      geometry.addEventListener('dispose', freed);
      (material as THREE.Material).addEventListener('dispose', freed);
    }
    view.dispose();
    expect(freed).toHaveBeenCalledTimes(4);
  });
});
