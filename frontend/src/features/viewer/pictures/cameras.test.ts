import { describe, expect, it } from 'vitest';
import type { Scene, SceneObject, SensorPlacement } from '@/generated/messages';
import { camerasOf, nextCamera, requestedName, shownCamera } from './cameras';

const object = (id: number, body: string, kind: SceneObject['kind']): SceneObject => ({
  id,
  body,
  link: '',
  kind,
  shapes: [],
  pose: [0, 0, 0, 0, 0, 0, 1],
});
const sensor = (name: string, object_id: number, kind: SensorPlacement['kind'] = 'camera') => ({
  name,
  kind,
  object_id,
  pose: [0, 0, 0, 0, 0, 0, 1],
  fov: 1,
  range: 2,
});
const scene = {
  objects: [object(1, 'wall', 'static'), object(2, 'one', 'robot'), object(3, 'two', 'robot')],
  sensors: [sensor('laser', 2, 'lidar'), sensor('front', 2), sensor('rear', 2), sensor('front', 3)],
} as unknown as Scene;

describe('the cameras of a world', () => {
  it('are named by their sensors, those of other robots with the robot first', () => {
    expect(camerasOf(scene)).toEqual(['front', 'rear', 'two/front']);
    expect(camerasOf(null)).toEqual([]);
  });

  it('show the chosen one, or the first if the world has no such camera', () => {
    const cameras = camerasOf(scene);
    expect(shownCamera(cameras, 'rear')).toBe('rear');
    expect(shownCamera(cameras, 'of another world')).toBe('front');
    expect(shownCamera(cameras, null)).toBe('front');
    expect(shownCamera([], 'rear')).toBeNull();
  });

  it('are requested by name, except for the first', () => {
    expect(requestedName(camerasOf(scene), 'front')).toBeUndefined();
    expect(requestedName(camerasOf(scene), 'rear')).toBe('rear');
    expect(requestedName([], null)).toBeUndefined();
  });

  it('take turns in additional views', () => {
    expect(nextCamera(['front', 'rear'], 'front')).toBe('rear');
    expect(nextCamera(['front', 'rear'], 'rear')).toBe('front');
    expect(nextCamera(['front'], null)).toBe('front');
    expect(nextCamera([], null)).toBeNull();
  });
});
