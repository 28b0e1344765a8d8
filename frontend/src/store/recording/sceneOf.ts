import type { Scene } from '@/generated/messages';
import { wholeScene, type PresentScene } from './sceneParts';

const MOST_OBJECTS = 20_000;
const MOST_SHAPES = 1000;
const POSE = 7;

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);
const isList = (value: unknown, most = MOST_OBJECTS): value is readonly unknown[] =>
  Array.isArray(value) && value.length <= most;
const isNumbers = (value: unknown, count?: number): boolean =>
  isList(value) && (count === undefined || value.length === count) && value.every(Number.isFinite);
const isBytes = (value: unknown, unit: number): boolean =>
  value instanceof Uint8Array && value.length % unit === 0;

const isShape = (value: unknown): boolean =>
  isRecord(value) &&
  typeof value['shape'] === 'string' &&
  isNumbers(value['size']) &&
  isNumbers(value['color']) &&
  isNumbers(value['pose'], POSE);
const isObject = (value: unknown): boolean =>
  isRecord(value) &&
  Number.isInteger(value['id']) &&
  isNumbers(value['pose'], POSE) &&
  isList(value['shapes'], MOST_SHAPES) &&
  value['shapes'].every(isShape);
const isMesh = (value: unknown): boolean =>
  isRecord(value) &&
  isBytes(value['positions'], 12) &&
  isBytes(value['normals'], 12) &&
  isBytes(value['indices'], 12) &&
  (value['uvs'] === undefined || isBytes(value['uvs'], 8));
const isSensor = (value: unknown): boolean =>
  isRecord(value) && typeof value['name'] === 'string' && isNumbers(value['pose'], POSE);
const isLight = (value: unknown): boolean => isRecord(value) && isNumbers(value['direction'], 3);
const isTexture = (value: unknown): boolean =>
  isRecord(value) && value['jpeg'] instanceof Uint8Array && isNumbers(value['tile'], 2);

const NO_PARTS: ReadonlyMap<string, Uint8Array> = new Map();

/**
 * Returns the scene of a recording, with its parts as `wholeScene` says; null if it cannot be drawn, since a
 * recording may be hostile.
 */
export function sceneOf(
  bytes: Uint8Array,
  parts: ReadonlyMap<string, Uint8Array> = NO_PARTS,
  present: PresentScene | null = null,
): Scene | null {
  let value: unknown;
  try {
    value = wholeScene(bytes, parts, present);
  } catch {
    return null;
  }
  if (!isRecord(value) || value['type'] !== 'scene') return null;
  const { objects, meshes, lights, sensors, textures = {} } = value;
  const isSound =
    isList(objects) &&
    objects.every(isObject) &&
    isRecord(meshes) &&
    Object.values(meshes).every(isMesh) &&
    isList(lights) &&
    lights.every(isLight) &&
    isNumbers(value['ground_color']) &&
    isList(sensors) &&
    sensors.every(isSensor) &&
    isRecord(textures) &&
    Object.values(textures).every(isTexture);
  return isSound ? (value as unknown as Scene) : null;
}
