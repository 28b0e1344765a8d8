import { decode } from '@msgpack/msgpack';
import type { Mesh, Scene, SceneObject, Texture } from '@/generated/messages';

interface Named {
  readonly hash: string;
}

type Kept<T> = Readonly<Record<string, T | Named>>;

const isNamed = (part: object): part is Named => 'hash' in part;

/**
 * Returns a recorded scene with its meshes and textures, which a recording holds once, as attachments with the
 * names `scene/HASH`; `parts` has them by their hash. Shapes whose mesh is not there are left out; a texture that is not there leaves the colour. Files of version 1 have
 * their parts within the scene.
 */
export function wholeScene(frame: Uint8Array, parts: ReadonlyMap<string, Uint8Array>): Scene {
  const scene = decode(frame) as Omit<Scene, 'meshes' | 'textures'> & {
    readonly meshes: Kept<Mesh>;
    readonly textures?: Kept<Texture>;
  };
  const meshes = wholeParts(scene.meshes, parts);
  const textures = wholeParts(scene.textures ?? {}, parts);
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
    .filter(({ mesh }) => !mesh || mesh in meshes)
    .map((shape) => (shape.texture ? { ...shape, texture: known(shape.texture, textures) } : shape));
  return { ...object, shapes };
}

const known = (key: string | undefined, of: object): string => (key !== undefined && key in of ? key : '');

function wholeParts<T extends object>(
  kept: Kept<T>,
  parts: ReadonlyMap<string, Uint8Array>,
): Record<string, T> {
  const found: Record<string, T> = {};
  for (const [key, part] of Object.entries(kept)) {
    if (!isNamed(part)) found[key] = part;
    else {
      const data = parts.get(part.hash);
      if (data) found[key] = decode(data) as T;
    }
  }
  return found;
}
