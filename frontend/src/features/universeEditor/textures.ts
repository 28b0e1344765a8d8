import type * as THREE from 'three';
import { fileUrl } from '@/store/saving/binary';
import { loadTexture, type Pictures } from '@/features/viewer/scene/TextureCache';
import tiles from '@/generated/textures/tiles.json';

const shipped = import.meta.glob<string>('../../generated/textures/*.jpg', {
  eager: true,
  query: '?url&no-inline',
  import: 'default',
});

type Tile = readonly [number, number];

/** Returns the name of a picture, with the size of one repetition in m if it is set. */
export const pictureName = (texture: string, tile: Tile | null): string =>
  texture && tile ? `${texture}@${tile[0]}x${tile[1]}` : texture;

const fileOf = (name: string): string => name.replace(/@[\d.e+-]+x[\d.e+-]+$/, '');

const addressOf = (file: string): string => shipped[`../../generated/textures/${file}.jpg`] ?? fileUrl(file);

interface Picture {
  texture: THREE.Texture | null;
  readonly waiting: ((texture: THREE.Texture) => void)[];
}

/**
 * The textures of the edited universe: built-in ones, and files of the project. A texture that cannot be
 * loaded is left out.
 */
export class EditorTextures implements Pictures {
  /** Called when a texture arrives. */
  onArrival: () => void = () => undefined;
  private readonly known = new Map<string, Picture>();
  private isGone = false;

  constructor(
    private readonly redraw: () => void,
    private readonly anisotropy: number,
  ) {}

  whenLoaded(name: string, take: (texture: THREE.Texture) => void): void {
    const file = fileOf(name);
    if (file === '') return;
    const picture = this.pictureOf(file);
    if (picture.texture) take(picture.texture);
    else picture.waiting.push(take);
  }

  tileOf(name: string): Tile {
    const said = /@([\d.e+-]+)x([\d.e+-]+)$/.exec(name);
    if (said) return [Number(said[1]), Number(said[2])];
    const file = fileOf(name);
    const own = (tiles as unknown as Readonly<Record<string, Tile>>)[file];
    if (own) return own;
    const image = this.known.get(file)?.texture?.image as { width: number; height: number } | undefined;
    return [1, image ? image.height / image.width : 1];
  }

  /** Returns whether a texture has arrived; before that, the size of its repetition may be unknown. */
  has(name: string): boolean {
    const file = fileOf(name);
    return file !== '' && this.pictureOf(file).texture !== null;
  }

  dispose(): void {
    this.isGone = true;
    for (const { texture } of this.known.values()) texture?.dispose();
    this.known.clear();
  }

  private pictureOf(file: string): Picture {
    const old = this.known.get(file);
    if (old) return old;
    const picture: Picture = { texture: null, waiting: [] };
    this.known.set(file, picture);
    loadTexture(addressOf(file), this.anisotropy, (texture) => {
      if (this.isGone) {
        texture?.dispose();
        return;
      }
      picture.texture = texture;
      if (texture) for (const take of picture.waiting.splice(0)) take(texture);
      this.onArrival();
      this.redraw();
    });
    return picture;
  }
}
