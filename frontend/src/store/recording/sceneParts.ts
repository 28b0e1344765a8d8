import { decode } from '@msgpack/msgpack';
import type { Mesh, Scene, SceneObject, Texture } from '@/generated/messages';

interface Named {
  readonly hash: string;
}

type Kept<T> = Readonly<Record<string, T | Named>>;

/** A world whose meshes and textures stand in for those of a recording that does not hold them. */
export interface PresentScene {
  readonly name: string;
  readonly meshes: Readonly<Record<string, Mesh>>;
  readonly textures?: Readonly<Record<string, Texture>> | undefined;
}

/** Begins the names of attachments with parts of scenes. */
export const PART_PREFIX = 'scene/';

const isNamed = (part: object): part is Named => 'hash' in part;

/**
 * Returns a recorded scene with its meshes and textures, which a recording holds once, as attachments with the
 * names `scene/HASH`; `parts` has them by their hash. The segments of a session do not hold them: those of the
 * present scene stand in, if it is of the same universe. Shapes whose mesh is not there are left out; a texture that
 * is not there leaves the colour. Files of version 1 have their parts within the scene.
 *
 * @throws Error: it is no scene.
 */
export function wholeScene(
  frame: Uint8Array,
  parts: ReadonlyMap<string, Uint8Array>,
  present: PresentScene | null = null,
): Scene {
  const scene = decode(frame) as Omit<Scene, 'meshes' | 'textures'> & {
    readonly meshes: Kept<Mesh>;
    readonly textures?: Kept<Texture>;
  };
  const own = present?.name === scene.name ? present : null;
  const meshes = wholeParts(scene.meshes, parts, own?.meshes);
  const textures = wholeParts(scene.textures ?? {}, parts, own?.textures);
  return {
    ...scene,
    meshes,
    textures,
    ground_texture: known(scene.ground_texture, textures),
    objects: scene.objects.map((object) => wholeObject(object, meshes, textures)),
  };
}

function wholeObject(
  object: SceneObject,
  meshes: Readonly<Record<string, Mesh>>,
  textures: Readonly<Record<string, Texture>>,
): SceneObject {
  const shapes = object.shapes
    .filter(({ mesh }) => !mesh || Object.hasOwn(meshes, mesh))
    .map((shape) => (shape.texture ? { ...shape, texture: known(shape.texture, textures) } : shape));
  return { ...object, shapes };
}

const known = (key: string | undefined, of: object): string =>
  key !== undefined && Object.hasOwn(of, key) ? key : '';

function wholeParts<T extends object>(
  kept: Kept<T>,
  parts: ReadonlyMap<string, Uint8Array>,
  present: Readonly<Record<string, T>> = {},
): Record<string, T> {
  const found: Record<string, T> = {};
  for (const [key, part] of Object.entries(kept)) {
    if (!isNamed(part)) found[key] = part;
    else {
      const data = parts.get(part.hash);
      const standIn = Object.hasOwn(present, key) ? present[key] : undefined;
      if (data) found[key] = decode(data) as T;
      else if (standIn) found[key] = standIn;
    }
  }
  return found;
}
