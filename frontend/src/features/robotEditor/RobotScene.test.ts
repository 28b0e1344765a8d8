import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import { readRobot } from '@/model/robot/read';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import robotYaml from '@/model/robot/template/robot.yaml?raw';
import { stl } from '../../../harness/documents';
import { objectsOf, valuesOf } from '../../../harness/scene';
import { fakeServer, openProject } from '../../../harness/testing';
import { RobotScene } from './RobotScene';

function shown(yaml = robotYaml, urdf = robotUrdf) {
  const onArrival = vi.fn();
  const scene = new RobotScene(true, onArrival, 'robots/mine/');
  const show = (nextYaml: string, nextUrdf: string) => scene.showRobot(readRobot(nextYaml, nextUrdf).robot!);
  show(yaml, urdf);
  return { scene, onArrival, show };
}

const size = (scene: RobotScene, key: string) =>
  scene
    .boundsOf([key])
    .getSize(new THREE.Vector3())
    .toArray()
    .map((part) => Math.round(part * 1e3) / 1e3);

/** Returns the drawn field of view of a sensor: the lines after the frame. */
const sight = (scene: RobotScene, key: string) => objectsOf(scene.nodeOf(key)!, THREE.LineSegments).at(1);
const reach = (lines: THREE.LineSegments) =>
  Math.max(...valuesOf(lines.geometry).filter((_, at) => at % 3 === 0));

describe('RobotScene', () => {
  it('draws each part at its pose, in its size', () => {
    const { scene } = shown();
    expect(scene.group.children).toHaveLength(6);
    expect(size(scene, 'link base_link')).toEqual([0.3, 0.22, 0.1]);
    expect(size(scene, 'sensor scan')).toEqual([0.07, 0.07, 0.04]);
    expect(scene.nodeOf('sensor camera')?.position.toArray()).toEqual([0.162, 0, 0.11]);
    // The wheel's cylinder lies on its side.
    expect(size(scene, 'link wheel_left_link')).toEqual([0.1, 0.032, 0.1]);
  });

  it('draws the colours of the URDF', () => {
    const { scene } = shown();
    const [body] = objectsOf(scene.nodeOf('link base_link')!, THREE.Mesh);
    const { r, g, b } = (body!.material as THREE.MeshLambertMaterial).color.clone().convertLinearToSRGB();
    expect([r, g, b].map((part) => Math.round(part * 1000) / 1000)).toEqual([0.247, 0.435, 0.71]);
  });

  it('shows a small cube for an invisible part, and nothing for a battery', () => {
    const yaml = `${robotYaml}  - {name: imu, kind: imu, link: base_link, topic: /imu, rate_hz: 30}
  - {name: battery, kind: battery, topic: /battery, voltage: 12, capacity_ah: 4}
`;
    const { scene } = shown(yaml);
    expect(size(scene, 'sensor imu')).toEqual([0.024, 0.024, 0.024]);
    expect(scene.nodeOf('sensor battery')?.children).toEqual([]);
  });

  it('shows the rays of a LIDAR, at a length that does not hide the robot', () => {
    const { scene } = shown();
    const ring = sight(scene, 'sensor scan')!;
    expect(reach(ring)).toBeCloseTo(0.8);
    expect(ring.visible).toBe(false);
    const near = shown(robotYaml.replace('range_max: 8.0', 'range_max: 0.5')).scene;
    expect(reach(sight(near, 'sensor scan')!)).toBeCloseTo(0.5);
    const points = valuesOf(ring.geometry);
    expect(Math.min(...points.filter((_, at) => at % 3 === 0))).toBeCloseTo(-0.8);
  });

  it('shows the sector of a LIDAR', () => {
    const { scene } = shown(robotYaml.replace('rays: 360', `rays: 360\n    fov: ${Math.PI}`));
    const points = valuesOf(sight(scene, 'sensor scan')!.geometry);
    const axis = (offset: number) => points.filter((_, at) => at % 3 === offset);
    expect(Math.min(...axis(0))).toBeCloseTo(0);
    expect([Math.min(...axis(1)), Math.max(...axis(1))]).toEqual([expect.closeTo(-0.8), expect.closeTo(0.8)]);
    expect(axis(2).every((z) => z === 0)).toBe(true);
    // The ring has 72 pieces, and there are 13 rays.
    expect(points).toHaveLength((72 + 13) * 2 * 3);
  });

  it('shows the pyramid of a camera', () => {
    const { scene } = shown();
    const pyramid = sight(scene, 'sensor camera')!;
    expect(reach(pyramid)).toBeCloseTo(0.4);
    const side = Math.max(...valuesOf(pyramid.geometry).filter((_, at) => at % 3 === 1));
    expect(side).toBeCloseTo(0.4 * Math.tan(0.6), 3);
  });

  it('draws only changed parts again', () => {
    const { scene, show } = shown();
    const [base, camera] = ['link base_link', 'sensor camera'].map((key) => scene.nodeOf(key));
    show(robotYaml.replace('fov: 1.2', 'fov: 0.8'), robotUrdf);
    expect(scene.nodeOf('link base_link')).toBe(base);
    expect(scene.nodeOf('sensor camera')).not.toBe(camera);
    const moved = scene.nodeOf('sensor camera');
    show(robotYaml.replace('fov: 1.2', 'fov: 0.8'), robotUrdf.replace('0.162 0 0.11', '0.2 0 0.11'));
    expect(scene.nodeOf('sensor camera')).toBe(moved);
    expect(moved?.position.x).toBe(0.2);
  });

  it('returns the parts that move together', () => {
    const { scene } = shown();
    expect(scene.heldNodesOf(['sensor scan'])).toEqual([scene.nodeOf('sensor scan')]);
    expect(scene.heldNodesOf(['link base_link'])).toHaveLength(6);
    expect(scene.heldNodesOf([])).toEqual([]);
    expect(new RobotScene(true, () => undefined, '').heldNodesOf(['sensor scan'])).toEqual([]);
  });

  it.each(['meshes/a.stl', './meshes/a.stl', 'package://mine/meshes/a.stl', 'file://meshes/a.stl'])(
    'finds the mesh %s in the folder of the URDF',
    async (name) => {
      openProject({ texts: { 'robots/mine/meshes/a.stl': '' } });
      fakeServer({ 'GET /projects/p1/files/robots/mine/meshes/a.stl': new Response(stl(1)) });
      const urdf = robotUrdf.replace(
        '<box size="0.3 0.22 0.1"/>',
        `<mesh filename="${name}" scale="2 1 1"/>`,
      );
      const { scene, onArrival } = shown(robotYaml, urdf);
      await vi.waitFor(() => expect(onArrival).toHaveBeenCalled());
      expect(size(scene, 'link base_link')).toEqual([2, 1, 0]);
    },
  );
});
