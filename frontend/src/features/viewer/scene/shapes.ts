import * as THREE from 'three';
import type { Shape } from '@/generated/messages';
import type { Pose } from '@/store/session/poses';
import type { GeometryCache } from './geometry';
import type { Pictures } from './TextureCache';

export function setPose(position: THREE.Vector3, rotation: THREE.Quaternion, pose: Pose): void {
  position.set(pose[0] ?? 0, pose[1] ?? 0, pose[2] ?? 0);
  rotation.set(pose[3] ?? 0, pose[4] ?? 0, pose[5] ?? 0, pose[6] ?? 1);
}

/** The materials by colour and texture, shared by all objects of a scene. */
export class MaterialCache {
  private readonly known = new Map<string, THREE.Material>();

  constructor(
    private readonly isSimple: boolean,
    readonly textures: Pictures | null = null,
    /** The factor by which all opacities are multiplied. */
    private readonly opacity = 1,
  ) {}

  get([r = 0.7, g = 0.7, b = 0.7, a = 1]: readonly number[], picture = ''): THREE.Material {
    const key = [r, g, b, a, picture].join();
    let material = this.known.get(key);
    if (!material) {
      const color = new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
      const opacity = a * this.opacity;
      const look = { color, transparent: opacity < 1, opacity };
      const made = this.isSimple
        ? new THREE.MeshLambertMaterial(look)
        : new THREE.MeshStandardMaterial({ ...look, roughness: 0.72, metalness: 0.04 });
      this.textures?.whenLoaded(picture, (map) => {
        made.map = map;
        made.needsUpdate = true;
      });
      material = made;
      this.known.set(key, material);
    }
    return material;
  }

  dispose(): void {
    for (const material of this.known.values()) material.dispose();
    this.known.clear();
    this.textures?.dispose();
  }
}

/** Returns the three.js mesh of a shape. */
export function meshOf(shape: Shape, geometries: GeometryCache, materials: MaterialCache): THREE.Mesh {
  const picture = shape.texture ?? '';
  const geometry = geometries.get(shape, picture ? materials.textures?.tileOf(picture) : undefined);
  const mesh = new THREE.Mesh(geometry, materials.get(shape.color, picture));
  setPose(mesh.position, mesh.quaternion, shape.pose);
  if (shape.shape === 'mesh') mesh.scale.set(shape.size[0] ?? 1, shape.size[1] ?? 1, shape.size[2] ?? 1);
  mesh.castShadow = shape.shape !== 'plane';
  mesh.receiveShadow = shape.shape === 'plane';
  return mesh;
}
