import * as THREE from 'three';
import type { Scene, SceneObject } from '@/generated/messages';
import { currentPoses, type Pose } from '@/store/session/poses';
import { GeometryCache } from './geometry';
import { MaterialCache, meshOf, setPose } from './shapes';
import type { TextureCache } from './TextureCache';

interface Moving {
  body: string;
  object: THREE.Object3D;
  from: { position: THREE.Vector3; rotation: THREE.Quaternion };
  to: { position: THREE.Vector3; rotation: THREE.Quaternion };
  start: number;
}

/**
 * The distance in m above which a movement counts as a reset or a drag, which is shown at once without
 * animation.
 */
const JUMP_M = 1;

/** The scene's objects in three.js. Poses are applied here, outside React. */
export class World {
  readonly group = new THREE.Group();
  readonly bounds = new THREE.Box3();
  readonly robot: THREE.Object3D | null = null;
  readonly robotId: number | null = null;
  private readonly moving = new Map<number, Moving>();
  private readonly geometries: GeometryCache;
  private readonly materials: MaterialCache;
  private interval = 50;
  private lastFrameAt = 0;

  private readonly ids = new Map<THREE.Object3D, number>();
  private readonly held = new Set<string>();

  constructor(
    readonly scene: Scene,
    isSimple: boolean,
    textures: TextureCache | null = null,
  ) {
    this.materials = new MaterialCache(isSimple, textures);
    this.geometries = new GeometryCache(scene.meshes);
    for (const object of scene.objects) {
      const made = this.add(object);
      if (object.kind !== 'robot') continue;
      this.robot ??= made;
      this.robotId ??= object.id;
    }
    this.group.updateMatrixWorld(true);
    this.bounds.setFromObject(this.group);
  }

  /** Sets the target poses of objects, which reach them within one interval between frames. */
  receive(changed: Iterable<[number, Pose]>, now: number): void {
    if (this.lastFrameAt > 0) {
      const passed = Math.min(Math.max(now - this.lastFrameAt, 10), 200);
      this.interval += (passed - this.interval) * 0.1;
    }
    this.lastFrameAt = now;
    for (const [id, pose] of changed) {
      const item = this.moving.get(id);
      if (!item || this.held.has(item.body)) continue;
      item.from.position.copy(item.object.position);
      item.from.rotation.copy(item.object.quaternion);
      setPose(item.to.position, item.to.rotation, pose);
      item.start = now;
      if (item.from.position.distanceTo(item.to.position) > JUMP_M) this.settle(item);
    }
  }

  /** Moves objects towards their target poses; returns whether some have not arrived yet. */
  advance(now: number): boolean {
    let isMoving = false;
    for (const item of this.moving.values()) {
      if (item.start === 0) continue;
      const share = (now - item.start) / this.interval;
      if (share >= 1) {
        this.settle(item);
        continue;
      }
      isMoving = true;
      item.object.position.lerpVectors(item.from.position, item.to.position, share);
      item.object.quaternion.slerpQuaternions(item.from.rotation, item.to.rotation, share);
    }
    return isMoving;
  }

  object(id: number): THREE.Object3D | undefined {
    return this.moving.get(id)?.object;
  }

  /** Returns the id of the object that a mesh belongs to. */
  idOf(part: THREE.Object3D): number | null {
    for (let at: THREE.Object3D | null = part; at; at = at.parent) {
      const id = this.ids.get(at);
      if (id !== undefined) return id;
    }
    return null;
  }

  /** Returns the objects of a body, its base first. */
  objectsOf(body: string): THREE.Object3D[] {
    return [...this.moving.values()].filter((item) => item.body === body).map((item) => item.object);
  }

  /**
   * Returns the bounding box of a body's own shapes, without the larger frustums and axes that are attached
   * to it.
   */
  boundsOf(body: string): THREE.Box3 {
    const bounds = new THREE.Box3();
    for (const object of this.objectsOf(body)) {
      object.traverse((part) => {
        if (part instanceof THREE.Mesh) bounds.expandByObject(part);
      });
    }
    return bounds;
  }

  /** Stops a body from following received poses. */
  hold(body: string): void {
    this.held.add(body);
    for (const item of this.moving.values()) if (item.body === body) item.start = 0;
  }

  /** Moves a body to its last received pose. */
  put(body: string): void {
    for (const [id, item] of this.moving) {
      const pose = currentPoses.get(id);
      if (item.body !== body || !pose) continue;
      setPose(item.to.position, item.to.rotation, pose);
      this.settle(item);
    }
  }

  letGo(body: string): void {
    this.held.delete(body);
  }

  dispose(): void {
    this.geometries.dispose();
    this.materials.dispose();
  }

  private settle(item: Moving): void {
    item.object.position.copy(item.to.position);
    item.object.quaternion.copy(item.to.rotation);
    item.start = 0;
  }

  private add(object: SceneObject): THREE.Object3D {
    const node = new THREE.Group();
    node.name = object.link ? `${object.body}/${object.link}` : object.body;
    for (const shape of object.shapes) {
      // Ceilings are drawn only for robots' cameras, since they would hide the rooms from above.
      if (shape.ceiling) continue;
      const mesh = meshOf(shape, this.geometries, this.materials);
      if (object.kind === 'static') mesh.receiveShadow = true;
      node.add(mesh);
    }
    const pose = currentPoses.get(object.id) ?? object.pose;
    setPose(node.position, node.quaternion, pose);
    this.ids.set(node, object.id);
    this.moving.set(object.id, {
      body: object.body,
      object: node,
      from: { position: node.position.clone(), rotation: node.quaternion.clone() },
      to: { position: node.position.clone(), rotation: node.quaternion.clone() },
      start: 0,
    });
    this.group.add(node);
    return node;
  }
}
