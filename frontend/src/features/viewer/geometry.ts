import * as THREE from 'three';
import type { Mesh as MeshData, Shape } from '@/generated/messages';
import { floatsOf, uint32Of } from '@/store/session/frames';

/** Geometries by shape and size, shared by all objects of a scene. */
export class GeometryCache {
  private readonly known = new Map<string, THREE.BufferGeometry>();

  constructor(private readonly meshes: Record<string, MeshData>) {}

  get(shape: Shape): THREE.BufferGeometry {
    const key = `${shape.shape}:${shape.mesh ?? ''}:${shape.shape === 'mesh' ? '' : shape.size.join()}`;
    let geometry = this.known.get(key);
    if (!geometry) {
      geometry = this.make(shape);
      this.known.set(key, geometry);
    }
    return geometry;
  }

  dispose(): void {
    for (const geometry of this.known.values()) geometry.dispose();
    this.known.clear();
  }

  private make({ shape, size, mesh = '' }: Shape): THREE.BufferGeometry {
    const [a = 1, b = 1, c = 1] = size;
    // Round shapes of three.js lie along y, ours along z.
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
