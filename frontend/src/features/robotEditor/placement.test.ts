import { expect, it, onTestFinished } from 'vitest';
import { openRobot } from '../../../harness/documents';
import { readingOf } from './editor';
import { placementOf } from './placement';
import { RobotScene } from './RobotScene';

function begin(texts = {}) {
  const editor = openRobot(texts);
  const scene = new RobotScene(true, () => undefined, 'robots/mine/', 0.5);
  onTestFinished(() => scene.dispose());
  return { editor, scene, placement: placementOf(editor, scene) };
}

it('draws a part alone, where one of its kind usually sits', () => {
  const { editor, scene, placement } = begin();
  const before = readingOf(editor).robot!.parts.length;
  const spot = placement.draw({ kind: 'box' });
  expect(scene.group.children).toHaveLength(1);
  expect(spot?.height).toBeGreaterThan(0);
  expect(readingOf(editor).robot!.parts).toHaveLength(before);
  expect(placement.draw(null)).toBeNull();
  expect(scene.group.children).toEqual([]);
});

it('draws a part that looks like a mesh', () => {
  const { scene, placement } = begin();
  expect(placement.draw({ mesh: { file: 'meshes/arm.stl', scale: 1 } })).not.toBeNull();
  expect(scene.nodeOf('link arm_link')).toBeDefined();
});

it('has no ghost of a robot that cannot be read', () => {
  expect(begin({ 'robots/mine/robot.yaml': 'a: [' }).placement.draw({ kind: 'box' })).toBeNull();
});

it('adds the part', () => {
  const { editor, placement } = begin();
  placement.place({ kind: 'imu' }, [0.05, 0]);
  const imu = readingOf(editor).robot!.parts.find(({ key }) => key === 'sensor imu');
  expect(imu?.pose.slice(0, 2)).toEqual([0.05, 0]);
});
