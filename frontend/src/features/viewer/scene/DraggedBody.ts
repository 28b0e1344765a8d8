import * as THREE from 'three';
import type { MoveBody } from '@/generated/messages';
import type { World } from './World';

/** The size in m above which a body is part of the room and cannot be dragged. */
const LARGEST_M = 3;

export type BodyPose = MoveBody['pose'];

/** Returns the body of an object if it can be dragged: not walls, the ground or people. */
export function carriable(world: World, objectId: number | null): string | null {
  const object = objectId === null ? undefined : world.scene.objects.find(({ id }) => id === objectId);
  if (!object || object.kind === 'actor') return null;
  const size = world.boundsOf(object.body).getSize(new THREE.Vector3());
  return Math.max(size.x, size.y) <= LARGEST_M ? object.body : null;
}

/** Returns the pose of an object in the world frame: x, y, z in m and roll, pitch, yaw in rad. */
export function poseOf(object: THREE.Object3D): BodyPose {
  const { x, y, z } = object.position;
  // Rotations by roll, pitch and yaw about fixed axes equal those by yaw, pitch and roll about the body's own
  // axes.
  const angles = new THREE.Euler().setFromQuaternion(object.quaternion, 'ZYX');
  return [x, y, z, angles.x, angles.y, angles.z];
}

/** A body during a drag, with a ghost at its old place. */
export class DraggedBody {
  /** The pose of the body before the drag. */
  readonly origin: BodyPose;
  private readonly parts: { object: THREE.Object3D; start: THREE.Matrix4 }[];
  private readonly root: THREE.Object3D;
  private readonly ghost = new THREE.Group();
  private readonly ghostMaterial = new THREE.MeshBasicMaterial({
    color: 0x7f8cff,
    transparent: true,
    opacity: 0.35,
    depthWrite: false,
  });
  private readonly offset = new THREE.Vector3();
  private yaw = 0;

  constructor(
    private readonly world: World,
    readonly body: string,
  ) {
    const objects = world.objectsOf(body);
    const [root] = objects;
    if (!root) throw new Error(`there is no body ${body}`);
    this.root = root;
    this.origin = poseOf(root);
    this.parts = objects.map((object) => {
      object.updateMatrix();
      return { object, start: object.matrix.clone() };
    });
    for (const object of objects) {
      const copy = object.clone();
      copy.traverse((child) => {
        if (child instanceof THREE.Mesh) child.material = this.ghostMaterial;
      });
      this.ghost.add(copy);
    }
    world.group.add(this.ghost);
    world.hold(body);
  }

  moveBy(x: number, y: number): void {
    this.offset.set(x, y, 0);
    this.apply();
  }

  turnBy(angle: number): void {
    this.yaw += angle;
    this.apply();
  }

  get hasMoved(): boolean {
    return this.offset.length() > 0.005 || Math.abs(this.yaw) > 0.005;
  }

  pose(): BodyPose {
    return poseOf(this.root);
  }

  /** Ends the drag; the body stays at its new place, or returns to the old one. */
  release(isKept: boolean): void {
    if (!isKept) {
      this.offset.set(0, 0, 0);
      this.yaw = 0;
      this.apply();
    }
    this.ghost.removeFromParent();
    this.ghostMaterial.dispose();
    this.world.letGo(this.body);
  }

  private apply(): void {
    const [x, y] = this.origin;
    const turn = new THREE.Matrix4()
      .makeTranslation(x + this.offset.x, y + this.offset.y, 0)
      .multiply(new THREE.Matrix4().makeRotationZ(this.yaw))
      .multiply(new THREE.Matrix4().makeTranslation(-x, -y, 0));
    const scale = new THREE.Vector3();
    for (const { object, start } of this.parts) {
      turn.clone().multiply(start).decompose(object.position, object.quaternion, scale);
    }
  }
}
