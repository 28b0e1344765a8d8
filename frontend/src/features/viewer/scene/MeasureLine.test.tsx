import { act } from '@testing-library/react';
import * as THREE from 'three';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { objectsOf, showScene, valuesOf } from '../../../../harness/scene';
import { addMeasured, setMeasuring } from '../measuring';
import { MeasureLine } from './MeasureLine';

beforeEach(() => setMeasuring(false));

describe('MeasureLine', () => {
  it('draws the points and the line between them, in front of everything', async () => {
    const { scene, frames } = showScene(<MeasureLine />);
    expect(objectsOf(scene, THREE.Points)).toEqual([]);
    await vi.waitFor(() => expect(frames()).toBeGreaterThan(0));
    const before = frames();
    act(() => addMeasured([1, 2, 3]));
    act(() => addMeasured([4, 5, 6]));
    const [points] = objectsOf(scene, THREE.Points);
    const [line] = objectsOf(scene, THREE.LineSegments);
    expect(valuesOf(points!.geometry)).toEqual([1, 2, 3, 4, 5, 6]);
    expect(line!.geometry).toBe(points!.geometry);
    for (const part of [points!, line!]) {
      expect(part.frustumCulled).toBe(false);
      expect((part.material as THREE.Material).depthTest).toBe(false);
      expect(part.parent?.renderOrder).toBe(3);
    }
    expect(points!.material).toMatchObject({ size: 9, sizeAttenuation: false });
    await vi.waitFor(() => expect(frames()).toBeGreaterThan(before));
  });

  it('removes them, and frees them', () => {
    const { scene } = showScene(<MeasureLine />);
    act(() => addMeasured([1, 2, 3]));
    const freed = vi.fn();
    objectsOf(scene, THREE.Points)[0]!.geometry.addEventListener('dispose', freed);
    act(() => setMeasuring(false));
    expect(objectsOf(scene, THREE.Points)).toEqual([]);
    expect(freed).toHaveBeenCalled();
  });
});
