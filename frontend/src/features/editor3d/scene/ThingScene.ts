import * as THREE from 'three';
import type { Shape } from '@/generated/messages';
import { GeometryCache } from '@/features/viewer/scene/geometry';
import { mapPicture } from '@/features/viewer/scene/mapping';
import { MaterialCache, meshOf } from '@/features/viewer/scene/shapes';
import type { Pictures } from '@/features/viewer/scene/TextureCache';
import { Assets, type Fetched } from './assets';
import { box } from './marks';

const PENDING = [0.6, 0.62, 0.66, 0.5];
const FAILED = [0.85, 0.25, 0.22, 0.6];

/** Returns the parts of `#rrggbb` or `#rrggbbaa`, each from 0 to 1. */
export function rgba(color: string): number[] {
  const parts = [1, 3, 5, 7].map((at) => parseInt(color.slice(at, at + 2), 16) / 255);
  return parts.map((part, index) => (Number.isNaN(part) ? (index === 3 ? 1 : 0.6) : part));
}

interface Drawn {
  readonly node: THREE.Group;
  readonly said: string;
}

/** The three.js objects of an editor's things. They are outside of React, and updated one by one. */
export abstract class ThingScene<T extends { readonly key: string }> {
  readonly group = new THREE.Group();
  readonly bounds = new THREE.Box3();
  protected readonly assets: Assets;
  private readonly drawn = new Map<string, Drawn>();
  private readonly geometries = new GeometryCache({});
  private readonly materials: MaterialCache;
  private selected: readonly string[] = [];
  private things: readonly T[] = [];

  constructor(isSimple: boolean, onArrival: () => void, textures: Pictures | null = null, opacity = 1) {
    this.materials = new MaterialCache(isSimple, textures, opacity);
    this.assets = new Assets(() => {
      this.again();
      onArrival();
    });
  }

  /** Returns additional state that a thing's drawing depends on, such as whether its files have arrived. */
  protected abstract stateOf(thing: T): unknown;
  /** Adds the objects of a thing to its node. */
  protected abstract fill(node: THREE.Group, thing: T): void;
  /** Sets the pose of a thing's node. */
  protected abstract put(node: THREE.Group, thing: T): void;

  /** Draws the changed things; the objects of unchanged things stay. */
  show(things: readonly T[]): void {
    this.things = things;
    const keys = new Set(things.map(({ key }) => key));
    for (const key of [...this.drawn.keys()]) if (!keys.has(key)) this.drop(key);
    for (const thing of things) {
      const said = JSON.stringify([this.lookOf(thing), this.stateOf(thing)]);
      const old = this.drawn.get(thing.key);
      if (old?.said === said) {
        this.put(old.node, thing);
        continue;
      }
      this.drop(thing.key);
      const node = new THREE.Group();
      node.userData['thing'] = thing.key;
      this.fill(node, thing);
      this.put(node, thing);
      this.drawn.set(thing.key, { node, said });
      this.group.add(node);
    }
    this.group.updateMatrixWorld(true);
    this.bounds.copy(this.boundsOf(things.map(({ key }) => key)));
    this.mark(this.selected);
  }

  /** Draws the current things again after assets have arrived. */
  protected again(): void {
    this.show(this.things);
  }

  nodeOf(key: string): THREE.Group | undefined {
    return this.drawn.get(key)?.node;
  }

  /** Returns the key of the thing that a drawn object belongs to. */
  keyOf(part: THREE.Object3D): string | null {
    for (let at: THREE.Object3D | null = part; at; at = at.parent) {
      const key: unknown = at.userData['thing'];
      if (typeof key === 'string') return key;
    }
    return null;
  }

  /** Returns the bounding box of some things, without their marks. */
  boundsOf(keys: readonly string[]): THREE.Box3 {
    const bounds = new THREE.Box3();
    for (const key of keys) {
      for (const child of this.nodeOf(key)?.children ?? []) {
        if (!child.userData['isMark']) bounds.expandByObject(child);
      }
    }
    return bounds;
  }

  /** Draws frames around the selected things. */
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

  /** Returns the values on which a thing's drawing depends; by default all values of the thing. */
  protected lookOf(thing: T): unknown {
    return thing;
  }

  protected meshOf(shape: Shape): THREE.Mesh {
    const mesh = meshOf(shape, this.geometries, this.materials);
    mesh.receiveShadow = true;
    return mesh;
  }

  /** Adds shapes; until they have arrived, adds a box of this size in m. */
  protected addShapes(node: THREE.Group, { value, failed }: Fetched<Shape[]>, size: number): void {
    if (!value) {
      node.add(box(size, failed ? FAILED : PENDING));
      return;
    }
    for (const shape of value) {
      if (shape.shape === 'mesh') this.addMesh(node, shape);
      else node.add(this.meshOf(shape));
    }
  }

  protected addMesh(node: THREE.Group, shape: Shape): void {
    const { value, failed } = this.assets.mesh(shape.mesh ?? '');
    if (!value) {
      node.add(box(0.4, failed ? FAILED : PENDING));
      return;
    }
    const mesh = this.meshOf({ ...shape, mesh: '' });
    const { textures } = this.materials;
    mesh.geometry = shape.texture && textures ? painted(value, shape, textures.tileOf(shape.texture)) : value;
    node.add(mesh);
  }

  /** Returns a text that changes whenever shapes or their meshes arrive. */
  protected arrivals(entry: Fetched<Shape[]>): string {
    const meshes = (entry.value ?? [])
      .filter(({ mesh }) => mesh)
      .map(({ mesh }) => this.assets.mesh(mesh ?? ''));
    return [entry, ...meshes].map(arrival).join();
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
}

/** Returns a copy of a mesh with texture coordinates, which are computed with the vertices in m. */
function painted(
  mesh: THREE.BufferGeometry,
  { size }: Shape,
  tile: readonly [number, number],
): THREE.BufferGeometry {
  const [x = 1, y = 1, z = 1] = size;
  const copy = mesh.clone().scale(x, y, z);
  mapPicture(copy, 'mesh', tile);
  return copy.scale(1 / x, 1 / y, 1 / z);
}

export const arrival = ({ value, failed }: Fetched<unknown>): string =>
  value ? 'here' : failed ? 'failed' : 'coming';

function setFaint(child: THREE.Object3D, isFaint: boolean): void {
  const material = (child as THREE.Line).material as THREE.LineBasicMaterial;
  material.opacity = isFaint ? 0.35 : 1;
}
