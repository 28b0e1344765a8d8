import * as THREE from 'three';
import type { Texture as TextureData } from '@/generated/messages';

/** The pictures of a scene, decoded once each when they are first needed. */
export class TextureCache {
  private readonly known = new Map<string, THREE.Texture>();

  constructor(
    private readonly textures: Record<string, TextureData>,
    private readonly onLoaded: () => void,
    private readonly anisotropy = 4,
  ) {}

  /** The picture of a name, or null; it repeats. */
  get(name: string): THREE.Texture | null {
    const data = this.textures[name];
    if (!data) return null;
    let texture = this.known.get(name);
    if (!texture) {
      texture = this.load(data.jpeg as Uint8Array<ArrayBuffer>);
      this.known.set(name, texture);
    }
    return texture;
  }

  /** Width and height of a repetition in m. */
  tileOf(name: string): readonly [number, number] {
    const [width = 1, height = 1] = this.textures[name]?.tile ?? [];
    return [width, height];
  }

  dispose(): void {
    for (const texture of this.known.values()) texture.dispose();
    this.known.clear();
  }

  private load(jpeg: Uint8Array<ArrayBuffer>): THREE.Texture {
    const address = URL.createObjectURL(new Blob([jpeg], { type: 'image/jpeg' }));
    const done = () => {
      URL.revokeObjectURL(address);
      this.onLoaded();
    };
    // A damaged picture leaves the plain colour.
    const texture = new THREE.TextureLoader().load(address, done, undefined, done);
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.anisotropy = this.anisotropy;
    return texture;
  }
}
