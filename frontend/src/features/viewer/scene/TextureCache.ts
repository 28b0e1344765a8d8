import * as THREE from 'three';
import type { Texture as TextureData } from '@/generated/messages';

type Take = (texture: THREE.Texture) => void;

/** A source of pictures by name, which arrive asynchronously. */
export interface Pictures {
  /** Calls `take` with the repeating picture when it has arrived; never for a damaged picture. */
  whenLoaded(name: string, take: Take): void;
  /** Returns the width and height of one repetition, in m. */
  tileOf(name: string): readonly [number, number];
  dispose(): void;
}

/** Loads a repeating picture; calls `done` with null if it cannot be loaded. */
export function loadTexture(
  address: string,
  anisotropy: number,
  done: (texture: THREE.Texture | null) => void,
): void {
  const arrived = (texture: THREE.Texture) => done(repeating(texture, anisotropy));
  new THREE.TextureLoader().load(address, arrived, undefined, () => done(null));
}

/** Decodes a repeating picture in a worker, which has no image elements; null if it is damaged. */
function decodeInWorker(jpeg: Blob, anisotropy: number, done: (texture: THREE.Texture | null) => void): void {
  createImageBitmap(jpeg, { imageOrientation: 'flipY' }).then(
    (bitmap) => {
      const texture = new THREE.Texture(bitmap);
      texture.flipY = false; // The bitmap is already flipped, since WebGL cannot flip bitmaps.
      texture.needsUpdate = true;
      done(repeating(texture, anisotropy));
    },
    () => done(null),
  );
}

function repeating(texture: THREE.Texture, anisotropy: number): THREE.Texture {
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = anisotropy;
  return texture;
}

interface Loading {
  texture: THREE.Texture | null;
  waiting: Take[];
}

/** The pictures of a scene, each decoded only once. Objects are drawn without a picture until it arrives. */
export class TextureCache implements Pictures {
  private readonly known = new Map<string, Loading>();
  private isOver = false;

  constructor(
    private readonly textures: Record<string, TextureData>,
    private readonly onLoaded: () => void,
    private readonly anisotropy = 4,
  ) {}

  whenLoaded(name: string, take: Take): void {
    const data = this.textures[name];
    if (!data) return;
    const known = this.known.get(name);
    if (known?.texture) take(known.texture);
    else if (known) known.waiting.push(take);
    else {
      const loading: Loading = { texture: null, waiting: [take] };
      this.known.set(name, loading);
      this.load(data.jpeg as Uint8Array<ArrayBuffer>, loading);
    }
  }

  tileOf(name: string): readonly [number, number] {
    const [width = 1, height = 1] = this.textures[name]?.tile ?? [];
    return [width, height];
  }

  dispose(): void {
    this.isOver = true;
    for (const { texture } of this.known.values()) texture?.dispose();
    this.known.clear();
  }

  private load(jpeg: Uint8Array<ArrayBuffer>, loading: Loading): void {
    const blob = new Blob([jpeg], { type: 'image/jpeg' });
    const arrived = (texture: THREE.Texture | null) => {
      if (this.isOver || !texture) return;
      loading.texture = texture;
      for (const take of loading.waiting.splice(0)) take(texture);
      this.onLoaded();
    };
    if (typeof document === 'undefined') return decodeInWorker(blob, this.anisotropy, arrived);
    const address = URL.createObjectURL(blob);
    loadTexture(address, this.anisotropy, (texture) => {
      URL.revokeObjectURL(address);
      arrived(texture);
    });
  }
}
