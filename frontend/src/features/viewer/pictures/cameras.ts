import type { Scene } from '@/generated/messages';

/**
 * Returns the cameras of a scene by the names under which their pictures are requested: the sensor's name,
 * and `robot/sensor` for every robot but the first. The first camera is the one that is sent if no name is
 * given.
 */
export function camerasOf(scene: Scene | null): string[] {
  if (!scene) return [];
  const robotOf = new Map(scene.objects.map(({ id, body }) => [id, body]));
  const first = scene.objects.find(({ kind }) => kind === 'robot')?.body;
  return scene.sensors
    .filter(({ kind }) => kind === 'camera')
    .map(({ name, object_id }) => {
      const robot = robotOf.get(object_id);
      return robot === undefined || robot === first ? name : `${robot}/${name}`;
    });
}

/**
 * Returns the camera to show: the chosen one if the world has it, otherwise the first; null while none is
 * known.
 */
export const shownCamera = (cameras: readonly string[], chosen: string | null): string | null =>
  cameras.find((name) => name === chosen) ?? cameras[0] ?? null;

/** Returns the name under which a camera's pictures are requested; undefined for the first camera. */
export const requestedName = (cameras: readonly string[], shown: string | null): string | undefined =>
  shown === null || shown === cameras[0] ? undefined : shown;

/** Returns the camera for another view: the next one after `shown`, in turn. */
export const nextCamera = (cameras: readonly string[], shown: string | null): string | null =>
  cameras[(cameras.indexOf(shown ?? '') + 1) % Math.max(1, cameras.length)] ?? null;
