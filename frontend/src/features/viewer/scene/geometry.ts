import * as THREE from 'three';
import type { Mesh as MeshData, Shape } from '@/generated/messages';
import { floatsOf, uint32Of } from '@/store/session/frames';
import { mapPicture } from './mapping';

/** The geometries by shape and size, shared by all objects of a scene. */
export class GeometryCache {
  private readonly known = new Map<string, THREE.BufferGeometry>();

  constructor(private readonly meshes: Record<string, MeshData>) {}

  /** Returns the triangles of a shape; if the size of a texture is given, with texture coordinates. */
  get(shape: Shape, tile?: readonly [number, number]): THREE.BufferGeometry {
    const size = shape.shape === 'mesh' && !tile ? '' : shape.size.join();
    const key = `${shape.shape}:${shape.mesh ?? ''}:${size}:${tile?.join() ?? ''}`;
    let geometry = this.known.get(key);
    if (!geometry) {
      geometry = tile ? this.painted(shape, tile) : this.make(shape);
      this.known.set(key, geometry);
    }
    return geometry;
  }

  dispose(): void {
    for (const geometry of this.known.values()) geometry.dispose();
    this.known.clear();
  }

  private painted(shape: Shape, tile: readonly [number, number]): THREE.BufferGeometry {
    const whole = this.make(shape);
    // The mesh is unknown here: the object that shows it supplies the triangles.
    if (!whole.hasAttribute('position')) return whole;
    const uvs = this.meshes[shape.mesh ?? '']?.uvs;
    if (uvs) {
      whole.setAttribute('uv', new THREE.BufferAttribute(floatsOf(uvs), 2));
      return whole;
    }
    const [x = 1, y = 1, z = 1] = shape.shape === 'mesh' ? shape.size : [];
    const apart = whole.index ? whole.toNonIndexed() : whole;
    // Texture coordinates are computed in m, but the size of a mesh is set on the object that shows it.
    mapPicture(apart.scale(x, y, z), shape.shape, tile);
    return apart.scale(1 / x, 1 / y, 1 / z);
  }

  private make({ shape, size, mesh = '' }: Shape): THREE.BufferGeometry {
    const [a = 1, b = 1, c = 1] = size;
    // The round shapes of three.js have their axis along y, ours along z.
    switch (shape) {
      case 'box':
        return new THREE.BoxGeometry(a, b, c);
      case 'cylinder':
        return new THREE.CylinderGeometry(a, a, b, 40).rotateX(Math.PI / 2);
      case 'capsule':
        return new THREE.CapsuleGeometry(a, b, 10, 28).rotateX(Math.PI / 2);
      case 'sphere':
        return new THREE.SphereGeometry(a, 32, 20);
      case 'plane':
        return new THREE.PlaneGeometry(a, b);
      case 'mesh':
        return this.fromMesh(this.meshes[mesh]);
    }
  }

  private fromMesh(data: MeshData | undefined): THREE.BufferGeometry {
    const geometry = new THREE.BufferGeometry();
    if (!data) return geometry;
    geometry.setAttribute('position', new THREE.BufferAttribute(floatsOf(data.positions), 3));
    geometry.setIndex(new THREE.BufferAttribute(uint32Of(data.indices), 1));
    if (data.normals.byteLength > 0) {
      geometry.setAttribute('normal', new THREE.BufferAttribute(floatsOf(data.normals), 3));
    } else {
      geometry.computeVertexNormals();
    }
    return geometry;
  }
}
