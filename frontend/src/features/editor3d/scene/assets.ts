import type * as THREE from 'three';
import { api } from '@/api/client';
import type { Shape } from '@/generated/messages';
import { useProjectStore } from '@/store/project';
import { withTexts } from '@/store/saving/large';
import { fileUrl } from '@/store/saving/binary';
import { readMesh } from './meshes';
import { urdfShapes } from './urdf';

/** A fetched object to draw. `value` is null while it loads, or if it is not available. */
export type Fetched<T> = { value: T | null; failed: boolean };

/** The meshes and robots of a universe, each fetched only once; calls `onArrival` when one arrives. */
export class Assets {
  private readonly meshes = new Map<string, Fetched<THREE.BufferGeometry>>();
  private readonly models = new Map<string, Fetched<Shape[]>>();
  private isGone = false;

  constructor(private readonly onArrival: () => void) {}

  /** Returns the geometry of a mesh file of the project. */
  mesh(path: string): Fetched<THREE.BufferGeometry> {
    return this.fetched(this.meshes, path, async () => {
      const folder = path.slice(0, path.lastIndexOf('/') + 1);
      return readMesh(path, await bytesOf(path), (name) => {
        const beside = `${folder}${name.slice(name.lastIndexOf('/') + 1)}`;
        return bytesOf(isThere(`${folder}${name}`) ? `${folder}${name}` : beside);
      });
    });
  }

  /** Returns the shapes of a robot: of the project, or built in. */
  robot(id: string): Fetched<Shape[]> {
    return this.fetched(this.models, `robot:${id}`, async () => {
      const own = ownUrdf(id);
      const text = own ? await textOf(own) : await api.robotUrdf(id);
      return resolved(urdfShapes(text), own ?? '');
    });
  }

  /** Returns the shapes of a URDF in the project. */
  model(path: string): Fetched<Shape[]> {
    // This returns a promise even if the text is not a URDF, so that the view draws a mark in its place
    // instead of failing.
    return this.fetched(this.models, path, async () => {
      const text = path.endsWith('.urdf') ? await textOf(path) : '';
      return resolved(urdfShapes(text), path);
    });
  }

  dispose(): void {
    this.isGone = true;
    for (const { value } of this.meshes.values()) value?.dispose();
  }

  private fetched<T>(known: Map<string, Fetched<T>>, key: string, make: () => Promise<T>): Fetched<T> {
    const old = known.get(key);
    if (old) return old;
    const entry: Fetched<T> = { value: null, failed: false };
    known.set(key, entry);
    make()
      .then((value) => {
        entry.value = value;
      })
      .catch(() => {
        entry.failed = true;
      })
      .finally(() => {
        if (!this.isGone) this.onArrival();
      });
    return entry;
  }
}

/** Returns a path without `.` and `..`, as the project names the file. */
function plain(path: string): string {
  const parts: string[] = [];
  for (const part of path.split('/')) {
    if (part === '..') parts.pop();
    else if (part !== '.' && part !== '') parts.push(part);
  }
  return parts.join('/');
}

const isThere = (path: string) => plain(path) in useProjectStore.getState().files;

async function bytesOf(path: string): Promise<ArrayBuffer> {
  // One that an import left out is known to be missing: asking for it would be an error in the console.
  if (!isThere(path)) throw new Error(path);
  const response = await fetch(fileUrl(plain(path)), { credentials: 'same-origin' });
  if (!response.ok) throw new Error(String(response.status));
  return response.arrayBuffer();
}

/** Returns the path of a project robot's URDF; undefined if the robot has none. */
function ownUrdf(id: string): string | undefined {
  const { files } = useProjectStore.getState();
  return Object.keys(files).find((path) => path.startsWith(`robots/${id}/`) && path.endsWith('.urdf'));
}

/** Returns shapes with their mesh names resolved to paths in the project. */
function resolved(shapes: Shape[] | null, urdf: string): Shape[] {
  if (!shapes) throw new Error('no URDF');
  const folder = urdf.slice(0, urdf.lastIndexOf('/') + 1);
  const top = folder.split('/').slice(0, 2).join('/');
  const pathOf = (name: string) => {
    const inPackage = /^package:\/\/[^/]+\/(.*)$/.exec(name)?.[1];
    return inPackage === undefined ? `${folder}${name.replace(/^\.\//, '')}` : `${top}/${inPackage}`;
  };
  return shapes.map((shape) => (shape.mesh ? { ...shape, mesh: pathOf(shape.mesh) } : shape));
}

/** Returns the text of a file of the project, which may be large. */
async function textOf(path: string): Promise<string> {
  await withTexts([path]);
  return useProjectStore.getState().currentText(path) ?? '';
}
