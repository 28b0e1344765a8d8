/** Types and queries of document values. SI units; poses are [x, y, z, roll, pitch, yaw]. */

export type Json = string | number | boolean | null | readonly Json[] | { readonly [key: string]: Json };
export type JsonObject = { readonly [key: string]: Json };
export type Path = readonly (string | number)[];

export type Point = readonly [number, number];
export type Vector = readonly [number, number, number];
export type Pose = readonly [number, number, number, number, number, number];

export const isObject = (value: unknown): value is JsonObject =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

/** Returns the value at a path of a document; undefined if the path does not exist. */
export function valueAt(value: Json | undefined, path: Path): Json | undefined {
  let at: unknown = value;
  for (const step of path) {
    if (typeof at !== 'object' || at === null || !Object.hasOwn(at, step)) return undefined;
    at = (at as Record<string | number, unknown>)[step];
  }
  return at as Json | undefined;
}
