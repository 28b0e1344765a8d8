import * as THREE from 'three';
import type { Shape } from '@/generated/messages';
import { GeometryCache } from '@/features/viewer/geometry';
import { MaterialCache, meshOf } from '@/features/viewer/shapes';
import type { Pose } from '@/model/document/values';
import type { ActorThing, ModelThing, RobotThing, Thing, Universe } from '@/model/universe/types';
import { Assets } from './assets';
import { personShapes } from './person';
import { arrow, box, frameOf, wayOf } from './marks';

const HERE = [0, 0, 0, 0, 0, 0, 1];
const PENDING = [0.6, 0.62, 0.66, 0.5];
const FAILED = [0.85, 0.25, 0.22, 0.6];

/** `#rrggbb` or `#rrggbbaa` as parts from 0 to 1. */
export function rgba(color: string): number[] {
  const parts = [1, 3, 5, 7].map((at) => parseInt(color.slice(at, at + 2), 16) / 255);
  return parts.map((part, index) => (Number.isNaN(part) ? (index === 3 ? 1 : 0.6) : part));
}

export function setThingPose(node: THREE.Object3D, [x, y, z, roll, pitch, yaw]: Pose): void {
  node.position.set(x, y, z);
  node.quaternion.setFromEuler(new THREE.Euler(roll, pitch, yaw, 'ZYX'));
  node.scale.set(1, 1, 1);
}

interface Drawn {
  readonly node: THREE.Group;
  readonly said: string;
}

/** The things of a universe as three.js draws them; kept outside React, and changed thing by thing. */
export class EditorScene {
  readonly group = new THREE.Group();
  readonly bounds = new THREE.Box3();
  private readonly drawn = new Map<string, Drawn>();
  private readonly geometries = new GeometryCache({});
  private readonly materials: MaterialCache;
  private readonly assets: Assets;
  private selected: readonly string[] = [];
  private universe: Universe | null = null;

  constructor(isSimple: boolean, onArrival: () => void) {
    this.materials = new MaterialCache(isSimple);
    this.assets = new Assets(() => {
      if (this.universe) this.show(this.universe);
      onArrival();
    });
  }

  /** Draws what changed since the last time; what did not stays the same object. */
  show(universe: Universe): void {
    this.universe = universe;
    const keys = new Set(universe.things.map(({ key }) => key));
    for (const key of [...this.drawn.keys()]) if (!keys.has(key)) this.drop(key);
    for (const thing of universe.things) {
      const said = JSON.stringify([thing, this.stateOf(thing)]);
      const old = this.drawn.get(thing.key);
      if (old?.said === said) {
        this.put(old.node, thing);
        continue;
      }
      this.drop(thing.key);
      const node = this.build(thing);
      this.drawn.set(thing.key, { node, said });
      this.group.add(node);
    }
    this.group.updateMatrixWorld(true);
    this.bounds.setFromObject(this.group);
    this.mark(this.selected);
  }

  nodeOf(key: string): THREE.Group | undefined {
    return this.drawn.get(key)?.node;
  }

  /** The key of the thing that something drawn is a part of. */
  keyOf(part: THREE.Object3D): string | null {
    for (let at: THREE.Object3D | null = part; at; at = at.parent) {
      const key: unknown = at.userData['thing'];
      if (typeof key === 'string') return key;
    }
    return null;
  }

  /** Frames what is selected. */
  mark(selection: readonly string[]): void {
    this.selected = selection;
    for (const [key, { node }] of this.drawn) {
      const isSelected = selection.includes(key);
      for (const child of node.children) {
        if (child.userData['isMark']) child.visible = isSelected;
        if (child.userData['isFaint']) setFaint(child, !isSelected);
      }
    }
  }

  dispose(): void {
    for (const key of [...this.drawn.keys()]) this.drop(key);
    this.geometries.dispose();
    this.materials.dispose();
    this.assets.dispose();
  }

  private drop(key: string): void {
    const node = this.drawn.get(key)?.node;
    if (!node) return;
    node.removeFromParent();
    node.traverse((child) => {
      if (child.userData['isOwn'] && 'geometry' in child) (child.geometry as THREE.BufferGeometry).dispose();
    });
    this.drawn.delete(key);
  }

  /** What a thing looks like beyond what it says: whether its files have arrived. */
  private stateOf(thing: Thing): unknown {
    if (thing.section === 'robots') return this.shapesState(this.assets.robot(thing.model));
    if (thing.section === 'actors') return '';
    if (thing.shape === 'mesh') return stateText(this.assets.mesh(thing.file));
    return thing.shape === 'urdf' ? this.shapesState(this.assets.model(thing.file)) : '';
  }

  private shapesState(entry: { value: Shape[] | null; failed: boolean }): string {
    const meshes = (entry.value ?? [])
      .filter(({ mesh }) => mesh)
      .map(({ mesh }) => this.assets.mesh(mesh ?? ''));
    return [entry, ...meshes].map(stateText).join();
  }

  private build(thing: Thing): THREE.Group {
    const node = new THREE.Group();
    node.userData['thing'] = thing.key;
    if (thing.section === 'models') this.addModel(node, thing);
    else if (thing.section === 'actors') this.addActor(node, thing);
    else this.addRobot(node, thing);
    this.put(node, thing);
    return node;
  }

  private put(node: THREE.Group, thing: Thing): void {
    if (thing.section === 'actors') node.position.set(0, 0, 0);
    else setThingPose(node, thing.pose);
  }

  private addModel(node: THREE.Group, thing: ModelThing): void {
    const { shape, size } = thing;
    const color = rgba(thing.color);
    if (shape === 'mesh') this.addMesh(node, { shape, size: [...size], pose: HERE, color, mesh: thing.file });
    else if (shape === 'urdf') this.addShapes(node, this.assets.model(thing.file), 0.5);
    else if (shape === 'sdf') node.add(box(0.5, PENDING));
    else node.add(this.meshOf({ shape, size: [...size], pose: HERE, color }));
    node.add(frameOf(node));
  }

  private addRobot(node: THREE.Group, thing: RobotThing): void {
    this.addShapes(node, this.assets.robot(thing.model), 0.35);
    node.add(frameOf(node), arrow());
  }

  private addActor(node: THREE.Group, thing: ActorThing): void {
    const person = new THREE.Group();
    for (const shape of personShapes(rgba(thing.color))) person.add(this.meshOf(shape));
    const [[x, y] = [0, 0], next] = thing.path;
    person.position.set(x, y, 0);
    if (next) person.rotation.z = Math.atan2(next[1] - y, next[0] - x);
    person.add(frameOf(person));
    node.add(person, ...wayOf(thing));
    // The frame stands round the person, not round the whole way.
    const frame = person.children.at(-1);
    if (frame) node.attach(frame);
  }

  private addShapes(
    node: THREE.Group,
    { value, failed }: { value: Shape[] | null; failed: boolean },
    size: number,
  ): void {
    if (!value) {
      node.add(box(size, failed ? FAILED : PENDING));
      return;
    }
    for (const shape of value) {
      if (shape.shape === 'mesh') this.addMesh(node, shape);
      else node.add(this.meshOf(shape));
    }
  }

  private addMesh(node: THREE.Group, shape: Shape): void {
    const { value, failed } = this.assets.mesh(shape.mesh ?? '');
    if (!value) {
      node.add(box(0.4, failed ? FAILED : PENDING));
      return;
    }
    const mesh = this.meshOf({ ...shape, mesh: '' });
    mesh.geometry = value;
    node.add(mesh);
  }

  private meshOf(shape: Shape): THREE.Mesh {
    const mesh = meshOf(shape, this.geometries, this.materials);
    mesh.receiveShadow = true;
    return mesh;
  }
}

const stateText = ({ value, failed }: { value: unknown; failed: boolean }): string =>
  value ? 'here' : failed ? 'failed' : 'coming';

function setFaint(child: THREE.Object3D, isFaint: boolean): void {
  const material = (child as THREE.Line).material as THREE.LineBasicMaterial;
  material.opacity = isFaint ? 0.35 : 1;
}
