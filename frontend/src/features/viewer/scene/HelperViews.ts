import * as THREE from 'three';
import type { Scene, SensorPlacement } from '@/generated/messages';
import type { World } from './World';

const FRUSTUM_COLOR = 0x2f9e6e;
/** The length in m to which a camera's frustum is drawn at most; a longer one would hide the room. */
const LONGEST_M = 2.5;
const ASPECT = 4 / 3;
const FRAME_M = 0.25;
const WORLD_FRAME_M = 0.6;

/** The coordinate frames (x red, y green, z blue) of the world, the robots' links and their sensors. */
export class FramesView {
  private readonly axes: THREE.AxesHelper[] = [];
  readonly origin: THREE.AxesHelper;

  constructor(scene: Scene, world: World) {
    this.origin = this.make(WORLD_FRAME_M);
    this.origin.position.z = 0.005;
    for (const object of scene.objects) {
      if (object.kind === 'robot') world.object(object.id)?.add(this.make(FRAME_M));
    }
    for (const sensor of scene.sensors) {
      const axes = this.make(FRAME_M * 0.6);
      place(axes, sensor);
      world.object(sensor.object_id)?.add(axes);
    }
  }

  show(isShown: boolean): void {
    for (const axes of this.axes) axes.visible = isShown;
  }

  dispose(): void {
    for (const axes of this.axes) {
      axes.removeFromParent();
      axes.dispose();
    }
  }

  private make(size: number): THREE.AxesHelper {
    const axes = new THREE.AxesHelper(size);
    (axes.material as THREE.Material).depthTest = false;
    axes.renderOrder = 2;
    this.axes.push(axes);
    return axes;
  }
}

/** The fields of view of the robots' cameras: a pyramid from each lens. Cameras look along x, with z up. */
export class FrustumView {
  private readonly pyramids: THREE.LineSegments[] = [];

  constructor(scene: Scene, world: World) {
    for (const sensor of scene.sensors) {
      if (sensor.kind !== 'camera') continue;
      const pyramid = new THREE.LineSegments(
        pyramidOf(sensor),
        new THREE.LineBasicMaterial({ color: FRUSTUM_COLOR, transparent: true, opacity: 0.9 }),
      );
      place(pyramid, sensor);
      pyramid.frustumCulled = false;
      world.object(sensor.object_id)?.add(pyramid);
      this.pyramids.push(pyramid);
    }
  }

  show(isShown: boolean): void {
    for (const pyramid of this.pyramids) pyramid.visible = isShown;
  }

  dispose(): void {
    for (const pyramid of this.pyramids) {
      pyramid.removeFromParent();
      pyramid.geometry.dispose();
      (pyramid.material as THREE.Material).dispose();
    }
  }
}

export function pyramidOf({ fov, range }: Pick<SensorPlacement, 'fov' | 'range'>): THREE.BufferGeometry {
  const depth = Math.min(range > 0 ? range : LONGEST_M, LONGEST_M);
  const half = depth * Math.tan(fov / 2);
  const height = half / ASPECT;
  const corners = [
    [depth, half, height],
    [depth, -half, height],
    [depth, -half, -height],
    [depth, half, -height],
  ];
  const lines = corners.flatMap((corner, index) => [
    ...[0, 0, 0, ...corner],
    ...[...corner, ...(corners[(index + 1) % corners.length] ?? corner)],
  ]);
  return new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(lines, 3));
}

function place(object: THREE.Object3D, { pose }: SensorPlacement): void {
  const [x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1] = pose;
  object.position.set(x, y, z);
  object.quaternion.set(qx, qy, qz, qw);
}
